// The scene files that a suite's `files` and `exclude` mean.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parity::scenes {

struct FileGlobs {
  std::filesystem::path folder; // that relative globs start from
  std::vector<std::string> files, exclude;
};

// The scene files (.gltf, .glb) that any of `files` matches and none of `exclude`, each once, sorted by their paths as
// text: the order is the same on every machine. A glob is matched folder by folder (base/text/glob.h): '*' stays within
// a folder, '**' alone stands for any folders, also none. A glob without wildcards is a file; "builtin:NAME" stands for
// itself. Hidden files and folders match only a part that begins with '.'. Links to folders are not followed by '**'.
// Throws std::runtime_error, whose text is the reason, for a glob of `files` that no file matches, for one whose every
// match is excluded, for one of `exclude` that matches none of them, and where there are more than kMostSceneFiles.
std::vector<std::string> findSceneFiles(const FileGlobs& globs);

inline constexpr std::size_t kMostSceneFiles = 100'000;

} // namespace parity::scenes

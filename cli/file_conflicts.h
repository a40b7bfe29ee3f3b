// Outputs never overwrite inputs or one another.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parity::cli {

// A file by the option that names it, or in words ("the reference").
struct NamedFile {
  std::string name;
  std::filesystem::path file; // empty or "-": none
};

// Throws Error (usage) where an output is an input or another output, also by another path to the same file.
void requireSeparate(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

// Whether `path` is the folder or lies below it, with all links resolved.
bool liesIn(const std::filesystem::path& path, const std::filesystem::path& folder);

} // namespace parity::cli

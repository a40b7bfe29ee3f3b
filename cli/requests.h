// A scene request from the common options.
#pragma once

#include <string>

#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "job/scene_request.h"

namespace parity::cli {

// The one view, environment and sun of the command line for this scene; named by the file's stem.
job::SceneRequest sceneRequest(const CommonOptions& common, const std::string& scene);

// A scene's name as a folder's: letters, digits and '-' stay, the rest becomes '_'.
std::string folderName(const std::string& scene);

// Where the baked light of a scene lies: the folder itself if it holds a bake, else that of the scene's name in it.
std::string bakedFolder(const std::string& folder, const std::string& scene);

// The files that a run reads: its scenes and what each has, budgets, baseline; for requireSeparate.
std::vector<NamedFile> inputFiles(const CommonOptions& common, const std::vector<job::SceneRequest>& scenes);
std::vector<NamedFile> inputFiles(const CommonOptions& common, const VerdictOptions& verdict,
                                  const std::vector<job::SceneRequest>& scenes);

} // namespace parity::cli

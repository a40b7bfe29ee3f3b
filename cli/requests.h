// A scene request from the common options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "job/scene_request.h"

namespace parity::cli {

// The one view, environment and sun of the command line for this scene; named by the file's stem.
job::SceneRequest sceneRequest(const CommonOptions& common, const std::string& scene);

// What a run over scenes is asked for.
struct RunRequest {
  job::Settings settings; // of scenes that say nothing else
  base::GivenKnobs given; // what those were made of
  std::vector<job::SceneRequest> scenes;
  std::string suite;                       // its name; empty: there is none
  std::optional<std::string> suiteBudgets; // path of the suite's budget file
  std::vector<std::string> only;           // --only, in names of scenes and views alone
};
// Of a suite, or, where that is empty, of the scenes of the command line, in each of the environments; each gets a name
// of its own: "bottle (2)" for the second bottle. Of these what --only means. Throws Error (failed) with file, line and
// reason for a suite that is refused.
RunRequest runRequest(const CommonOptions& common, const std::vector<std::string>& scenes, const std::string& suite);

// The same with a request for each view: "bottle, front" where a scene has several.
RunRequest viewRequests(const CommonOptions& common, const std::vector<std::string>& scenes, const std::string& suite);

// The globs of --only with the names of the scenes that have the tag for each "tag:NAME". Throws Error (usage) for a
// tag that no scene has.
std::vector<std::string> withoutTags(const std::vector<std::string>& only,
                                     const std::vector<job::SceneRequest>& scenes);

// Leaves the views that any of the globs means (report/view_choice.h), and says how many of how many; no globs: all.
// Throws Error (usage) for a glob that means none.
std::vector<job::SceneRequest> chooseViews(std::vector<job::SceneRequest> scenes, const std::vector<std::string>& only);

// A scene's name as a folder's: letters, digits and '-' stay, the rest becomes '_'.
std::string folderName(const std::string& scene);

// Where the baked light of a scene lies: the folder itself if it holds a bake, else that of the scene's name in it.
std::string bakedFolder(const std::string& folder, const std::string& scene);

// The files that a run reads: its scenes and what each has, budgets, baseline; for requireSeparate.
std::vector<NamedFile> inputFiles(const CommonOptions& common, const std::vector<job::SceneRequest>& scenes);
std::vector<NamedFile> inputFiles(const CommonOptions& common, const VerdictOptions& verdict,
                                  const std::vector<job::SceneRequest>& scenes);

} // namespace parity::cli

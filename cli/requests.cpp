#include "cli/requests.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/log.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"
#include "report/reader.h"
#include "report/view_choice.h"
#include "scenes/names.h"

namespace parity::cli {

namespace {

// Of several environments the scene's name says which: "bottle, studio".
std::vector<job::SceneRequest> inEachEnvironment(const CommonOptions& common, const job::SceneRequest& scene) {
  if (common.environments.size() < 2) return {scene};
  std::vector<job::SceneRequest> all;
  for (const std::string& environment : common.environments) {
    job::SceneRequest& entry = all.emplace_back(scene);
    entry.name = scenes::cleanName(fmt::format("{}, {}", scene.name, scenes::stemOf(environment)));
    entry.settings.scene.environment = environment;
    entry.given["env"] = {{environment}, "--env"};
  }
  return all;
}

} // namespace

job::SceneRequest sceneRequest(const CommonOptions& common, const std::string& scene) {
  job::SceneRequest request;
  request.name = scenes::cleanName(scenes::stemOf(scene));
  request.scene = scene;
  request.settings = common.settings;
  request.settings.scene.baked = bakedFolder(common.settings.scene.baked, request.name);
  request.given = common.given;
  if (!request.settings.scene.baked.empty()) request.given["baked"].value = {request.settings.scene.baked};
  request.views = {common.view};
  return request;
}

RunRequest runRequest(const CommonOptions& common, const std::vector<std::string>& scenes, const std::string& suite) {
  RunRequest run;
  if (!suite.empty()) {
    const scenes::Suite loaded = scenes::loadSuite(suite, job::suiteKnobs());
    run.settings = job::defaultsOf(loaded.given, common.plain, common.given);
    run.given = base::merged(loaded.given, common.given);
    run.scenes = job::requestsOf(loaded, common.plain, common.given);
    run.suite = loaded.name;
    run.suiteBudgets = loaded.budgets;
  } else {
    run.settings = common.settings;
    run.given = common.given;
    std::set<std::string> names;
    for (const std::string& scene : scenes)
      for (job::SceneRequest& entry : inEachEnvironment(common, sceneRequest(common, scene))) {
        const std::string stem = entry.name;
        for (int copy = 2; !names.insert(entry.name).second; ++copy) entry.name = fmt::format("{} ({})", stem, copy);
        run.scenes.push_back(std::move(entry));
      }
  }
  run.only = withoutTags(common.only, run.scenes);
  run.scenes = chooseViews(std::move(run.scenes), run.only);
  return run;
}

RunRequest viewRequests(const CommonOptions& common, const std::vector<std::string>& scenes, const std::string& suite) {
  RunRequest run = runRequest(common, scenes, suite);
  std::vector<job::SceneRequest> views;
  for (const job::SceneRequest& scene : run.scenes)
    for (const scenes::ViewRequest& view : scene.views) {
      job::SceneRequest& each = views.emplace_back(scene);
      each.views = {view};
      if (scene.views.size() > 1) each.name += ", " + view.name;
    }
  run.scenes = std::move(views);
  return run;
}

std::vector<std::string> withoutTags(const std::vector<std::string>& only,
                                     const std::vector<job::SceneRequest>& scenes) {
  constexpr std::string_view kTag = "tag:";
  std::vector<std::string> globs;
  for (const std::string& glob : only) {
    if (!glob.starts_with(kTag)) {
      globs.push_back(glob);
      continue;
    }
    std::set<std::string_view> known;
    bool isKnown = false;
    for (const job::SceneRequest& scene : scenes) {
      known.insert(scene.tags.begin(), scene.tags.end());
      if (std::ranges::find(scene.tags, glob.substr(kTag.size())) == scene.tags.end()) continue;
      globs.push_back(base::exactGlob(scene.name));
      isKnown = true;
    }
    if (isKnown) continue;
    const std::vector<std::string_view> names(known.begin(), known.end());
    throw base::Error(base::ExitCode::usage, "--only", "'" + glob + "'",
                      names.empty()
                          ? "no scene has a tag"
                          : "no scene has this tag; " + base::describeNearest(glob.substr(kTag.size()), names));
  }
  return globs;
}

std::vector<job::SceneRequest> chooseViews(std::vector<job::SceneRequest> scenes,
                                           const std::vector<std::string>& only) {
  if (only.empty()) return scenes;
  std::vector<std::string> names;
  const auto count = [](const std::vector<job::SceneRequest>& list) {
    std::size_t views = 0;
    for (const job::SceneRequest& scene : list) views += scene.views.size();
    return views;
  };
  for (const job::SceneRequest& scene : scenes) {
    names.push_back(scene.name);
    for (const scenes::ViewRequest& view : scene.views) names.push_back(scene.name + "/" + view.name);
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  for (const std::string& glob : only)
    if (std::ranges::none_of(scenes, [&](const job::SceneRequest& scene) {
          return std::ranges::any_of(scene.views,
                                     [&](const auto& view) { return report::isChosen({glob}, scene.name, view.name); });
        }))
      throw base::Error(base::ExitCode::usage, "--only", "'" + glob + "'",
                        "no scene or view has this name; " + base::describeNearest(glob, known));
  const std::size_t sceneCount = scenes.size(), viewCount = count(scenes);
  for (std::size_t i = 0; i < sceneCount; ++i) {
    job::SceneRequest& scene = scenes[i];
    scene.partOf = job::WholeRun{i, sceneCount, scene.views.size()};
    std::erase_if(scene.views, [&](const auto& view) { return !report::isChosen(only, scene.name, view.name); });
  }
  std::erase_if(scenes, [](const job::SceneRequest& scene) { return scene.views.empty(); });
  base::logInfo(
      fmt::format("--only: {} of {} scenes, {} of {} views", scenes.size(), sceneCount, count(scenes), viewCount));
  return scenes;
}

std::string folderName(const std::string& scene) {
  std::string name;
  for (const char c : scene)
    name += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
  return name;
}

std::string bakedFolder(const std::string& folder, const std::string& scene) {
  const std::filesystem::path path = folder;
  std::error_code none;
  if (folder.empty() || std::filesystem::exists(path / bake::kManifestFile, none)) return folder;
  const std::filesystem::path own = path / folderName(scene);
  return std::filesystem::exists(own, none) ? own.string() : folder;
}

std::vector<NamedFile> inputFiles(const CommonOptions& common, const std::vector<job::SceneRequest>& scenes) {
  std::vector<NamedFile> files = {{"the environment", common.settings.scene.environment},
                                  {"the budgets", common.settings.budgets.value_or("")}};
  for (const job::SceneRequest& scene : scenes) {
    files.push_back({"the scene", scene.scene});
    files.push_back({"the environment", scene.settings.scene.environment});
    files.push_back({"the budgets", scene.budgets.value_or("")});
  }
  return files;
}

std::vector<NamedFile> inputFiles(const CommonOptions& common, const VerdictOptions& verdict,
                                  const std::vector<job::SceneRequest>& scenes) {
  std::vector<NamedFile> files = inputFiles(common, scenes);
  files.push_back({"the approvals", verdict.approvals});
  if (!verdict.baseline.empty()) files.push_back({"the baseline", report::reportFileOf(verdict.baseline)});
  return files;
}

} // namespace parity::cli

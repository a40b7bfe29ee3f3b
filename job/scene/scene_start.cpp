#include "job/scene/scene_start.h"

#include <filesystem>

#include <fmt/format.h>

#include "scenes/names.h"

namespace parity::job {

report::SceneResult startScene(const SceneRequest& request) {
  const scenes::SceneSettings& settings = request.settings.scene;
  report::SceneResult result;
  result.name = request.name;
  result.source = scenes::cleanName(std::filesystem::path(request.scene).filename().string());
  result.environment = settings.environment.empty()
                           ? "none"
                           : scenes::cleanName(std::filesystem::path(settings.environment).filename().string());
  result.sun = "none";
  result.light = scenes::describe(settings.lightScales, settings.fog, settings.falloff);
  const auto add = [&](const std::string& text) { result.light += (result.light.empty() ? "" : "; ") + text; };
  if (request.settings.shadows) add("shadows");
  const int bounces = request.settings.reference.bounces;
  if (request.settings.truth && bounces > 0)
    add(fmt::format("{} bounce{} between surfaces in the truth", bounces, bounces > 1 ? "s" : ""));
  return result;
}

std::string withoutFolders(std::string text, const SceneRequest& request) {
  for (const std::string& file : {request.scene, request.settings.scene.environment, request.budgets.value_or("")}) {
    const std::string folder = (std::filesystem::path(file).parent_path() / "").string();
    if (folder.empty()) continue;
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
      if (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\n' || text[at - 1] == '\'')
        text.erase(at, folder.size());
      else
        ++at; // the end of another path
  }
  return text;
}

} // namespace parity::job

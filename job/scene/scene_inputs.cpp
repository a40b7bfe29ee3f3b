#include "job/scene/scene_inputs.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "base/hash.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

constexpr std::size_t kDigits = 12;
constexpr const char *kEnvironment = "environment", *kBake = "baked light"; // the conditions' names

std::string digestOf(const base::Hasher& hasher) { return hasher.hex().substr(0, kDigits); }

// Textures by the places at which the scene's file names them: two that were swapped are another asset.
std::string assetDigest(const SceneRequest& request, std::span<const scenes::SourceFile> sources) {
  base::Hasher hasher;
  if (sources.empty()) return digestOf(hasher.add(request.scene));
  std::error_code none;
  const std::filesystem::path given = sources.front().file.parent_path();
  const std::filesystem::path folder = std::filesystem::weakly_canonical(given.empty() ? "." : given, none);
  std::vector<std::pair<std::string, std::string>> files; // place, content
  for (const scenes::SourceFile& source : sources.subspan(1))
    files.emplace_back(std::filesystem::weakly_canonical(source.file, none).lexically_relative(folder).generic_string(),
                       source.hash);
  std::ranges::sort(files);
  hasher.add(sources.front().hash);
  for (const auto& [place, content] : files) hasher.add(place).add(content);
  return digestOf(hasher);
}

// path: of the file or folder that the condition counts by content; empty: there is none.
std::string conditionDigest(const std::vector<compare::Condition>& conditions, const char* name,
                            const std::string& path) {
  const auto found = std::ranges::find(conditions, name, &compare::Condition::name);
  if (path.empty() || found == conditions.end()) return {};
  base::Hasher hasher;
  return digestOf(hasher.add(found->value));
}

std::string requestDigest(const SceneRequest& request, const Conditions& conditions) {
  base::Hasher hasher;
  const auto add = [&](const std::vector<compare::Condition>& list) {
    for (const compare::Condition& condition : reported(list))
      if (condition.name != kEnvironment && condition.name != kBake) hasher.add(condition.name).add(condition.value);
  };
  add(conditions.scene);
  for (std::size_t i = 0; i < conditions.views.size(); ++i) {
    hasher.add("view").add(request.views[i].name);
    add(conditions.views[i]);
  }
  return digestOf(hasher);
}

} // namespace

std::string digestOf(std::vector<compare::Condition> conditions) {
  std::erase_if(conditions, [](const compare::Condition& each) {
    return each.actsOn != compare::ActsOn::figures && each.actsOn != compare::ActsOn::wholes;
  });
  std::ranges::sort(conditions, {}, &compare::Condition::name);
  base::Hasher hasher;
  for (const compare::Condition& condition : conditions) hasher.add(condition.name).add(condition.value);
  return digestOf(hasher);
}

std::optional<report::SceneInputs> inputsOf(const SceneRequest& request, const Conditions& conditions,
                                            const std::vector<scenes::SourceFile>& sources) {
  if (sources.empty() && !scenes::isBuiltin(request.scene)) return std::nullopt;
  const scenes::SceneSettings& settings = request.settings.scene;
  return report::SceneInputs{
      assetDigest(request, sources), conditionDigest(conditions.scene, kEnvironment, settings.environment),
      requestDigest(request, conditions), conditionDigest(conditions.scene, kBake, settings.baked)};
}

} // namespace parity::job

#include "job/scene/scene_inputs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "base/hash.h"
#include "job/scene/external_pictures.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

constexpr std::size_t kDigits = 12;
constexpr const char *kEnvironment = "environment", *kBake = "baked light"; // the conditions' names

std::string digestOf(const base::Hasher& hasher) { return hasher.hex().substr(0, kDigits); }

std::filesystem::path wholePath(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::weakly_canonical(file, none);
}

// Textures by the places at which the scene's file names them: two that were swapped are another asset.
std::string assetDigest(const SceneRequest& request, std::span<const scenes::SourceFile> sources) {
  base::Hasher hasher;
  if (sources.empty()) return digestOf(hasher.add(request.scene));
  const std::filesystem::path given = sources.front().file.parent_path(),
                              folder = wholePath(given.empty() ? "." : given);
  std::vector<std::pair<std::string, std::string>> files; // place, content
  for (const scenes::SourceFile& source : sources.subspan(1))
    files.emplace_back(wholePath(source.file).lexically_relative(folder).generic_string(), source.hash);
  std::ranges::sort(files);
  hasher.add(sources.front().hash);
  for (const auto& [place, content] : files) hasher.add(place).add(content);
  return digestOf(hasher);
}

// Of pictures of other engines, by the views that they stand for; empty: none was read.
std::string picturesDigest(const std::vector<std::filesystem::path>& files,
                           const std::map<std::filesystem::path, std::string>& hashes) {
  if (hashes.empty()) return {};
  base::Hasher hasher;
  for (const std::filesystem::path& file : files) {
    const auto found = hashes.find(file);
    hasher.add(found == hashes.end() ? std::string() : found->second);
  }
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
  std::vector<std::filesystem::path> pictures;
  for (const std::string& file : externalFilesOf(request)) pictures.push_back(wholePath(file));
  std::vector<scenes::SourceFile> own;
  std::map<std::filesystem::path, std::string> hashes; // of pictures that were read
  for (const scenes::SourceFile& source : sources)
    if (const std::filesystem::path file = wholePath(source.file); std::ranges::count(pictures, file) > 0)
      hashes[file] = source.hash;
    else
      own.push_back(source);
  if (own.empty() && !scenes::isBuiltin(request.scene)) return std::nullopt;
  const scenes::SceneSettings& settings = request.settings.scene;
  return report::SceneInputs{.asset = assetDigest(request, own),
                             .environment = conditionDigest(conditions.scene, kEnvironment, settings.environment),
                             .request = requestDigest(request, conditions),
                             .bake = conditionDigest(conditions.scene, kBake, settings.baked),
                             .pictures = picturesDigest(pictures, hashes)};
}

} // namespace parity::job

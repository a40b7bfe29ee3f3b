#include "job/scene_inputs.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "base/hash.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

using compare::Condition;

// The knobs whose file is a part of its own (scenes/scene_knobs.cpp); tests/job/scene_inputs_test.cpp notices where one
// is renamed.
constexpr std::string_view kEnvironment = "environment", kBake = "baked light";

std::string valueOf(const std::vector<Condition>& conditions, std::string_view name) {
  const auto found = std::ranges::find(conditions, name, &Condition::name);
  return found == conditions.end() ? std::string() : found->value;
}

std::string hashOfText(std::string_view text) { return text.empty() ? std::string() : base::Hasher().add(text).hex(); }

// Of a built-in one the build knows the content.
std::string assetOf(const SceneRequest& request, const std::vector<scenes::SourceFile>& sources) {
  if (scenes::isBuiltin(request.scene)) return hashOfText(request.scene);
  if (sources.empty()) return {};
  const std::filesystem::path folder = std::filesystem::path(request.scene).parent_path();
  base::Hasher hasher;
  for (const scenes::SourceFile& source : sources)
    hasher.add(folder.empty() ? source.file.string() : source.file.lexically_relative(folder).string())
        .add(source.hash);
  return hasher.hex();
}

void add(base::Hasher& hasher, std::vector<Condition> conditions) {
  std::ranges::sort(conditions, {}, &Condition::name);
  hasher.addValue(conditions.size());
  for (const Condition& condition : conditions) hasher.add(condition.name).add(condition.value);
}

} // namespace

std::string digestOf(const std::vector<Condition>& conditions) {
  base::Hasher hasher;
  add(hasher, conditions);
  return hasher.hex();
}

report::SceneInputs inputsOf(const SceneRequest& request, const Conditions& conditions,
                             const std::vector<scenes::SourceFile>& sources) {
  report::SceneInputs inputs;
  inputs.asset = assetOf(request, sources);
  const scenes::SceneSettings& scene = request.settings.scene;
  if (!scene.environment.empty()) inputs.environment = hashOfText(valueOf(conditions.scene, kEnvironment));
  if (!scene.baked.empty()) inputs.bake = hashOfText(valueOf(conditions.scene, kBake));
  if (conditions.scene.empty()) return inputs;
  std::vector<Condition> own = reported(conditions.scene);
  std::erase_if(own, [](const Condition& each) { return each.name == kEnvironment || each.name == kBake; });
  base::Hasher hasher;
  add(hasher, own);
  for (std::size_t v = 0; v < conditions.views.size(); ++v) {
    hasher.add(request.views[v].name);
    add(hasher, reported(conditions.views[v]));
  }
  inputs.request = hasher.hex();
  return inputs;
}

} // namespace parity::job

#include "job/conditions.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "job/condition_text.h"
#include "job/knobs.h"
#include "job/paths.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

using compare::ActsOn;
using compare::Condition;

std::string contentOf(const std::filesystem::path& file) {
  try {
    return base::hashOfFile(file);
  } catch (const base::Error&) { // loading it will say so
    return "not readable";
  }
}

// A file or folder by its content, and for people by its name, too; from an absolute path no more than that is said.
void countByContent(Condition& condition, const std::string& path) {
  const std::filesystem::path given(path), own = given.has_filename() ? given : given.parent_path(); // "folder/"
  // The manifest of a bake names every other file of it by content.
  const std::filesystem::path file = std::filesystem::is_directory(given) ? given / bake::kManifestFile : given;
  condition.value = contentOf(file);
  condition.words =
      fmt::format("{} (content {})", scenes::cleanName(own.filename().string()), condition.value.substr(0, 12));
}

template <typename T> Condition conditionOf(const base::KnobRow<T>& row, const T& settings) {
  Condition condition{row.knob.title, row.text(settings), row.knob.actsOn};
  if (row.words) condition.words = row.words(settings);
  return condition;
}

// Of all knobs that do anything, in their order.
std::vector<Condition> allConditions(const Settings& settings, const gpu::DeviceReport& device, bool ofScene) {
  Settings taken = settings;
  std::string why; // the device takes another value
  for (const paths::Path* path : allPaths())
    if (std::string reason = path->adapt(taken.options, device); !reason.empty()) why = reason;
  std::vector<Condition> conditions;
  for (const base::KnobRow<Settings>& row : knobs().rows()) {
    if (row.knob.ofScene != ofScene || !row.knob.isCondition || !isActive(row.knob, settings)) continue;
    Condition& condition = conditions.emplace_back(conditionOf(row, taken));
    if (!why.empty() && condition.value != row.text(settings)) condition.words = condition.value + ", " + why;
    const std::string path = row.path ? row.path(settings) : "";
    if (path.empty()) continue;
    if (scenes::isBuiltin(path)) {
      condition.value = path;
      continue;
    }
    countByContent(condition, path);
    const std::string name = condition.name;
    conditions.push_back({"file of the " + name, path, ActsOn::nothing}); // as warnings name it
  }
  return conditions;
}

std::vector<Condition> sceneConditions(const Settings& run, const SceneRequest& request,
                                       const gpu::DeviceReport& device) {
  std::vector<Condition> conditions = {
      {"name", request.name, ActsOn::nothing},
      {"file", request.scene, ActsOn::nothing}, // its content is looked at when it is known which files are read
      {"places of captures", placesText(request.captures), ActsOn::nothing}}; // `parity bake` alone reads them
  for (const scenes::ExternalPictures& each : request.externals) // their pictures' content, too, is looked at then
    conditions.push_back(
        {"pictures of " + each.name,
         fmt::format("{}\n{}\n{}\n{}\n{}", each.test, each.reference, each.transfer, each.replaces, each.calibration),
         ActsOn::nothing});
  const std::vector<Condition> own = allConditions(request.settings, device, true);
  conditions.insert(conditions.end(), own.begin(), own.end());
  const std::vector<Condition> ofRun = runConditions(run, device);
  for (const Condition& condition : runConditions(request.settings, device)) {
    const auto same = [&](const Condition& other) {
      return other.name == condition.name && other.value == condition.value;
    };
    if (std::ranges::none_of(ofRun, same)) conditions.push_back(condition);
  }
  return conditions;
}

std::vector<Condition> viewConditions(const scenes::ViewRequest& view) {
  std::vector<Condition> conditions = {{"view", view.name, ActsOn::nothing}};
  for (const base::KnobRow<scenes::ViewRequest>& row : scenes::viewKnobs().rows())
    conditions.push_back(conditionOf(row, view));
  return conditions;
}

} // namespace

std::vector<Condition> runConditions(const Settings& run, const gpu::DeviceReport& device) {
  return allConditions(run, device, false);
}

Conditions conditionsOf(const Settings& run, const SceneRequest& request, const gpu::DeviceReport& device) {
  Conditions conditions{runConditions(run, device), sceneConditions(run, request, device), {}};
  for (const scenes::ViewRequest& view : request.views) conditions.views.push_back(viewConditions(view));
  return conditions;
}

std::vector<Condition> reported(const std::vector<Condition>& conditions) {
  std::vector<Condition> some;
  for (const Condition& condition : conditions)
    if (condition.actsOn != ActsOn::nothing) some.push_back(condition);
  return some;
}

std::string hashOf(const Conditions& conditions) {
  base::Hasher hasher;
  const auto add = [&](std::vector<Condition> list) {
    std::ranges::sort(list, {}, &Condition::name); // whether the run says it or the scene
    hasher.addValue(list.size());
    for (const Condition& condition : list) hasher.add(condition.name).add(condition.value);
  };
  add(compare::overlaid(conditions.run, conditions.scene));
  for (const std::vector<Condition>& view : conditions.views) add(view);
  return hasher.hex();
}

std::vector<std::pair<std::string, std::string>> describeSettings(const Settings& settings,
                                                                  const gpu::DeviceReport& device) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const Condition& condition : reported(runConditions(settings, device)))
    texts.emplace_back(condition.name, condition.text());
  return texts;
}

} // namespace parity::job

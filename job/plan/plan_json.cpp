#include "job/plan/plan_json.h"
#include "job/plan/plan_folder.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/knob/knob.h"
#include "base/member_count.h"
#include "job/knobs.h"
#include "report/again.h"

namespace parity::job {

namespace {

using nlohmann::ordered_json;
constexpr int kFormat = 1;

ordered_json toJson(const std::optional<std::string>& text) { return text ? ordered_json(*text) : ordered_json(); }
std::optional<std::string> textOrNone(const ordered_json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<std::string>());
}

ordered_json toJson(const base::GivenKnobs& given) {
  ordered_json json = ordered_json::object();
  for (const auto& [id, knob] : given) json[id] = knob.value;
  return json;
}
base::GivenKnobs givenFrom(const ordered_json& json) {
  base::GivenKnobs given;
  for (const auto& [id, value] : json.items()) {
    if (!knobs().find(id)) throw std::runtime_error("'" + id + "' is no setting");
    given[id] = {value.get<base::KnobValue>(), std::string(kPlanFile) + ": " + id};
  }
  return given;
}

// What a subcommand begins with, where it is not what every other does.
base::GivenKnobs knobsOf(const Settings& settings) {
  static const Settings kNone;
  base::GivenKnobs given;
  for (const base::KnobRow<Settings>& row : knobs().rows())
    if (const std::string text = row.text(settings); text != row.text(kNone)) given[row.knob.id] = {{text}, {}};
  return given;
}

static_assert(base::memberCount<gpu::DeviceOptions>() == 2, "a new member goes into the plan");
ordered_json plainJson(const Settings& plain) {
  return {{"knobs", toJson(knobsOf(plain))},
          {"budgets", toJson(plain.budgets)},
          {"device", plain.device.name},
          {"validation", plain.device.validation},
          {"cache", plain.cacheFolder ? ordered_json(plain.cacheFolder->string()) : ordered_json()},
          {"cacheBytes", plain.cacheBytes}};
}
Settings plainFrom(const ordered_json& json) {
  Settings plain;
  knobs().apply(plain, givenFrom(json.at("knobs")));
  plain.budgets = textOrNone(json.at("budgets"));
  plain.device = {json.at("device"), json.at("validation")};
  if (const auto cache = textOrNone(json.at("cache"))) plain.cacheFolder = *cache;
  plain.cacheBytes = json.at("cacheBytes");
  return plain;
}

ordered_json toJson(const std::optional<glm::vec3>& v) { return v ? ordered_json{v->x, v->y, v->z} : ordered_json(); }
std::optional<glm::vec3> vectorFrom(const ordered_json& json) {
  if (json.is_null()) return std::nullopt;
  return glm::vec3(json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>());
}

static_assert(base::memberCount<scenes::ViewRequest>() == 5, "a new member goes into the plan");
ordered_json toJson(const scenes::ViewRequest& view) {
  return {{"name", view.name},
          {"camera", view.camera},
          {"orbit", toJson(view.orbit)},
          {"target", toJson(view.target)},
          {"fov", view.fovYDeg}};
}
scenes::ViewRequest viewFrom(const ordered_json& json) {
  return {json.at("name"), json.at("camera"), vectorFrom(json.at("orbit")), vectorFrom(json.at("target")),
          json.at("fov")};
}

static_assert(base::memberCount<scenes::ExternalPictures>() == 7, "a new member goes into the plan");
ordered_json toJson(const scenes::ExternalPictures& external) {
  return {{"name", external.name},         {"test", external.test},         {"reference", external.reference},
          {"transfer", external.transfer}, {"replaces", external.replaces}, {"calibration", external.calibration},
          {"where", external.where}};
}
scenes::ExternalPictures externalFrom(const ordered_json& json) {
  return {json.at("name"),     json.at("test"),        json.at("reference"), json.at("transfer"),
          json.at("replaces"), json.at("calibration"), json.at("where")};
}

// Without the places of captures, which `parity bake` alone reads; its settings are made of what was given.
static_assert(base::memberCount<SceneRequest>() == 10 && base::memberCount<WholeRun>() == 3,
              "a new member goes into the plan, or is named here with the reason why not");
ordered_json toJson(const SceneRequest& scene) {
  ordered_json views = ordered_json::array();
  for (const scenes::ViewRequest& view : scene.views) views.push_back(toJson(view));
  ordered_json json = {{"name", scene.name}, {"file", scene.scene}, {"given", toJson(scene.given)}, {"views", views}};
  if (scene.budgets) json["budgets"] = *scene.budgets;
  if (!scene.captures.empty()) {
    json["captures"] = ordered_json::array();
    for (const glm::vec3& place : scene.captures) json["captures"].push_back(toJson(std::optional(place)));
  }
  for (const scenes::ExternalPictures& each : scene.externals) json["externals"].push_back(toJson(each));
  if (scene.partOf) json["partOf"] = {scene.partOf->place, scene.partOf->scenes, scene.partOf->views};
  return json;
}
SceneRequest sceneFrom(const ordered_json& json, const Settings& plain) {
  SceneRequest scene{
      .name = json.at("name"), .scene = json.at("file"), .settings = {}, .captures = {}, .views = {}, .budgets = {}};
  scene.given = givenFrom(json.at("given"));
  scene.settings = withKnobs(plain, scene.given);
  for (const ordered_json& view : json.at("views")) scene.views.push_back(viewFrom(view));
  if (json.contains("captures"))
    for (const ordered_json& place : json.at("captures")) scene.captures.push_back(vectorFrom(place).value());
  if (json.contains("budgets")) scene.budgets = json.at("budgets");
  if (json.contains("externals"))
    for (const ordered_json& each : json.at("externals")) scene.externals.push_back(externalFrom(each));
  if (json.contains("partOf")) {
    const ordered_json& part = json.at("partOf");
    scene.partOf = WholeRun{part.at(0), part.at(1), part.at(2)};
  }
  return scene;
}

// Without what the merge is told: folder, bench, warningsFail, findEarlier and explain.
static_assert(base::memberCount<ReportRequest>() == 19, "a new member goes into the plan, or is named here");
ordered_json toJson(const ReportRequest& request) {
  ordered_json again = ordered_json::array();
  for (const report::AgainCommand& each : request.again) again.push_back({each.scene, each.view, each.command});
  return {{"suite", request.suite},
          {"suiteBudgets", toJson(request.suiteBudgets)},
          {"baseline", request.baseline.string()},
          {"approvals", request.approvals},
          {"asOf", request.asOf},
          {"only", request.only},
          {"oneOfMany", request.oneOfMany},
          {"pictures", kPicturesNames.at(static_cast<std::size_t>(request.pictures))},
          {"pixelData", request.pixelData},
          {"singleFile", request.singleFile},
          {"commandLine", request.commandLine},
          {"again", again},
          {"sentinels", request.sentinels}};
}
ReportRequest requestFrom(const ordered_json& json) {
  ReportRequest request{.scenes = {},
                        .suite = json.at("suite"),
                        .suiteBudgets = textOrNone(json.at("suiteBudgets")),
                        .folder = {},
                        .baseline = json.at("baseline").get<std::string>(),
                        .approvals = json.at("approvals"),
                        .asOf = json.at("asOf"),
                        .only = json.at("only"),
                        .oneOfMany = json.at("oneOfMany"),
                        .pixelData = json.at("pixelData"),
                        .singleFile = json.at("singleFile"),
                        .bench = {},
                        .commandLine = json.at("commandLine")};
  const std::vector<std::string> names(kPicturesNames.begin(), kPicturesNames.end());
  try {
    request.pictures = static_cast<Pictures>(base::readChoice(json.at("pictures"), names));
  } catch (const base::KnobError& error) {
    throw std::runtime_error(error.reason);
  }
  request.sentinels = json.at("sentinels").get<std::vector<std::size_t>>();
  for (const ordered_json& each : json.at("again")) request.again.push_back({each.at(0), each.at(1), each.at(2)});
  return request;
}

ordered_json toJson(const RunFacts& facts) {
  ordered_json conditions = ordered_json::array();
  for (const compare::Condition& c : facts.conditions)
    conditions.push_back({c.name, c.value, static_cast<int>(c.actsOn), c.words});
  return {{"device", facts.device}, {"driver", facts.driver}, {"settings", facts.settings}, {"conditions", conditions}};
}
RunFacts factsFrom(const ordered_json& json) {
  RunFacts facts{json.at("device"), json.at("driver"), json.at("settings"), {}};
  for (const ordered_json& c : json.at("conditions")) {
    const int actsOn = c.at(2);
    if (actsOn < 0 || actsOn > static_cast<int>(compare::ActsOn::nothing)) throw std::runtime_error("a condition");
    facts.conditions.push_back({c.at(0), c.at(1), static_cast<compare::ActsOn>(actsOn), c.at(3)});
  }
  return facts;
}

// Each scene in one of them.
void requireShards(const Plan& plan) {
  std::vector<int> count(plan.request.scenes.size());
  for (const std::vector<std::size_t>& shard : plan.shards)
    for (const std::size_t scene : shard) ++count.at(scene);
  if (plan.request.scenes.empty()) throw std::runtime_error("it has no scene");
  if (plan.shards.empty() || std::ranges::any_of(count, [](int n) { return n != 1; }))
    throw std::runtime_error("its shards do not hold each scene once");
}

} // namespace

std::string planText(const Plan& plan, bool withShards) {
  ordered_json scenes = ordered_json::array();
  for (const SceneRequest& scene : plan.request.scenes) scenes.push_back(toJson(scene));
  ordered_json json = {{"plan", kFormat},
                       {"version", plan.version},
                       {"build", plan.build},
                       {"numerics", plan.numerics},
                       {"facts", toJson(plan.facts)},
                       {"plain", plainJson(plan.plain)},
                       {"given", toJson(plan.given)},
                       {"report", toJson(plan.request)},
                       {"baseline", plan.baseline},
                       {"budgets", plan.budgets},
                       {"scenes", scenes}};
  if (withShards) json["sceneBaselines"] = plan.sceneBaselines, json["shards"] = plan.shards;
  try {
    return json.dump(1) + "\n";
  } catch (const ordered_json::type_error&) {
    throw base::fileError(kPlanFile, "", "a path or a name of the run is not UTF-8; rename it");
  }
}

Plan planFromText(std::string_view text) {
  const ordered_json json = ordered_json::parse(text);
  if (json.at("plan") != kFormat) throw std::runtime_error("its format is of another version");
  Plan plan{json.at("version"), json.at("build"), json.at("numerics"), {}, {}, {}, {}, {}, {}, {}, {}, {}};
  plan.facts = factsFrom(json.at("facts"));
  plan.facts.build = plan.build, plan.facts.numerics = plan.numerics;
  plan.plain = plainFrom(json.at("plain"));
  plan.given = givenFrom(json.at("given"));
  plan.request = requestFrom(json.at("report"));
  plan.baseline = json.at("baseline");
  plan.budgets = json.at("budgets").get<FrozenFiles>();
  for (const ordered_json& scene : json.at("scenes")) plan.request.scenes.push_back(sceneFrom(scene, plan.plain));
  plan.sceneBaselines = json.at("sceneBaselines").get<std::vector<std::string>>();
  if (!plan.baseline.empty() && plan.sceneBaselines.size() != plan.request.scenes.size())
    throw std::runtime_error("it does not say the baseline of each scene");
  plan.shards = json.at("shards").get<std::vector<std::vector<std::size_t>>>();
  requireShards(plan);
  return plan;
}

} // namespace parity::job

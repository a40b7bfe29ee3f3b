#include "study/explain/explain_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/text/shown_text.h"
#include "base/version.h"
#include "study/explain/advice.h"

namespace parity::explain {

namespace {

using nlohmann::ordered_json;

std::string countOf(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string signedText(double value) { return fmt::format("{:+.3f}", value); }

void addMaterial(std::string& text, const MaterialExplanation& m, const std::vector<Switch>& switches) {
  text += fmt::format("\n{}: mean FLIP {:.3f}, limit {:g}, {} pixels\n", base::plainLine(m.name), m.flip.front(),
                      m.limit, m.pixels);
  for (const std::string& sentence : m.advice) text += fmt::format("  {}\n", sentence);
  const Cost today = m.best.front().cost;
  text += "  best set of each size\n";
  for (const SetOutcome& set : m.best)
    text += fmt::format("    {:.3f}  {}{}\n", set.flip, namesOf(switches, set.mask),
                        set.mask == 0 ? fmt::format(" ({} operations, {} fetches)", today.operations, today.fetches)
                                      : ": " + describeCost(set.cost, today));
  text += "  what each switch takes off: alone, and its share of all\n";
  for (std::size_t i = 0; i < switches.size(); ++i)
    text += fmt::format("    {:>7} {:>7}  {}{}{}\n", signedText(m.flip.front() - m.alone[i].flip),
                        i < m.worth.size() ? signedText(m.worth[i]) : "", switches[i].id(),
                        switches[i].cheapens ? ": " + describeCost(m.alone[i].cost, today) : "",
                        (m.changing >> i & 1) != 0 ? " (the last of all it does the opposite)" : "");
}

ordered_json toJson(const Cost& cost) { return {{"operations", cost.operations}, {"fetches", cost.fetches}}; }

ordered_json namesIn(const std::vector<Switch>& switches, SwitchMask mask) {
  ordered_json names = ordered_json::array();
  for (std::size_t i = 0; i < switches.size(); ++i)
    if ((mask >> i & 1) != 0) names.push_back(switches[i].id());
  return names;
}

ordered_json toJson(const SetOutcome& set, const std::vector<Switch>& switches) {
  return {{"set", namesIn(switches, set.mask)},
          {"flip", set.flip},
          {"cost", toJson(set.cost)},
          {"rendered", set.rendered ? ordered_json(*set.rendered) : ordered_json()}};
}

ordered_json toJson(const MaterialExplanation& m, const std::vector<Switch>& switches) {
  ordered_json json = {{"name", m.name}, {"pixels", m.pixels}, {"limit", m.limit}, {"flip", m.flip.front()}};
  json["advice"] = m.advice;
  for (const auto& [key, sets] : {std::pair{"best", &m.best}, {"alone", &m.alone}, {"cheaper", &m.cheaper}}) {
    json[key] = ordered_json::array();
    for (const SetOutcome& set : *sets) json[key].push_back(toJson(set, switches));
  }
  json["repair"] = namesIn(switches, m.repair);
  json["asset"] = nullptr;
  if (m.asset)
    json["asset"] = {{"quantity", m.asset->quantity},
                     {"factor", m.asset->factor},
                     {"value", m.asset->value ? ordered_json(*m.asset->value) : ordered_json()},
                     {"flip", m.asset->flip}};
  json["worth"] = m.worth;
  json["changesSign"] = namesIn(switches, m.changing);
  json["ranges"] = ordered_json::array();
  for (const RangeShare& r : m.ranges)
    json["ranges"].push_back(
        {{"quantity", r.quantity}, {"from", r.from}, {"to", r.to}, {"pixels", r.pixels}, {"flip", r.error}});
  json["flipOfSets"] = m.flip; // bit i of a place is switch i
  return json;
}

ordered_json toJson(const SceneExplanation& scene) {
  ordered_json json = {{"scene", scene.scene},
                       {"environment", scene.environment},
                       {"view", scene.view},
                       {"width", scene.width},
                       {"height", scene.height}};
  if (!scene.failure.empty()) {
    json["error"] = scene.failure;
    return json;
  }
  json["switches"] = ordered_json::array();
  for (const Switch& each : scene.switches) {
    ordered_json knobs = ordered_json::object();
    for (const auto& [id, value] : each.knobs) knobs[id] = value;
    json["switches"].push_back(
        {{"id", each.id()}, {"words", each.words}, {"approximation", each.approximation}, {"knobs", knobs}});
  }
  json["skipped"] = ordered_json::array();
  for (const Skipped& each : scene.skipped) json["skipped"].push_back({{"switch", each.what}, {"reason", each.why}});
  json["tooSmall"] = scene.tooSmall;
  json["materials"] = ordered_json::array();
  for (const MaterialExplanation& m : scene.materials) json["materials"].push_back(toJson(m, scene.switches));
  return json;
}

} // namespace

std::string toText(const SceneExplanation& scene, bool allMaterials) {
  if (!scene.failure.empty()) return {};
  std::string text =
      fmt::format("{} ({}, {}x{}): {} of {}\n", base::plainLine(scene.scene), base::plainLine(scene.environment),
                  scene.width, scene.height, countOf(std::size_t{1} << scene.switches.size(), "set", "sets"),
                  countOf(scene.switches.size(), "switch", "switches"));
  for (const Switch& each : scene.switches) text += fmt::format("  {}: {}\n", each.id(), each.words);
  for (const Skipped& each : scene.skipped) text += fmt::format("  not tried: {} ({})\n", each.what, each.why);
  std::vector<const MaterialExplanation*> order;
  std::size_t quiet = 0;
  for (const MaterialExplanation& m : scene.materials)
    if (allMaterials || m.flip.front() > m.limit || !m.advice.empty())
      order.push_back(&m);
    else
      ++quiet;
  std::ranges::stable_sort(order, std::greater(), [](const auto* m) { return m->flip.front() - m->limit; });
  for (const MaterialExplanation* m : order) addMaterial(text, *m, scene.switches);
  for (const std::string& name : scene.tooSmall)
    text += fmt::format("\n{}: too small to judge; give a larger --size\n", base::plainLine(name));
  if (quiet > 0)
    text += fmt::format("\n{} within the limit, with nothing to save; --all shows them\n",
                        countOf(quiet, "material is", "materials are"));
  return text;
}

std::string toText(const TeamView& team) {
  if (team.materials < 2 || team.sets.size() < 2) return {};
  std::string text = fmt::format("\nFor all {} materials: the set of each size that brings most within their limits\n",
                                 team.materials);
  for (const TeamSet& set : team.sets)
    text += fmt::format("  {:>4} within, mean FLIP {:.3f}, {:+.0f} operations a pixel  {}\n", set.within, set.meanFlip,
                        set.operations,
                        set.switches.empty() ? "nothing" : fmt::format("{}", fmt::join(set.switches, " + ")));
  return text;
}

std::string toJson(const std::vector<SceneExplanation>& scenes, const TeamView& team, const std::string& commandLine) {
  ordered_json json = {{"format", kExplainFormat}, {"version", base::kVersion}, {"commandLine", commandLine}};
  json["scenes"] = ordered_json::array();
  for (const SceneExplanation& scene : scenes) json["scenes"].push_back(toJson(scene));
  json["team"] = {{"materials", team.materials}, {"sets", ordered_json::array()}};
  for (const TeamSet& set : team.sets)
    json["team"]["sets"].push_back(
        {{"set", set.switches}, {"within", set.within}, {"meanFlip", set.meanFlip}, {"operations", set.operations}});
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n"; // names may hold any bytes
}

} // namespace parity::explain

// report.json back as a Report: every value is there and of its type, or the place of it is named.
#include "compare/report_reader.h"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "compare/statistic.h"

namespace parity::compare {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
constexpr std::array kVerdicts = {Verdict::pass, Verdict::notSeen, Verdict::tooSmall, Verdict::notJudged,
                                  Verdict::warn, Verdict::fail,    Verdict::error};

// A value and the way to it.
class Node {
public:
  Node(const json& value, std::string file, std::string place)
      : m_value(value), m_file(std::move(file)), m_place(std::move(place)) {}

  [[noreturn]] void refuse(const std::string& reason) const {
    throw base::fileError(m_file, m_place.empty() ? "/" : m_place, reason);
  }
  Node at(const std::string& key) const {
    if (!m_value.is_object()) refuse("is not an object");
    const auto found = m_value.find(key);
    if (found == m_value.end()) refuse(fmt::format("lacks '{}'", key));
    return {*found, m_file, m_place + "/" + key};
  }
  bool has(const std::string& key) const { return m_value.is_object() && m_value.contains(key); }
  std::vector<Node> items() const {
    if (!m_value.is_array()) refuse("is not a list");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < m_value.size(); ++i)
      nodes.emplace_back(m_value[i], m_file, m_place + "/" + std::to_string(i));
    return nodes;
  }
  std::vector<std::pair<std::string, Node>> members() const {
    if (!m_value.is_object()) refuse("is not an object");
    std::vector<std::pair<std::string, Node>> nodes;
    for (const auto& [key, value] : m_value.items()) nodes.emplace_back(key, Node(value, m_file, m_place + "/" + key));
    return nodes;
  }
  bool isNull() const { return m_value.is_null(); }
  std::string text() const {
    if (!m_value.is_string()) refuse("is not a text");
    return m_value.get<std::string>();
  }
  double number() const {
    if (!m_value.is_number()) refuse("is not a number");
    return m_value.get<double>();
  }
  std::uint64_t count() const {
    if (!m_value.is_number_unsigned()) refuse("is not a whole number of at least 0");
    return m_value.get<std::uint64_t>();
  }

private:
  const json& m_value;
  std::string m_file, m_place;
};

Verdict readVerdict(const Node& node) {
  const std::string name = node.text();
  for (const Verdict verdict : kVerdicts)
    if (name == nameOf(verdict)) return verdict;
  node.refuse(fmt::format("'{}' is no verdict", name));
}

double readFigure(const std::string& name, const Node& node) {
  if (!node.isNull()) return node.number();
  const std::optional<Statistic> statistic = statisticByName(name);
  return statistic && statistic->better == Better::higher && std::isinf(statistic->most) ? INFINITY : NAN;
}

Figures readFigures(const Node& node) {
  Figures figures;
  if (node.isNull()) return figures;
  figures.pixels = node.at("pixels").count();
  figures.nonFinite = node.at("nonFinite").count();
  for (const auto& [name, value] : node.at("metrics").members())
    figures.values.push_back({name, readFigure(name, value)});
  return figures;
}

std::vector<Condition> readConditions(const Node& node) {
  std::vector<Condition> conditions;
  for (const Node& each : node.items()) {
    Condition& condition = conditions.emplace_back();
    condition.name = each.at("name").text();
    condition.value = each.at("value").text();
    const std::string actsOn = each.at("actsOn").text();
    const std::optional<ActsOn> known = actsOnByName(actsOn);
    if (!known) each.at("actsOn").refuse(fmt::format("'{}' is not what a condition acts on", actsOn));
    condition.actsOn = *known;
    if (each.has("words")) condition.words = each.at("words").text();
  }
  return conditions;
}

ViewResult readView(const Node& node) {
  ViewResult view;
  view.name = node.at("name").text();
  view.conditions = readConditions(node.at("conditions"));
  view.verdict = readVerdict(node.at("verdict"));
  view.wholeVerdict = readVerdict(node.at("whole").at("verdict"));
  view.whole = readFigures(node.at("whole").at("figures"));
  for (const Node& each : node.at("materials").items()) {
    MaterialResult& material = view.materials.emplace_back();
    material.name = each.at("name").text();
    material.verdict = readVerdict(each.at("verdict"));
    material.figures = readFigures(each.at("figures"));
  }
  return view;
}

SceneResult readScene(const Node& node) {
  SceneResult scene;
  scene.name = node.at("name").text();
  scene.environment = node.at("environment").text();
  scene.sun = node.at("sun").text();
  if (node.has("light")) scene.light = node.at("light").text();
  scene.conditions = readConditions(node.at("conditions"));
  scene.verdict = readVerdict(node.at("verdict"));
  if (!node.at("error").isNull()) scene.error = node.at("error").at("message").text();
  for (const Node& view : node.at("views").items()) scene.views.push_back(readView(view));
  return scene;
}

} // namespace

std::filesystem::path reportFileOf(const std::filesystem::path& fileOrFolder) {
  std::error_code ignored;
  return std::filesystem::is_directory(fileOrFolder, ignored) ? fileOrFolder / "report.json" : fileOrFolder;
}

Report readReport(const std::filesystem::path& fileOrFolder) {
  const std::filesystem::path path = reportFileOf(fileOrFolder);
  const std::string text = base::readText(path, kMaxBytes);
  json document;
  try {
    document = json::parse(text);
  } catch (const json::parse_error& error) {
    throw base::fileError(path.string(), fmt::format("byte {}", error.byte), "is no JSON");
  }
  const Node root(document, path.string(), "");
  const std::uint64_t schema = root.at("schema").count();
  if (schema != kReportSchema)
    root.at("schema").refuse(fmt::format("is {}, of {} version of parity; this one reads {}: make the report again",
                                         schema, schema > kReportSchema ? "a newer" : "an older", kReportSchema));
  Report report;
  report.version = root.at("version").text();
  report.device = root.at("device").text();
  report.verdict = readVerdict(root.at("verdict"));
  for (const Node& setting : root.at("settings").items())
    report.settings.emplace_back(setting.at("name").text(), setting.at("value").text());
  report.conditions = readConditions(root.at("conditions"));
  for (const Node& scene : root.at("scenes").items()) report.scenes.push_back(readScene(scene));
  return report;
}

} // namespace parity::compare

// Reading a budget file (TOML): every key is known or refused, every limit makes sense or is refused.
#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "compare/budget.h"

namespace parity::compare {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
using Names = std::span<const std::string_view>;

constexpr std::string_view kRootKeys[] = {"material", "whole"};
constexpr std::string_view kMaterialKeys[] = {"name", "scene", "checks", "require_seen", "reason", "owner"};
constexpr std::string_view kWholeKeys[] = {"scene", "checks", "reason", "owner"};
constexpr std::string_view kCheckKeys[] = {"metric", "region", "warn", "fail"};

class Reader {
public:
  explicit Reader(const std::filesystem::path& file) : m_file(file.string()), m_short(file.filename().string()) {}

  Budgets read(const toml::table& root) const {
    refuseUnknown(root, kRootKeys);
    Budgets budgets;
    if (const toml::node* rules = root.get("material"))
      for (const toml::table* rule : tablesOf(*rules, "material")) budgets.materials.push_back(materialRule(*rule));
    if (const toml::node* rules = root.get("whole"))
      for (const toml::table* rule : tablesOf(*rules, "whole")) budgets.wholes.push_back(wholeRule(*rule));
    if (budgets.materials.empty() && budgets.wholes.empty())
      throw base::fileError(m_file, "", "no rules: expected at least one [[material]] or [[whole]]");
    refuseHidden(budgets.materials);
    refuseHidden(budgets.wholes);
    return budgets;
  }

  [[noreturn]] void refuse(const toml::source_region& where, const std::string& reason) const {
    throw base::fileError(m_file, fmt::format("line {}", where.begin.line), reason);
  }

private:
  static std::string suggest(std::string_view name, Names known) {
    const std::string nearest = base::nearestName(name, known);
    if (base::editDistance(name, nearest) * 2 <= std::max(name.size(), nearest.size()))
      return fmt::format("did you mean '{}'?", nearest);
    return fmt::format("known: {}", fmt::join(known, ", "));
  }

  void refuseUnknown(const toml::table& table, Names known) const {
    for (const auto& [key, node] : table)
      if (std::ranges::find(known, key.str()) == known.end())
        refuse(key.source(), fmt::format("unknown key '{}'; {}", key.str(), suggest(key.str(), known)));
  }

  std::vector<const toml::table*> tablesOf(const toml::node& node, std::string_view key) const {
    const toml::array* array = node.as_array();
    if (!array) refuse(node.source(), fmt::format("'{0}' must be an array of tables: [[{0}]]", key));
    std::vector<const toml::table*> tables;
    for (const toml::node& element : *array) {
      if (!element.is_table()) refuse(element.source(), fmt::format("an entry of '{}' is not a table", key));
      tables.push_back(element.as_table());
    }
    return tables;
  }

  std::string textOf(const toml::table& table, std::string_view key, std::string fallback) const {
    const toml::node* node = table.get(key);
    if (!node) return fallback;
    const auto* text = node->as_string();
    if (!text) refuse(node->source(), fmt::format("'{}' must be a string", key));
    if (text->get().empty()) refuse(node->source(), fmt::format("'{}' is empty", key));
    return text->get();
  }

  BudgetRule commonRule(const toml::table& table, Region region) const {
    BudgetRule rule;
    rule.scene = textOf(table, "scene", "*");
    rule.reason = textOf(table, "reason", "");
    rule.owner = textOf(table, "owner", "");
    rule.origin = fmt::format("{}, line {}", m_short, table.source().begin.line);
    const toml::node* checks = table.get("checks");
    if (!checks) refuse(table.source(), "the rule has no 'checks'");
    std::set<std::pair<Metric, Region>> seen;
    for (const toml::table* check : tablesOf(*checks, "checks")) {
      rule.checks.push_back(readCheck(*check, region));
      if (!seen.emplace(rule.checks.back().metric, rule.checks.back().region).second)
        refuse(check->source(), fmt::format("'{}' over {} pixels is checked twice", nameOf(rule.checks.back().metric),
                                            nameOf(rule.checks.back().region)));
    }
    if (rule.checks.empty()) refuse(checks->source(), "'checks' is empty: the rule would pass everything");
    return rule;
  }

  BudgetRule materialRule(const toml::table& table) const {
    refuseUnknown(table, kMaterialKeys);
    BudgetRule rule = commonRule(table, Region::interior);
    if (!table.contains("name")) refuse(table.source(), "the rule has no 'name' (a glob over material names)");
    rule.material = textOf(table, "name", "*");
    if (const toml::node* node = table.get("require_seen")) {
      if (!node->is_boolean()) refuse(node->source(), "'require_seen' must be true or false");
      rule.requireSeen = node->as_boolean()->get();
    }
    return rule;
  }

  // No neighbour's error bleeds into a whole image, so all its pixels count unless the file says otherwise.
  BudgetRule wholeRule(const toml::table& table) const {
    refuseUnknown(table, kWholeKeys);
    return commonRule(table, Region::all);
  }

  BudgetCheck readCheck(const toml::table& table, Region region) const {
    refuseUnknown(table, kCheckKeys);
    BudgetCheck check;
    if (!table.contains("metric")) refuse(table.source(), "the check has no 'metric'");
    const std::string metric = textOf(table, "metric", "");
    const std::optional<Metric> known = metricByName(metric);
    if (!known)
      refuse(table.get("metric")->source(),
             fmt::format("unknown metric '{}'; {}", metric, suggest(metric, kMetricNames)));
    check.metric = *known;
    const std::string where = textOf(table, "region", std::string(nameOf(region)));
    const auto name = std::ranges::find(kRegionNames, where);
    if (name == kRegionNames.end())
      refuse(table.get("region")->source(),
             fmt::format("unknown region '{}'; {}", where, suggest(where, kRegionNames)));
    check.region = static_cast<Region>(name - kRegionNames.begin());
    check.warn = readLimit(table, "warn", check.metric);
    check.fail = readLimit(table, "fail", check.metric);
    if (!check.warn && !check.fail) refuse(table.source(), "the check has neither 'warn' nor 'fail'");
    const bool lowerBound = check.metric == Metric::psnr;
    if (check.warn && check.fail && (lowerBound ? *check.warn < *check.fail : *check.warn > *check.fail))
      refuse(table.source(), fmt::format("'warn' ({}) lies {} 'fail' ({}): it could never warn", *check.warn,
                                         lowerBound ? "below" : "above", *check.fail));
    return check;
  }

  std::optional<double> readLimit(const toml::table& table, std::string_view key, Metric metric) const {
    const toml::node* node = table.get(key);
    if (!node) return std::nullopt;
    const std::optional<double> value = node->value<double>();
    if (!node->is_number() || !value) refuse(node->source(), fmt::format("'{}' must be a number", key));
    if (!std::isfinite(*value)) refuse(node->source(), fmt::format("'{}' is not a finite number", key));
    // 16-bit images that differ by one step in one channel of one of 2^28 pixels have 185 dB.
    const double most = metric == Metric::psnr ? 200 : 1;
    if (*value < 0 || *value > most)
      refuse(node->source(),
             fmt::format("'{}' is {}, outside the range 0..{} of {}", key, *value, most, nameOf(metric)));
    return value;
  }

  // A rule below one that takes everything never judges: its author believes in limits that nobody checks.
  void refuseHidden(const std::vector<BudgetRule>& rules) const {
    for (std::size_t later = 1; later < rules.size(); ++later)
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        const auto takes = [](const std::string& glob, const std::string& other) {
          return glob == "*" || glob == other;
        };
        if (takes(rules[earlier].material, rules[later].material) && takes(rules[earlier].scene, rules[later].scene))
          throw base::fileError(m_file, rules[later].origin.substr(m_short.size() + 2),
                                fmt::format("the rule of {} matches all that this one could: put this one first",
                                            rules[earlier].origin.substr(m_short.size() + 2)));
      }
  }

  std::string m_file, m_short;
};

} // namespace

Budgets loadBudgets(const std::filesystem::path& file) {
  const std::string text = base::readText(file, kMaxBytes);
  const Reader reader(file);
  toml::table root;
  try {
    root = toml::parse(std::string_view(text), file.string());
  } catch (const toml::parse_error& error) {
    reader.refuse(error.source(), std::string(error.description()));
  }
  Budgets budgets = reader.read(root);
  const Budgets& builtIn = defaultBudgets();
  budgets.materials.insert(budgets.materials.end(), builtIn.materials.begin(), builtIn.materials.end());
  budgets.wholes.insert(budgets.wholes.end(), builtIn.wholes.begin(), builtIn.wholes.end());
  return budgets;
}

} // namespace parity::compare

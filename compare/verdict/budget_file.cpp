// Reading a budget file (TOML): every key is known or refused, every limit makes sense or is refused.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text/nearest.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/budget_keys.h"

namespace parity::compare {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

constexpr std::string_view kRootKeys[] = {"preset", "material", "whole"};
constexpr std::string_view kPresetKeys[] = {"checks", "regress"};
constexpr std::string_view kMaterialKeys[] = {"name",    "scene",        "preset",        "checks",
                                              "regress", "require_seen", "min_pixels",    "reason",
                                              "owner",   "accept",       "max_non_finite"};
constexpr std::string_view kWholeKeys[] = {"scene",  "preset", "checks", "regress",
                                           "reason", "owner",  "accept", "max_non_finite"};
constexpr std::string_view kCheckKeys[] = {"metric", "warn", "fail"};

// Either kind of rule takes its own limits of a built-in preset.
enum class RuleKind { material, whole };

// What a rule demands: its own lists and those of its preset.
struct Checks {
  std::vector<BudgetCheck> levels, regress;
};

// Those of a rule, and those of its preset over figures that the rule does not name itself.
std::vector<BudgetCheck> merge(std::vector<BudgetCheck> own, const std::vector<BudgetCheck>& preset) {
  const std::size_t count = own.size();
  for (const BudgetCheck& check : preset)
    if (std::none_of(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const BudgetCheck& other) { return other.statistic.name == check.statistic.name; }))
      own.push_back(check);
  return own;
}

class Reader : public BudgetKeys {
public:
  using BudgetKeys::BudgetKeys;

  Budgets read(std::string_view text) {
    const toml::table root = parse(text);
    refuseUnknown(root, kRootKeys);
    readPresets(root);
    Budgets budgets;
    if (const toml::node* rules = root.get("material"))
      for (const toml::table* rule : tablesOf(*rules, "material")) budgets.materials.push_back(materialRule(*rule));
    if (const toml::node* rules = root.get("whole"))
      for (const toml::table* rule : tablesOf(*rules, "whole")) budgets.wholes.push_back(wholeRule(*rule));
    if (budgets.materials.empty() && budgets.wholes.empty())
      throw base::fileError(fileName(), "", "has no rules; add a [[material]] or [[whole]]");
    refuseHidden(budgets.materials);
    refuseHidden(budgets.wholes);
    return budgets;
  }

private:
  void readPresets(const toml::table& root) {
    for (const BudgetPreset& preset : builtInPresets()) {
      m_presets[static_cast<int>(RuleKind::material)][preset.name] = {preset.materials, {}};
      m_presets[static_cast<int>(RuleKind::whole)][preset.name] = {preset.wholes, {}};
    }
    const toml::node* node = root.get("preset");
    if (!node) return;
    if (!node->is_table()) refuse(node->source(), "'preset' must hold tables: [preset.NAME]");
    for (const auto& [key, value] : *node->as_table()) {
      const std::string name(key.str());
      if (!value.is_table()) refuse(key.source(), fmt::format("'{0}' must be a table: [preset.{0}]", name));
      if (m_presets[0].contains(name))
        refuse(key.source(), fmt::format("preset '{}' is built in; use another name", name));
      const toml::table& table = *value.as_table();
      refuseUnknown(table, kPresetKeys);
      const Checks checks = readChecks(table, fmt::format("preset '{}'", name));
      for (std::map<std::string, Checks>& presets : m_presets) presets[name] = checks;
    }
  }

  const Checks* presetOf(const toml::table& table, RuleKind kind) const {
    if (!table.contains("preset")) return nullptr;
    const std::string name = textOf(table, "preset", "");
    const std::map<std::string, Checks>& presets = m_presets[static_cast<int>(kind)];
    const auto found = presets.find(name);
    if (found != presets.end()) return &found->second;
    std::vector<std::string_view> known;
    for (const auto& [each, checks] : presets) known.push_back(each);
    refuse(table.get("preset")->source(),
           fmt::format("unknown preset '{}'; {}", name, base::describeNearest(name, known)));
  }

  // Both lists of a table; `owner`, in words, has to have one of them.
  Checks readChecks(const toml::table& table, const std::string& owner) const {
    Checks checks;
    if (!table.contains("checks") && !table.contains("regress"))
      refuse(table.source(), fmt::format("{} needs 'checks' or 'regress'", owner));
    checks.levels = readList(table, "checks");
    checks.regress = readList(table, "regress");
    return checks;
  }

  std::vector<BudgetCheck> readList(const toml::table& table, std::string_view key) const {
    std::vector<BudgetCheck> list;
    const toml::node* checks = table.get(key);
    if (!checks) return list;
    std::set<std::string> seen;
    for (const toml::table* check : tablesOf(*checks, key)) {
      list.push_back(readCheck(*check, key == "regress"));
      const BudgetCheck& last = list.back();
      if (!seen.insert(last.statistic.name).second)
        refuse(check->source(), fmt::format("'{}' is checked twice", last.statistic.name));
    }
    if (list.empty()) refuse(checks->source(), fmt::format("'{}' is empty, so the rule would always pass", key));
    return list;
  }

  BudgetRule commonRule(const toml::table& table, RuleKind kind) const {
    BudgetRule rule;
    rule.scene = textOf(table, "scene", "*");
    rule.reason = textOf(table, "reason", "");
    rule.owner = textOf(table, "owner", "");
    rule.line = static_cast<int>(table.source().begin.line);
    rule.origin = fmt::format("{}, line {}", shortName(), rule.line);
    rule.file = fileName();
    rule.preset = textOf(table, "preset", "");
    readAccepted(table, kind, rule);
    const Checks* preset = presetOf(table, kind);
    const bool hasOwn = table.contains("checks") || table.contains("regress");
    const bool needsNone = preset || std::ranges::count(rule.accept, Accept::noLimit) > 0;
    const Checks own = hasOwn || !needsNone ? readChecks(table, "the rule") : Checks{};
    rule.checks = preset ? merge(own.levels, preset->levels) : own.levels;
    rule.regress = preset ? merge(own.regress, preset->regress) : own.regress;
    return rule;
  }

  // What is accepted is named, one by one, and has a reason.
  void readAccepted(const toml::table& table, RuleKind kind, BudgetRule& rule) const {
    if (const toml::node* node = table.get("accept")) {
      const toml::array* list = node->as_array();
      if (!list || list->empty()) refuse(node->source(), "'accept' must be a list of what is accepted: [\"not seen\"]");
      for (const toml::node& each : *list) rule.accept.push_back(readAccept(each, kind, rule.accept));
      if (rule.reason.empty()) refuse(node->source(), "'accept' needs a 'reason'; reports show it");
    }
    const auto accepts = [&](Accept what) { return std::ranges::count(rule.accept, what) > 0; };
    const toml::node* most = table.get("max_non_finite");
    if (accepts(Accept::nonFinite) != (most != nullptr))
      refuse(most ? most->source() : table.get("accept")->source(),
             most ? "'max_non_finite' needs 'accept' with \"non-finite\""
                  : "'accept' of \"non-finite\" needs 'max_non_finite', the most such pixels in a view");
    if (most) rule.maxNonFinite = readPixels(*most, "max_non_finite", "");
    if (accepts(Accept::noLimit))
      for (const char* key : {"checks", "regress", "preset"})
        if (const toml::node* node = table.get(key))
          refuse(node->source(), fmt::format("'accept' of \"no limit\" contradicts '{}'", key));
  }

  Accept readAccept(const toml::node& node, RuleKind kind, const std::vector<Accept>& before) const {
    if (!node.is_string()) refuse(node.source(), "an entry of 'accept' is not a string");
    const std::string& name = node.as_string()->get();
    const std::optional<Accept> known = acceptByName(name);
    if (!known)
      refuse(node.source(),
             fmt::format("'accept' does not know '{}'; {}", name, base::describeNearest(name, acceptNames())));
    if (kind == RuleKind::whole && !isOfWholes(*known))
      refuse(node.source(), fmt::format("whole images are never '{}', so there is nothing to accept", name));
    if (std::ranges::count(before, *known) > 0) refuse(node.source(), fmt::format("'{}' is accepted twice", name));
    return *known;
  }

  BudgetRule materialRule(const toml::table& table) const {
    refuseUnknown(table, kMaterialKeys);
    BudgetRule rule = commonRule(table, RuleKind::material);
    if (!table.contains("name")) refuse(table.source(), "the rule has no 'name' (a glob over material names)");
    rule.material = textOf(table, "name", "*");
    if (const toml::node* node = table.get("require_seen")) {
      if (!node->is_boolean()) refuse(node->source(), "'require_seen' must be true or false");
      rule.requireSeen = node->as_boolean()->get();
    }
    if (rule.requireSeen)
      for (const Accept each : {Accept::notSeen, Accept::tooSmall})
        if (std::ranges::count(rule.accept, each) > 0)
          refuse(table.get("accept")->source(),
                 fmt::format("'accept' of \"{}\" contradicts 'require_seen'", nameOf(each)));
    if (const toml::node* node = table.get("min_pixels"))
      rule.minPixels = readPixels(*node, "min_pixels", ": 1 judges every material that is seen");
    return rule;
  }

  BudgetRule wholeRule(const toml::table& table) const {
    refuseUnknown(table, kWholeKeys);
    return commonRule(table, RuleKind::whole);
  }

  BudgetCheck readCheck(const toml::table& table, bool regress) const {
    if (const toml::node* region = table.get("region"))
      refuse(region->source(),
             "'region' no longer exists: one figure over all pixels of a material judges it, without its "
             "neighbours (docs/budgets.md); delete the key");
    refuseUnknown(table, kCheckKeys);
    BudgetCheck check;
    if (!table.contains("metric")) refuse(table.source(), "the check has no 'metric'");
    const std::string metric = textOf(table, "metric", "");
    const std::shared_ptr<const Statistic> known = statisticByName(metric);
    if (!known) {
      if (const std::shared_ptr<const Statistic> first = statisticByName(metric + ".mean"))
        refuse(table.get("metric")->source(),
               fmt::format("unknown metric '{}'; did you mean '{}'?", metric, first->name));
      const std::vector<std::string> names = knownStatistics();
      refuse(table.get("metric")->source(),
             fmt::format("unknown metric '{}'; {}", metric,
                         base::describeNearest(metric, std::vector<std::string_view>(names.begin(), names.end()))));
    }
    check.statistic = *known;
    check.warn = readLimit(table, "warn", check.statistic, regress);
    check.fail = readLimit(table, "fail", check.statistic, regress);
    if (!check.warn && !check.fail) refuse(table.source(), "the check needs 'warn' or 'fail'");
    const bool lowerBound = check.statistic.better == Better::higher && !regress;
    if (check.warn && check.fail && (lowerBound ? *check.warn < *check.fail : *check.warn > *check.fail))
      refuse(table.source(), fmt::format("'warn' ({}) is {} 'fail' ({}), so it would never warn", *check.warn,
                                         lowerBound ? "below" : "above", *check.fail));
    return check;
  }

  // A limit of a regression is a distance, so it may be almost as large as the whole range.
  std::optional<double> readLimit(const toml::table& table, std::string_view key, const Statistic& statistic,
                                  bool regress) const {
    const toml::node* node = table.get(key);
    if (!node) return std::nullopt;
    const std::optional<double> value = node->value<double>();
    if (!node->is_number() || !value) refuse(node->source(), fmt::format("'{}' must be a number", key));
    if (!std::isfinite(*value)) refuse(node->source(), fmt::format("'{}' is not a finite number", key));
    const double least = regress ? 0 : statistic.least;
    const double most = regress ? statistic.most - statistic.least : statistic.most;
    if (*value < least || *value > most)
      refuse(node->source(), fmt::format("'{}' is {}, outside the range {}..{} of {}{}", key, *value, least, most,
                                         regress ? "changes of " : "", statistic.name));
    if (regress ? *value >= most : !canBeBeyond(statistic, *value))
      refuse(node->source(), fmt::format("'{}' is {}, but {} can never be {} it, so the check would always pass", key,
                                         *value, regress ? "a change of " + statistic.name : statistic.name,
                                         statistic.better == Better::higher && !regress ? "below" : "above"));
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
          throw base::fileError(
              fileName(), rules[later].origin.substr(shortName().size() + 2),
              fmt::format("the rule of {} already matches everything that this rule matches; put this rule first",
                          rules[earlier].origin.substr(shortName().size() + 2)));
      }
  }

  std::map<std::string, Checks> m_presets[2]; // of each RuleKind
};

} // namespace

std::string readBudgetText(const std::filesystem::path& file) { return base::readText(file, kMaxBytes); }

Budgets loadBudgets(const std::filesystem::path& file) { return readBudgets(readBudgetText(file), file); }

Budgets readBudgets(std::string_view text, const std::filesystem::path& file) {
  Budgets budgets = Reader(file).read(text);
  const Budgets& builtIn = defaultBudgets();
  budgets.materials.insert(budgets.materials.end(), builtIn.materials.begin(), builtIn.materials.end());
  budgets.wholes.insert(budgets.wholes.end(), builtIn.wholes.begin(), builtIn.wholes.end());
  return budgets;
}

} // namespace parity::compare

// Approvals as a file (TOML) and back: every key is known or refused, every entry makes sense or is refused.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text/nearest.h"
#include "base/text/toml_string.h"
#include "compare/verdict/approval.h"
#include "compare/verdict/budget_keys.h"

namespace parity::compare {
namespace {

constexpr std::size_t kMostApprovalBytes = std::size_t{64} << 20;
constexpr std::size_t kNumericsDigits = 32;

constexpr std::string_view kApprovalRootKeys[] = {"numerics", "accept"};
constexpr std::string_view kEntryKeys[] = {"scene", "view",  "material", "whole",  "metric", "value",
                                           "slack", "until", "owner",    "reason", "inputs"};

constexpr const char* kFirstComment = "# Approvals: figures beyond a limit that are accepted until a day "
                                      "(docs/approvals.md of parity).\n";

bool isHex(std::string_view text, std::size_t digits) {
  return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// Comments and empty lines before anything else.
std::string headOf(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && (text[end] == '#' || text[end] == '\n' || text[end] == '\r')) {
    const std::size_t line = text.find('\n', end);
    if (line == std::string_view::npos) break;
    end = line + 1;
  }
  std::string head(text.substr(0, end));
  while (head.ends_with("\n\n")) head.pop_back();
  return head;
}

class ApprovalReader : public BudgetKeys {
public:
  using BudgetKeys::BudgetKeys;

  Approvals read(std::string_view text) {
    const toml::table root = parse(text);
    refuseUnknown(root, kApprovalRootKeys);
    Approvals approvals{.file = fileName(), .head = headOf(text), .numerics = {}, .entries = {}};
    if (const toml::node* node = root.get("numerics")) {
      approvals.numerics = textOf(root, "numerics", "");
      if (!isHex(approvals.numerics, kNumericsDigits))
        refuse(node->source(), fmt::format("'numerics' is not {} hexadecimal digits, as 'parity devices' prints them",
                                           kNumericsDigits));
    }
    if (const toml::node* entries = root.get("accept"))
      for (const toml::table* entry : tablesOf(*entries, "accept")) approvals.entries.push_back(readEntry(*entry));
    refuseDuplicates(approvals.entries);
    return approvals;
  }

private:
  // hint: what it means, as it may be missing.
  std::string required(const toml::table& table, std::string_view key, const char* hint) const {
    if (!table.contains(key)) refuse(table.source(), fmt::format("the entry has no '{}' ({})", key, hint));
    return textOf(table, key, "");
  }

  Approval readEntry(const toml::table& table) const {
    refuseUnknown(table, kEntryKeys);
    Approval entry;
    entry.line = static_cast<int>(table.source().begin.line);
    entry.scene = required(table, "scene", "a scene's name");
    entry.view = required(table, "view", "a view's name");
    readSubject(table, entry);
    entry.metric = required(table, "metric", "a figure, such as flip.mean");
    const std::shared_ptr<const Statistic> statistic = statisticByName(entry.metric);
    if (!statistic) {
      const std::vector<std::string> names = knownStatistics();
      refuse(
          table.get("metric")->source(),
          fmt::format("unknown metric '{}'; {}", entry.metric,
                      base::describeNearest(entry.metric, std::vector<std::string_view>(names.begin(), names.end()))));
    }
    entry.metric = statistic->name;
    readValue(table, *statistic, entry);
    readUntil(table, entry);
    entry.owner = required(table, "owner", "whom to ask");
    entry.reason = required(table, "reason", "why the figure is accepted; reports show it");
    entry.inputs = required(table, "inputs", "the digest of the scene's asset and environment");
    if (!isHex(entry.inputs, kInputDigits))
      refuse(
          table.get("inputs")->source(),
          fmt::format("'inputs' is '{}', which is not a digest of {} hexadecimal digits", entry.inputs, kInputDigits));
    return entry;
  }

  void readSubject(const toml::table& table, Approval& entry) const {
    if (const toml::node* whole = table.get("whole")) {
      if (!whole->is_boolean() || !whole->as_boolean()->get())
        refuse(whole->source(), "'whole' must be true: the entry is for the view's whole image");
      if (table.contains("material")) refuse(whole->source(), "'whole' contradicts 'material'; keep one of them");
      return;
    }
    entry.material = required(table, "material", "a material's name; of the view's whole image: whole = true");
  }

  double readNumber(const toml::table& table, std::string_view key) const {
    const toml::node& node = *table.get(key);
    const std::optional<double> value = node.value<double>();
    if (!node.is_number() || !value) refuse(node.source(), fmt::format("'{}' must be a number", key));
    if (!std::isfinite(*value)) refuse(node.source(), fmt::format("'{}' is not a finite number", key));
    return *value;
  }

  void readValue(const toml::table& table, const Statistic& statistic, Approval& entry) const {
    if (!table.contains("value")) refuse(table.source(), "the entry has no 'value' (the figure that is accepted)");
    const toml::source_region& where = table.get("value")->source();
    entry.value = readNumber(table, "value");
    // A limit of a signed figure bounds its absolute value, so that its least is 0.
    const double least = statistic.better == Better::nearZero ? -statistic.most : statistic.least;
    if (entry.value < least || entry.value > statistic.most)
      refuse(where, fmt::format("'value' is {}, outside the range {}..{} of {}", entry.value, least, statistic.most,
                                statistic.name));
    if (table.contains("slack")) entry.slack = readNumber(table, "slack");
    if (entry.slack < 0) refuse(table.get("slack")->source(), fmt::format("'slack' is {}, below 0", entry.slack));
    if (const double most = mostOf(entry, statistic.better); !canBeBeyond(statistic, most))
      refuse(where, fmt::format("'value' with 'slack' reaches {}, and no {} can be worse, so the entry would accept "
                                "whatever comes",
                                most, statistic.name));
  }

  void readUntil(const toml::table& table, Approval& entry) const {
    const toml::node* node = table.get("until");
    if (!node) refuse(table.source(), "the entry has no 'until' (the last day on which it holds, such as 2027-02-01)");
    const auto* date = node->as_date();
    if (!date) refuse(node->source(), "'until' must be a date, without quotes and time: 2027-02-01");
    const toml::date& day = date->get();
    const std::optional<base::Day> known =
        base::dayFrom(fmt::format("{:04}-{:02}-{:02}", int{day.year}, int{day.month}, int{day.day}));
    if (!known) refuse(node->source(), "'until' is no day from 1970 to 9999");
    entry.until = *known;
  }

  void refuseDuplicates(const std::vector<Approval>& entries) const {
    std::map<std::tuple<std::string, std::string, std::string, std::string>, int> lines;
    for (const Approval& entry : entries)
      if (const auto [known, isNew] =
              lines.try_emplace({entry.scene, entry.view, entry.material, entry.metric}, entry.line);
          !isNew)
        throw base::fileError(fileName(), fmt::format("line {}", entry.line),
                              fmt::format("the entry of line {} is for the same figure ({} of {}, {}, {}); keep one of "
                                          "them",
                                          known->second, entry.metric,
                                          entry.material.empty() ? "the whole image" : "'" + entry.material + "'",
                                          entry.scene, entry.view));
  }
};

} // namespace

Approvals loadApprovals(const std::filesystem::path& file) {
  return readApprovals(base::readText(file, kMostApprovalBytes), file);
}

Approvals readApprovals(std::string_view text, const std::filesystem::path& file) {
  return ApprovalReader(file).read(text);
}

std::string formatApprovals(const Approvals& approvals) {
  std::vector<const Approval*> sorted;
  for (const Approval& entry : approvals.entries) sorted.push_back(&entry);
  std::ranges::sort(sorted, {}, [](const Approval* entry) {
    return std::tie(entry->scene, entry->view, entry->material, entry->metric);
  });
  std::string text = approvals.head.empty() ? kFirstComment : approvals.head;
  if (!approvals.numerics.empty()) text += fmt::format("numerics = {}\n", base::tomlString(approvals.numerics));
  for (const Approval* entry : sorted) {
    text += fmt::format("\n[[accept]]\nscene = {}\nview = {}\n", base::tomlString(entry->scene),
                        base::tomlString(entry->view));
    text +=
        entry->material.empty() ? "whole = true\n" : fmt::format("material = {}\n", base::tomlString(entry->material));
    text +=
        fmt::format("metric = {}\nvalue = {}\nslack = {}\nuntil = {}\nowner = {}\nreason = {}\ninputs = {}\n",
                    base::tomlString(entry->metric), entry->value, entry->slack, base::textOf(entry->until),
                    base::tomlString(entry->owner), base::tomlString(entry->reason), base::tomlString(entry->inputs));
  }
  return text;
}

} // namespace parity::compare

// What was observed, gathered into rules and written as a budget file.
#include "report/budget_suggest.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/text/text.h"
#include "report/budget_limits.h"
#include "report/budget_rule.h"

namespace parity::report {
namespace {

// A report that is given twice is one run, as it says nothing new.
std::vector<ObservedRun> dropRepeated(const std::vector<ObservedRun>& runs, std::vector<std::string>& notes) {
  std::vector<ObservedRun> once;
  std::vector<std::string> hashes; // of their JSON
  for (const ObservedRun& run : runs) {
    base::Hasher hasher;
    writeJson(run.report, [&](std::string_view piece) { hasher.add(std::as_bytes(std::span(piece))); });
    std::string hash = hasher.hex();
    const auto same = std::ranges::find(hashes, hash);
    if (same == hashes.end()) {
      hashes.push_back(std::move(hash));
      once.push_back(run);
    } else {
      notes.push_back(fmt::format("{} is the same run as {}, so it counts once", run.source,
                                  once[static_cast<std::size_t>(same - hashes.begin())].source));
    }
  }
  return once;
}

// Whether these were judged, but no figure of theirs can have a limit that holds for all: that must not loosen what
// other scenes share.
bool isWithoutLimit(const RuleGroup& group, const std::vector<compare::Statistic>& figures,
                    const SuggestOptions& options, std::size_t runs) {
  const auto wasJudged = [](const ObservedSubject* each) { return !each->judgeable.empty(); };
  const auto isIdentical = [](const ObservedSubject* each) { return each->isIdentical; };
  if (std::ranges::none_of(group.subjects, wasJudged) || std::ranges::all_of(group.subjects, isIdentical)) return false;
  for (std::size_t i = 0; i < figures.size(); ++i)
    if (!suggestFor(figures[i], worstErrors(group, i, runs), options).empty()) return false;
  return true;
}

// The rules to write, those of one scene before those that scenes share.
std::vector<RuleGroup> groupSubjects(const Observation& observation, const std::vector<compare::Statistic>& figures,
                                     const SuggestOptions& options, std::size_t runs) {
  std::vector<RuleGroup> own, shared;
  for (const ObservedSubject& subject : observation.subjects) {
    RuleGroup alone = {{&subject}, true};
    if (options.perScene || subject.nonFinite > 0 || isWithoutLimit(alone, figures, options, runs)) {
      own.push_back(std::move(alone));
      continue;
    }
    const auto group = std::ranges::find_if(shared, [&](const RuleGroup& each) {
      return each.subjects.front()->whole == subject.whole && each.subjects.front()->material == subject.material;
    });
    if (group == shared.end())
      shared.push_back({{&subject}, false});
    else
      group->subjects.push_back(&subject);
  }
  for (RuleGroup& group : shared)
    // The worst of each figure may be another scene's, so that they have limits one by one and none together.
    if (group.subjects.size() > 1 && isWithoutLimit(group, figures, options, runs))
      for (const ObservedSubject* each : group.subjects) own.push_back({{each}, true});
    else
      own.push_back(std::move(group));
  return own;
}

// What rules cannot name.
bool isNameless(const ObservedSubject& subject) {
  return subject.scene.empty() || (!subject.whole && subject.material.empty());
}

std::string headOf(const std::vector<ObservedRun>& runs, const SuggestOptions& options) {
  const std::string count = fmt::format("{} {}", runs.size(), runs.size() == 1 ? "run" : "runs");
  std::string text = "# Budgets suggested from " + count;
  for (const ObservedRun& run : runs) text += "\n#   " + base::plainLine(run.source);
  text +=
      options.regress
          ? fmt::format("\n# Limits on how much worse than in the baseline (--baseline) a figure may be: the spread "
                        "of the runs, each at\n# its worst view and scene, and {:g} % of the figure to warn, {:g} % "
                        "to fail.\n",
                        100 * options.margin, 200 * options.margin)
          : fmt::format("\n# Limits: the 95th percentile of the runs, each at its worst view and scene, plus {:g} % "
                        "to warn and {:g} % to\n# fail; no run is beyond a limit that fails.\n",
                        100 * options.margin, 200 * options.margin);
  if (runs.size() < 20)
    text += "# With fewer than 20 runs the 95th percentile is the largest value; more runs give better limits.\n";
  return text;
}

} // namespace

SuggestedBudgets suggestBudgets(const std::vector<ObservedRun>& given, const SuggestOptions& options) {
  if (given.empty()) throw base::fileError("budget suggest", "", "no report was given");
  if (!(options.margin >= 0 && options.margin <= 10))
    throw base::Error(base::ExitCode::usage, "budget suggest", "margin", "is not from 0 to 10");
  if (options.figures.empty()) throw base::Error(base::ExitCode::usage, "budget suggest", "", "no figure was named");
  std::vector<compare::Statistic> figures;
  for (const std::string& name : options.figures) figures.push_back(compare::requireStatistic(name, "budget suggest"));

  SuggestedBudgets result;
  const std::vector<ObservedRun> runs = dropRepeated(given, result.notes);
  Observation observation = observe(runs, figures);
  result.notes.insert(result.notes.end(), observation.notes.begin(), observation.notes.end());
  result.errors = observation.errors;
  const auto nameless = std::erase_if(observation.subjects, isNameless);
  if (nameless > 0) result.errors.push_back(fmt::format("{} rows have no name, so no rule can match them", nameless));
  if (!observation.isAnyCompared)
    throw base::fileError(runs.front().source, "",
                          result.errors.empty()
                              ? "compared no material, so there is nothing to suggest"
                              : fmt::format("nothing to suggest: {}", fmt::join(result.errors, "; ")));

  std::string rules, wholes;
  for (const RuleGroup& group : groupSubjects(observation, figures, options, runs.size()))
    (group.subjects.front()->whole ? wholes : rules) += formatRule(group, figures, options, runs.size(), result);
  result.text = headOf(runs, options);
  for (const std::string& each : result.errors)
    result.text += "# AN UNCHANGED RUN IS AN ERROR: " + base::plainLine(each) + "\n";
  for (const std::string& each : result.notes) result.text += "# Note: " + base::plainLine(each) + "\n";
  result.text += rules + wholes;
  return result;
}

} // namespace parity::report

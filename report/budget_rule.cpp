// Limits, what is accepted, and the words for both, as a rule of a budget file.
#include "report/budget_rule.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/glob.h"
#include "base/text/text.h"
#include "base/text/toml_string.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"
#include "report/budget_limits.h"

namespace parity::report {
namespace {

constexpr std::size_t kMostScenesNamed = 3;
using Subjects = std::vector<const ObservedSubject*>;

std::string countText(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// As people read it; of a signed figure only the size is known here.
std::string formatError(const compare::Statistic& statistic, double error) {
  const std::string text = compare::formatFigure(statistic.name, valueOf(statistic, error));
  return statistic.better == compare::Better::nearZero && std::isfinite(error) ? "±" + text.substr(1) : text;
}

// Names of scenes in words: "scene 'a'", "scenes 'a', 'b'", "7 scenes".
std::string describeScenes(const Subjects& subjects) {
  if (subjects.size() > kMostScenesNamed) return countText(subjects.size(), "scene");
  std::vector<std::string> names;
  for (const ObservedSubject* each : subjects) names.push_back(fmt::format("'{}'", each->scene));
  return fmt::format("scene{} {}", names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

// The rule of a group, in parts.
class RuleWriter {
public:
  RuleWriter(const RuleGroup& group, const std::vector<compare::Statistic>& figures, const SuggestOptions& options,
             std::size_t runs, SuggestedBudgets& result)
      : m_group(group), m_first(*group.subjects.front()), m_figures(figures), m_options(options), m_runs(runs),
        m_result(result) {
    m_name = fmt::format("{} of {}", m_first.whole ? "the whole images" : fmt::format("'{}'", m_first.material),
                         describeScenes(group.subjects));
  }

  std::string write() {
    const std::string limits = formatLimits(), comment = describeSpread();
    collectAccepted(!limits.empty());
    const bool accepts = !m_accept.empty();
    std::string reason;
    if (!limits.empty())
      reason = m_options.regress ? fmt::format("suggested from {}: the spread of the runs plus a margin of {:g} %",
                                               countText(m_runs, "run"), 100 * m_options.margin)
                                 : fmt::format("suggested from {}: observed p95 plus a margin of {:g} %",
                                               countText(m_runs, "run"), 100 * m_options.margin);
    if (accepts)
      reason += fmt::format("{}accepted as observed in {}: {}", reason.empty() ? "" : "; ", countText(m_runs, "run"),
                            fmt::join(m_sentences, "; "));
    std::string rule = fmt::format("\n# {}{}\n", countText(m_runs, "run"), comment.empty() ? "" : ": " + comment);
    for (const std::string& sentence : m_sentences) {
      m_result.accepted.push_back(fmt::format("{}: {}", m_name, sentence));
      rule += "# Accepted: " + base::plainLine(sentence) + "\n";
    }
    rule += m_first.whole
                ? "[[whole]]\n"
                : fmt::format("[[material]]\nname = {}\n", base::tomlString(base::exactGlob(m_first.material)));
    if (m_group.namesScene) rule += fmt::format("scene = {}\n", base::tomlString(base::exactGlob(m_first.scene)));
    rule += fmt::format("reason = {}\n",
                        base::tomlString(reason.empty() ? "identical in " + countText(m_runs, "run") : reason));
    if (accepts) rule += fmt::format("accept = [{}]\n", fmt::join(m_accept, ", "));
    if (const std::uint64_t most = mostNonFinite(); most > 0) rule += fmt::format("max_non_finite = {}\n", most);
    if (!m_preset.empty()) rule += fmt::format("preset = \"{}\"\n", m_preset);
    if (!limits.empty()) rule += fmt::format("{} = [\n{}]\n", m_options.regress ? "regress" : "checks", limits);
    return rule;
  }

private:
  Subjects where(const std::function<bool(const ObservedSubject&)>& holds) const {
    Subjects found;
    std::ranges::copy_if(m_group.subjects, std::back_inserter(found),
                         [&](const ObservedSubject* each) { return holds(*each); });
    return found;
  }

  std::uint64_t mostNonFinite() const {
    std::uint64_t most = 0;
    for (const ObservedSubject* each : m_group.subjects) most = std::max(most, each->nonFinite);
    return most;
  }

  // Of each run that says something its worst over the scenes.
  std::vector<double> errorsOf(std::size_t figure) const { return worstErrors(m_group, figure, m_runs); }

  // "flip.mean 0.010 (scene 'night') to 0.120 (scene 'studio')", figure by figure.
  std::string describeSpread() const {
    std::string text;
    for (std::size_t i = 0; i < m_figures.size(); ++i) {
      double least = INFINITY, most = -INFINITY;
      const ObservedSubject *best = nullptr, *worst = nullptr;
      for (const ObservedSubject* each : m_group.subjects)
        for (const double error : each->errors[i]) {
          if (std::isnan(error)) continue;
          if (!best || error < least) std::tie(least, best) = std::pair(error, each);
          if (!worst || error > most) std::tie(most, worst) = std::pair(error, each);
        }
      if (!best) continue;
      const auto place = [&](const ObservedSubject& of) {
        return m_group.subjects.size() > 1 ? fmt::format(" ('{}')", base::plainLine(of.scene)) : std::string();
      };
      text +=
          fmt::format("{}{} {}{} to {}{}", text.empty() ? "" : ", ", m_figures[i].name,
                      formatError(m_figures[i], least), place(*best), formatError(m_figures[i], most), place(*worst));
    }
    return text;
  }

  std::string formatLimits() {
    std::string text;
    for (std::size_t i = 0; i < m_figures.size(); ++i) {
      const compare::Statistic& figure = m_figures[i];
      const std::vector<double> errors = errorsOf(i);
      m_isLimited.push_back(false);
      if (std::ranges::none_of(errors, [](double error) { return std::isfinite(error); })) continue;
      const std::string limits = suggestFor(figure, errors, m_options);
      if (limits.find("fail") == std::string::npos)
        m_result.notes.push_back(fmt::format(
            "{}: no {} of {} is suggested, because no value can exceed it (observed: {})", m_name,
            limits.empty() ? "limit" : "'fail'", figure.name, formatError(figure, std::ranges::max(errors))));
      m_isLimited.back() = !limits.empty();
      if (!limits.empty()) text += fmt::format("  {{ metric = {}, {} }},\n", base::tomlString(figure.name), limits);
    }
    return text;
  }

  void accept(compare::Accept what, const Subjects& subjects, const std::string& sentence) {
    if (subjects.empty()) return;
    if (std::ranges::count(m_accept, base::tomlString(nameOf(what))) == 0)
      m_accept.push_back(base::tomlString(nameOf(what)));
    m_sentences.push_back(m_group.subjects.size() == 1 ? sentence
                                                       : fmt::format("{} in {}", sentence, describeScenes(subjects)));
  }

  template <typename Value> Value mostOf(Value ObservedSubject::*member) const {
    Value value = {};
    for (const ObservedSubject* each : m_group.subjects) value = std::max(value, each->*member);
    return value;
  }

  // hasLimits: of its own.
  void collectAccepted(bool hasLimits) {
    using compare::Accept;
    accept(Accept::notSeen, where(&ObservedSubject::isNotSeen),
           m_first.whole ? "no pixel of a view shows a material" : "no view shows it");
    accept(Accept::tooSmall, where(&ObservedSubject::isTooSmall),
           fmt::format("fewer than {} pixels show it", compare::kDefaultMinPixels));
    accept(Accept::notJudged, where([](const ObservedSubject& each) { return each.mostlyClipped > 0; }),
           fmt::format("up to {:.1f} % of its pixels are black or white in both pictures",
                       100 * mostOf(&ObservedSubject::mostlyClipped)));
    accept(Accept::notJudged, where([&](const ObservedSubject& each) { return hasLimits && isTooDark(each); }),
           "both pictures are too dark for its limits");
    accept(Accept::clipped, where([](const ObservedSubject& each) { return each.clipped > 0; }),
           fmt::format("up to {:.1f} % of the pixels are black or white in both pictures",
                       100 * mostOf(&ObservedSubject::clipped)));
    std::set<std::string> parts;
    for (const ObservedSubject* each : m_group.subjects)
      parts.insert(each->notModelled.begin(), each->notModelled.end());
    accept(Accept::baseLayerOnly, where([](const ObservedSubject& each) { return !each.notModelled.empty(); }),
           fmt::format("base layer only: parity does not model {}", fmt::join(parts, ", ")));
    const Subjects broken = where([](const ObservedSubject& each) { return each.nonFinite > 0; });
    accept(Accept::nonFinite, broken,
           fmt::format("{} NaN OR INFINITE in a view, which is a fault of a renderer and not a matter of limits",
                       mostNonFinite() == 1 ? "1 pixel is" : fmt::format("up to {} pixels are", mostNonFinite())));
    if (!broken.empty()) m_result.faults.push_back(fmt::format("{}: {}", m_name, m_sentences.back()));
    if (hasLimits) return;
    if (where([](const ObservedSubject& each) { return !each.judgeable.empty(); }).empty())
      m_preset = "default"; // once it is seen, or its NaN are gone
    else if (std::ranges::all_of(m_group.subjects, [](const auto* each) { return each->isIdentical; }))
      m_preset = "identical";
    else
      accept(Accept::noLimit, m_group.subjects,
             std::ranges::all_of(m_group.subjects, [&](const auto* each) { return isNeverJudgeable(*each); })
                 ? "nothing limits it, because both pictures are too dark for its figures"
                 : "nothing limits it, because no value can exceed a limit");
  }

  static bool isNeverJudgeable(const ObservedSubject& subject) {
    return std::ranges::all_of(subject.judgeable, [](const auto& row) { return std::ranges::count(row, true) == 0; });
  }

  // Whether no limit of the rule can be judged in some row.
  bool isTooDark(const ObservedSubject& subject) const {
    return std::ranges::any_of(subject.judgeable, [&](const std::vector<bool>& row) {
      for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] && m_isLimited[i]) return false;
      return true;
    });
  }

  const RuleGroup& m_group;
  const ObservedSubject& m_first;
  const std::vector<compare::Statistic>& m_figures;
  const SuggestOptions& m_options;
  const std::size_t m_runs;
  SuggestedBudgets& m_result;
  std::string m_name, m_preset;
  std::vector<std::string> m_accept, m_sentences;
  std::vector<bool> m_isLimited; // by figure
};

} // namespace

std::vector<double> worstErrors(const RuleGroup& group, std::size_t figure, std::size_t runs) {
  std::vector<double> errors;
  for (std::size_t run = 0; run < runs; ++run) {
    double worst = NAN;
    for (const ObservedSubject* each : group.subjects) {
      const double error = each->errors[figure][run];
      if (!std::isnan(error)) worst = std::isnan(worst) ? error : std::max(worst, error);
    }
    if (!std::isnan(worst)) errors.push_back(worst);
  }
  return errors;
}

std::string suggestFor(const compare::Statistic& figure, const std::vector<double>& errors,
                       const SuggestOptions& options) {
  if (std::ranges::none_of(errors, [](double error) { return std::isfinite(error); })) return {};
  return options.regress ? suggestRegression(figure, errors, options.margin)
                         : suggestLimits(figure, errors, options.margin);
}

std::string formatRule(const RuleGroup& group, const std::vector<compare::Statistic>& figures,
                       const SuggestOptions& options, std::size_t runs, SuggestedBudgets& result) {
  return RuleWriter(group, figures, options, runs, result).write();
}

} // namespace parity::report

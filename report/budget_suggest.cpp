// What was observed, gathered by scene and material, and written as rules.
#include "report/budget_suggest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text/text.h"
#include "compare/pooling/statistic.h"
#include "compare/verdict/wording.h"

namespace parity::report {
namespace {

// A material of a scene, or its whole images, over all runs.
struct Subject {
  std::string scene, material;
  bool whole = false;
  bool inThisRun = false;                  // while runs are gathered
  bool nonFinite = false;                  // NaN or infinite pixels in some run: its figures say nothing
  std::vector<std::vector<double>> values; // by figure: one a run, its worst over the views
  std::size_t runs() const { return values.front().size(); }
};

// How far from the best a value is, so that more is worse; infinite ones too.
double errorOf(const compare::Statistic& statistic, double value) {
  return statistic.better == compare::Better::higher ? -value : std::abs(value);
}

double valueOf(const compare::Statistic& statistic, double error) {
  return statistic.better == compare::Better::higher ? -error : error;
}

class Observation {
public:
  Observation(const std::vector<ObservedRun>& runs, const std::vector<compare::Statistic>& figures)
      : m_figures(figures) {
    for (const ObservedRun& run : runs) {
      for (Subject& subject : m_subjects) subject.inThisRun = false;
      for (const SceneResult& scene : run.report.scenes) addScene(run, scene);
    }
  }
  const std::vector<Subject>& subjects() const { return m_subjects; }
  const std::vector<std::string>& leftOut() const { return m_leftOut; }

private:
  void addScene(const ObservedRun& run, const SceneResult& scene) {
    if (!scene.error.empty()) leaveOut(fmt::format("scene '{}' could not be compared in {}", scene.name, run.source));
    for (const ViewResult& view : scene.views) {
      const std::string place = fmt::format("scene {}, view {}", scene.name, view.name);
      for (const MaterialResult& material : view.materials) {
        if (isJudged(material))
          add(run, place + ", material " + material.name, {scene.name, material.name, false, false, false, {}},
              material.figures);
        else if (!isJudgedInAnyView(scene, material.name))
          leaveOut(material.figures.pixels == 0
                       ? fmt::format("no view shows '{}' of scene '{}' in {}", material.name, scene.name, run.source)
                       : fmt::format("'{}' of scene '{}' is {} in {}", material.name, scene.name,
                                     nameOf(material.verdict), run.source));
      }
      if (view.whole.pixels > 0)
        add(run, place + ", whole image", {scene.name, "", true, false, false, {}}, view.whole);
    }
  }

  // Figures of few pixels, or of clipped ones, say nothing: they must neither widen nor narrow a limit.
  static bool isJudged(const MaterialResult& material) {
    return material.figures.pixels > 0 && material.verdict != compare::Verdict::tooSmall &&
           material.verdict != compare::Verdict::notJudged;
  }

  static bool isJudgedInAnyView(const SceneResult& scene, const std::string& name) {
    return std::ranges::any_of(scene.views, [&](const ViewResult& view) {
      return std::ranges::any_of(
          view.materials, [&](const MaterialResult& material) { return material.name == name && isJudged(material); });
    });
  }

  void leaveOut(std::string why) {
    if (std::ranges::find(m_leftOut, why) == m_leftOut.end()) m_leftOut.push_back(std::move(why));
  }

  void add(const ObservedRun& run, const std::string& place, Subject key, const compare::Figures& figures) {
    auto subject = std::ranges::find_if(m_subjects, [&](const Subject& each) {
      return each.whole == key.whole && each.scene == key.scene && each.material == key.material;
    });
    if (subject == m_subjects.end()) {
      key.values.resize(m_figures.size());
      subject = m_subjects.insert(m_subjects.end(), std::move(key));
    }
    const bool first = !std::exchange(subject->inThisRun, true);
    if (figures.nonFinite > 0) {
      leaveOut(fmt::format("{} has {} NaN or infinite pixels in {}", place, figures.nonFinite, run.source));
      subject->nonFinite = true;
    }
    if (subject->nonFinite) return;
    for (std::size_t i = 0; i < m_figures.size(); ++i) {
      const std::optional<double> value = figures.find(m_figures[i].name);
      if (!value) throw base::fileError(run.source, place, m_figures[i].name + " was not measured");
      if (std::isnan(*value)) throw base::fileError(run.source, place, m_figures[i].name + " is not a number");
      const double error = errorOf(m_figures[i], *value);
      std::vector<double>& errors = subject->values[i];
      if (first)
        errors.push_back(error);
      else
        errors.back() = std::max(errors.back(), error);
    }
  }

  const std::vector<compare::Statistic>& m_figures;
  std::vector<Subject> m_subjects;
  std::vector<std::string> m_leftOut;
};

// The value below which 95 % of them lie: the one of rank ceil(0.95 n).
double percentile95(std::vector<double> values) {
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  return values[rank - 1];
}

// `value` worsened by a share of its error.
double worsen(const compare::Statistic& statistic, double value, double share) {
  if (statistic.better != compare::Better::higher) return value * (1 + share);
  if (statistic.unit == "dB") return value - 20 * std::log10(1 + share);
  return std::isfinite(statistic.most) ? statistic.most - (statistic.most - value) * (1 + share) : value / (1 + share);
}

// Away from the best, to the digits that people read; at least `steps` of the last of them away from `value`.
double roundWorse(const compare::Statistic& statistic, double value, double limit, int steps) {
  const double step = std::pow(10, -statistic.digits), tiny = 1e-6; // 0.123 is no more than 123 steps of 0.001
  const bool up = statistic.better != compare::Better::higher;
  const double rounded = up ? std::max(std::ceil(limit / step - tiny), std::ceil(value / step - tiny) + steps)
                            : std::min(std::floor(limit / step + tiny), std::floor(value / step + tiny) - steps);
  return std::clamp(rounded * step, statistic.least, statistic.most);
}

std::string quoteToml(std::string_view text) {
  std::string out = "\"";
  for (const char c : base::cleanUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (byte < 0x20 || byte == 0x7F)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + "\"";
}

// A glob that matches this name alone.
std::string exactGlob(std::string_view name) {
  std::string glob;
  for (const char c : name) glob += c == '*' || c == '?' || c == '[' ? fmt::format("[{}]", c) : std::string(1, c);
  return glob;
}

std::string countRuns(std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "run" : "runs"); }

// As people read it; of a signed figure only the size is known here.
std::string formatError(const compare::Statistic& statistic, double error) {
  const std::string text = compare::formatFigure(statistic.name, valueOf(statistic, error));
  return statistic.better == compare::Better::nearZero && std::isfinite(error) ? "±" + text.substr(1) : text;
}

// Whether no figure has a limit, as most of the runs were identical images.
bool isIdentical(const Subject& subject) {
  return std::ranges::all_of(subject.values,
                             [](const std::vector<double>& errors) { return !std::isfinite(percentile95(errors)); });
}

// A report that is given twice is one run, as it says nothing new.
std::vector<ObservedRun> dropRepeated(const std::vector<ObservedRun>& runs, std::vector<std::string>& leftOut) {
  std::vector<ObservedRun> once;
  std::vector<std::string> texts;
  for (const ObservedRun& run : runs) {
    std::string text = toJson(run.report);
    const auto same = std::ranges::find(texts, text);
    if (same == texts.end()) {
      texts.push_back(std::move(text));
      once.push_back(run);
    } else {
      leftOut.push_back(fmt::format("{} is the same run as {}, so it counts once", run.source,
                                    once[static_cast<std::size_t>(same - texts.begin())].source));
    }
  }
  return once;
}

// "warn = 0.120, fail = 0.140", without what nothing could be beyond; empty where neither is left.
std::string formatLimits(const compare::Statistic& figure, double value, double margin) {
  std::string limits;
  for (const int steps : {1, 2}) {
    const std::string limit =
        fmt::format("{:.{}f}", roundWorse(figure, value, worsen(figure, value, steps * margin), steps), figure.digits);
    if (compare::canBeBeyond(figure, std::stod(limit)))
      limits += fmt::format("{}{} = {}", limits.empty() ? "" : ", ", steps == 1 ? "warn" : "fail", limit);
  }
  return limits;
}

// Empty where no figure of it has a limit. leftOut: told of limits that would never have been judged.
std::string formatRule(const Subject& subject, const std::string& name, const std::vector<compare::Statistic>& figures,
                       double margin, std::vector<std::string>& leftOut) {
  std::string checks, observed;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const compare::Statistic& figure = figures[i];
    const auto [least, most] = std::ranges::minmax(subject.values[i]);
    observed += fmt::format("{}{} {} to {}", observed.empty() ? "" : ", ", figure.name, formatError(figure, least),
                            formatError(figure, most));
    const double value = valueOf(figure, percentile95(subject.values[i]));
    if (!std::isfinite(value)) continue;
    const std::string limits = formatLimits(figure, value, margin);
    if (limits.find("fail") == std::string::npos)
      leftOut.push_back(fmt::format("{}: no {} of {} is suggested, because no value can exceed it (observed: {})", name,
                                    limits.empty() ? "limit" : "'fail'", figure.name,
                                    compare::formatFigure(figure.name, value)));
    if (!limits.empty()) checks += fmt::format("  {{ metric = {}, {} }},\n", quoteToml(figure.name), limits);
  }
  if (checks.empty()) return {};
  std::string rule = fmt::format("\n# {}: {}\n", countRuns(subject.runs()), observed);
  rule +=
      subject.whole ? "[[whole]]\n" : fmt::format("[[material]]\nname = {}\n", quoteToml(exactGlob(subject.material)));
  rule += fmt::format("scene = {}\n", quoteToml(exactGlob(subject.scene)));
  rule += fmt::format("reason = \"suggested from {}: observed p95 plus a margin of {:g} %\"\n",
                      countRuns(subject.runs()), 100 * margin);
  return rule + "checks = [\n" + checks + "]\n";
}

} // namespace

SuggestedBudgets suggestBudgets(const std::vector<ObservedRun>& given, const SuggestOptions& options) {
  if (given.empty()) throw base::fileError("budget suggest", "", "no report was given");
  if (!(options.margin >= 0 && options.margin <= 10))
    throw base::Error(base::ExitCode::usage, "budget suggest", "margin", "is not from 0 to 10");
  if (options.figures.empty()) throw base::Error(base::ExitCode::usage, "budget suggest", "", "no figure was named");
  std::vector<compare::Statistic> figures;
  for (const std::string& name : options.figures) figures.push_back(compare::requireStatistic(name, "budget suggest"));

  std::vector<std::string> leftOut;
  const std::vector<ObservedRun> runs = dropRepeated(given, leftOut);
  const Observation observation(runs, figures);
  leftOut.insert(leftOut.end(), observation.leftOut().begin(), observation.leftOut().end());
  std::string rules, wholes;
  for (const Subject& subject : observation.subjects()) {
    const std::string name =
        fmt::format("'{}' of scene '{}'", subject.whole ? "whole image" : subject.material, subject.scene);
    if (subject.scene.empty() || (!subject.whole && subject.material.empty())) {
      leftOut.push_back(name + " has no name, so no rule can match it");
      continue;
    }
    if (subject.nonFinite) continue; // said while it was gathered
    if (isIdentical(subject)) leftOut.push_back(name + " was identical, so it needs no limit");
    const std::string rule = formatRule(subject, name, figures, options.margin, leftOut);
    (subject.whole ? wholes : rules) += rule;
  }
  if (rules.empty() && wholes.empty())
    throw base::fileError(runs.front().source, "",
                          leftOut.empty() ? "compared no material, so there is nothing to suggest"
                                          : fmt::format("nothing to suggest: {}", fmt::join(leftOut, "; ")));

  std::string text = fmt::format("# Budgets suggested from {}", countRuns(runs.size()));
  for (const ObservedRun& run : runs) text += "\n#   " + base::plainLine(run.source);
  text += fmt::format(
      "\n# Limits: the 95th percentile of the runs, each at its worst view, plus {:g} % to warn and {:g} % to "
      "fail.\n",
      100 * options.margin, 200 * options.margin);
  if (runs.size() < 20)
    text += "# With fewer than 20 runs the 95th percentile is the largest value; more runs give better limits.\n";
  for (const std::string& each : leftOut) text += "# Left out: " + base::plainLine(each) + "\n";
  return {text + rules + wholes, std::move(leftOut)};
}

} // namespace parity::report

// junit.xml: what CI servers show. A suite a scene, a testcase a view x material and one for each whole image.
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "base/text/text.h"
#include "compare/verdict/wording.h"
#include "report/again.h"
#include "report/report.h"
#include "report/wording.h"

namespace parity::report {
namespace {

struct Tally {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;

  void add(compare::Verdict verdict) {
    ++tests;
    switch (verdict) {
    case compare::Verdict::pass:
    case compare::Verdict::warn: // JUnit knows no warnings: the case passes
      break;
    case compare::Verdict::notSeen:
    case compare::Verdict::tooSmall:
    case compare::Verdict::notJudged:
    case compare::Verdict::notRun:
      ++skipped;
      break;
    case compare::Verdict::fail:
      ++failures;
      break;
    case compare::Verdict::error:
      ++errors;
      break;
    }
  }
  void add(const Tally& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    skipped += other.skipped;
  }
  std::string attributes() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"", tests, failures, errors, skipped);
  }
};

struct Suite {
  std::string name, cases;
  Tally tally;
  std::optional<double> seconds = {};
};

std::string ruleLines(const compare::AppliedRule& rule) {
  std::string lines;
  if (!rule.origin.empty()) lines += "budget: " + rule.origin + "\n";
  if (!rule.reason.empty()) lines += "reason for the budget: " + rule.reason + "\n";
  if (!rule.owner.empty()) lines += "owner: " + rule.owner + "\n";
  return lines;
}

std::string baselineLines(const std::optional<BaselineChange>& baseline) {
  if (!baseline) return {};
  if (baseline->isNew) return "baseline: does not show this material\n";
  if (!baseline->notComparable.empty()) return fmt::format("baseline: not comparable: {}\n", baseline->notComparable);
  std::string line = fmt::format("baseline: {}", nameOf(baseline->before));
  for (const FigureChange& change : baseline->changes)
    line += fmt::format(", {} {}", change.metric, compare::formatChange(change.metric, change.change()));
  return line + "\n";
}

std::string figureLines(const compare::Figures& figures, const std::string& test,
                        const std::vector<compare::CheckResult>& checks) {
  std::string lines;
  for (const compare::CheckResult& check : checks) {
    const bool said = !check.judged() || std::isnan(check.value); // the sentence holds the note
    lines += fmt::format("{}: {}{}\n", check.judged() ? nameOf(check.verdict) : "not judged",
                         compare::describeCheck(check), check.note.empty() || said ? "" : " (" + check.note + ")");
  }
  if (figures.pixels == 0) return lines;
  lines += fmt::format("{} pixels", figures.pixels);
  for (const compare::Figure& figure : figures.values)
    lines += fmt::format(", {} {}", figure.name, compare::formatFigure(figure.name, figure.value));
  lines += fmt::format("; {}\n", compare::describeBias(figures, test));
  if (const std::string clipping = compare::describeClipping(figures); !clipping.empty())
    lines += "clipped: " + clipping + "\n";
  return lines;
}

void addCase(Suite& suite, const std::string& className, const std::string& name, compare::Verdict verdict,
             const std::string& reason, const std::string& details, const std::string& accepted = {}) {
  suite.tally.add(verdict);
  suite.cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n", base::escapeMarkup(className),
                             base::escapeMarkup(name));
  const auto element = [&](const char* tag, const char* type) {
    suite.cases += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", tag, type,
                               base::escapeMarkup(reason), base::escapeMarkup(details));
  };
  switch (verdict) {
  case compare::Verdict::pass: // what the budget accepts is said
    if (!accepted.empty())
      suite.cases += fmt::format("      <system-out>{}</system-out>\n",
                                 base::escapeMarkup(fmt::format("accepted: {}\n{}", accepted, details)));
    break;
  case compare::Verdict::notSeen:
  case compare::Verdict::tooSmall:
  case compare::Verdict::notJudged:
  case compare::Verdict::notRun:
    suite.cases += fmt::format("      <skipped message=\"{}: {}\"/>\n", nameOf(verdict), base::escapeMarkup(reason));
    break;
  case compare::Verdict::warn: // the case passes and says so
    suite.cases += fmt::format("      <system-out>{}</system-out>\n",
                               base::escapeMarkup(fmt::format("warning: {}\n{}", reason, details)));
    break;
  case compare::Verdict::fail:
    element("failure", "budget");
    break;
  case compare::Verdict::error:
    element("error", "error");
    break;
  }
  suite.cases += "    </testcase>\n";
}

// How to see a row again that is not well.
std::string againLine(compare::Verdict verdict, const std::string& command) {
  return verdict < compare::Verdict::warn || command.empty() ? "" : "to see it again: " + command + "\n";
}

std::string materialDetails(const MaterialResult& material, const std::string& reference) {
  std::string details = figureLines(material.figures, material.test, material.checks);
  const std::string cause = material.attribution ? describeCause(*material.attribution, reference) : "";
  if (!cause.empty()) details += "cause: " + cause + "\n";
  for (const std::string& note : material.notes) details += "note: " + note + "\n";
  return details + baselineLines(material.baseline) + ruleLines(material.rule);
}

// The cases that makeSuite has.
Tally tallyOf(const SceneResult& scene) {
  Tally tally;
  if (!scene.error.empty()) tally.add(ownVerdict(scene));
  for (const ViewResult& view : scene.views) {
    tally.add(view.wholeVerdict);
    for (const MaterialResult& material : view.materials) tally.add(material.verdict);
  }
  return tally;
}

Suite makeSuite(const SceneResult& scene, const AgainCommands& again) {
  Suite suite{scene.name, "", {}};
  if (!scene.error.empty()) addCase(suite, scene.name, "scene", ownVerdict(scene), scene.error, "");
  for (const ViewResult& view : scene.views) {
    const std::string className = scene.name + "." + view.name;
    addCase(suite, className, "(whole image)", view.wholeVerdict, view.reason,
            figureLines(view.whole, view.test, view.checks) + baselineLines(view.baseline) + ruleLines(view.rule) +
                againLine(view.wholeVerdict, again.of(scene, view, nullptr)),
            view.accepted);
    for (const MaterialResult& material : view.materials)
      addCase(suite, className, material.name, material.verdict, material.reason,
              materialDetails(material, view.reference) + againLine(material.verdict, again.of(scene, view, &material)),
              material.accepted);
  }
  return suite;
}

// What concerns the run as a whole. CI servers follow cases by name, so that a name holds no figures.
Suite makeRunSuite(const Report& report, const std::vector<RunProblem>& problems) {
  Suite suite{"run", "", {}};
  for (std::size_t i = 0; i < problems.size(); ++i)
    addCase(suite, "run", fmt::format("problem {}", i + 1), problems[i].verdict, problems[i].reason, "");
  for (std::size_t i = 0; i < report.warnings.size(); ++i)
    addCase(suite, "run", fmt::format("warning {}", i + 1), compare::Verdict::warn, report.warnings[i], "");
  return suite;
}

Suite makeBaselineSuite(const BaselineSummary& baseline) {
  Suite suite{"baseline", "", {}};
  addCase(suite, "baseline", baseline.source, baseline.error.empty() ? compare::Verdict::pass : compare::Verdict::error,
          baseline.error, "");
  for (const GoneRow& row : baseline.gone)
    addCase(suite, "baseline", describeGone(row), compare::Verdict::warn, describeGone(row), "");
  return suite;
}

// What stands in the file besides the scenes' suites: of a report without scenes, of the run, of the baseline.
std::vector<Suite> makeOtherSuites(const Report& report) {
  std::vector<Suite> suites;
  if (report.scenes.empty()) {
    suites.push_back({"report", "", {}});
    addCase(suites.back(), "report", "report", compare::Verdict::error, "the report holds no scene", "");
  }
  const std::vector<RunProblem> problems = problemsOf(report);
  if (!problems.empty() || !report.warnings.empty()) suites.push_back(makeRunSuite(report, problems));
  if (report.baseline) suites.push_back(makeBaselineSuite(*report.baseline));
  return suites;
}

std::string propertiesOf(const Report& report) {
  std::string properties;
  const auto property = [&](const std::string& name, const std::string& value) {
    properties += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", base::escapeMarkup(name),
                              base::escapeMarkup(value));
  };
  property("version", report.version);
  property("device", report.device);
  for (const auto& [name, value] : report.settings) property(name, value);
  return properties;
}

// By scene; of those with one name the first.
std::unordered_map<std::string_view, double> timesOf(const RunInfo& run) {
  std::unordered_map<std::string_view, double> times;
  for (const SceneTime& each : run.sceneTimes) times.emplace(each.scene, each.seconds);
  return times;
}

std::string timeAttribute(std::optional<double> seconds) {
  return seconds ? fmt::format(" time=\"{:.3f}\"", *seconds) : "";
}

} // namespace

void writeJunit(const Report& report, const RunInfo& run, const base::TextSink& sink) {
  const std::vector<Suite> others = makeOtherSuites(report);
  const std::unordered_map<std::string_view, double> times = timesOf(run);
  Tally total;
  std::optional<double> seconds;
  for (const SceneResult& scene : report.scenes) total.add(tallyOf(scene));
  for (const Suite& suite : others) total.add(suite.tally);
  for (const SceneTime& each : run.sceneTimes) seconds = seconds.value_or(0) + each.seconds;

  const std::string properties = propertiesOf(report);
  const std::string timestamp =
      run.startedAt.empty() ? "" : fmt::format(" timestamp=\"{}\"", base::escapeMarkup(run.startedAt));
  sink("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  sink(fmt::format("<testsuites name=\"{}\" {}{}>\n",
                   base::escapeMarkup(report.suite.empty() ? report.tool : report.suite), total.attributes(),
                   timeAttribute(seconds)));
  const auto write = [&](const Suite& suite) {
    sink(fmt::format("  <testsuite name=\"{}\" {}{}{}>\n    <properties>\n{}    </properties>\n{}  </testsuite>\n",
                     base::escapeMarkup(suite.name), suite.tally.attributes(), timeAttribute(suite.seconds), timestamp,
                     properties, suite.cases));
  };
  const AgainCommands again(run);
  for (const SceneResult& scene : report.scenes) {
    Suite suite = makeSuite(scene, again);
    if (const auto time = times.find(scene.name); time != times.end()) suite.seconds = time->second;
    write(suite);
  }
  for (const Suite& suite : others) write(suite);
  sink("</testsuites>\n");
}

std::string toJunit(const Report& report, const RunInfo& run) {
  std::string xml;
  writeJunit(report, run, [&](std::string_view piece) { xml += piece; });
  return xml;
}

} // namespace parity::report

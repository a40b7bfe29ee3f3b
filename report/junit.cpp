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

// What a case is to a CI server. JUnit knows no warnings: such a case passes, unless warnings fail the run.
enum class Outcome { passed, warned, skipped, failed, failedByWarning, broken };

Outcome outcomeOf(compare::Verdict verdict, bool warningsFail) {
  switch (verdict) {
  case compare::Verdict::pass:
    return Outcome::passed;
  case compare::Verdict::warn:
    return warningsFail ? Outcome::failedByWarning : Outcome::warned;
  case compare::Verdict::notSeen:
  case compare::Verdict::tooSmall:
  case compare::Verdict::notJudged:
    return warningsFail ? Outcome::failedByWarning : Outcome::skipped;
  case compare::Verdict::notRun:
    return Outcome::skipped;
  case compare::Verdict::fail:
    return Outcome::failed;
  case compare::Verdict::error:
    break;
  }
  return Outcome::broken;
}

// Another view judges a material that this one does not show: that fails no run.
Outcome outcomeOf(const MaterialResult& material, bool warningsFail) {
  return outcomeOf(material.verdict, warningsFail && !material.seenElsewhere);
}

struct Tally {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;

  void add(Outcome outcome) {
    ++tests;
    failures += outcome == Outcome::failed || outcome == Outcome::failedByWarning;
    errors += outcome == Outcome::broken;
    skipped += outcome == Outcome::skipped;
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

// One case and its words.
struct Case {
  std::string className, name;
  compare::Verdict verdict = compare::Verdict::pass;
  Outcome outcome = Outcome::passed;
  std::string reason, details = {}, accepted = {};
};

void addCase(Suite& suite, const Case& each) {
  suite.tally.add(each.outcome);
  suite.cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n", base::escapeMarkup(each.className),
                             base::escapeMarkup(each.name));
  const auto element = [&](const char* tag, const char* type) {
    suite.cases += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", tag, type,
                               base::escapeMarkup(each.reason), base::escapeMarkup(each.details));
  };
  const auto say = [&](const char* what, const std::string& words) {
    suite.cases += fmt::format("      <system-out>{}</system-out>\n",
                               base::escapeMarkup(fmt::format("{}: {}\n{}", what, words, each.details)));
  };
  switch (each.outcome) {
  case Outcome::passed: // what the budget accepts is said
    if (!each.accepted.empty()) say("accepted", each.accepted);
    break;
  case Outcome::warned:
    say("warning", each.reason);
    break;
  case Outcome::skipped:
    suite.cases +=
        fmt::format("      <skipped message=\"{}: {}\"/>\n", nameOf(each.verdict), base::escapeMarkup(each.reason));
    break;
  case Outcome::failed:
    element("failure", "budget");
    break;
  case Outcome::failedByWarning:
    element("failure", "warning");
    break;
  case Outcome::broken:
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
  const std::string cause = describeCauses(material, reference);
  if (!cause.empty()) details += "cause: " + cause + "\n";
  for (const std::string& note : material.notes) details += "note: " + note + "\n";
  return details + baselineLines(material.baseline) + ruleLines(material.rule);
}

// The cases that makeSuite has.
Tally tallyOf(const SceneResult& scene, bool warningsFail) {
  Tally tally;
  if (!scene.error.empty()) tally.add(outcomeOf(ownVerdict(scene), warningsFail));
  for (const ViewResult& view : scene.views) {
    tally.add(outcomeOf(view.wholeVerdict, warningsFail));
    for (const MaterialResult& material : view.materials) tally.add(outcomeOf(material, warningsFail));
  }
  return tally;
}

Suite makeSuite(const SceneResult& scene, const AgainCommands& again, bool warningsFail) {
  Suite suite{scene.name, "", {}};
  if (!scene.error.empty())
    addCase(suite, {scene.name, "scene", ownVerdict(scene), outcomeOf(ownVerdict(scene), warningsFail), scene.error});
  for (const ViewResult& view : scene.views) {
    const std::string className = scene.name + "." + view.name;
    addCase(suite,
            {className, "(whole image)", view.wholeVerdict, outcomeOf(view.wholeVerdict, warningsFail), view.reason,
             figureLines(view.whole, view.test, view.checks) + baselineLines(view.baseline) + ruleLines(view.rule) +
                 againLine(view.wholeVerdict, again.of(scene, view, nullptr)),
             view.accepted});
    for (const MaterialResult& material : view.materials)
      addCase(suite, {className, material.name, material.verdict, outcomeOf(material, warningsFail), material.reason,
                      materialDetails(material, view.reference) +
                          againLine(material.verdict, again.of(scene, view, &material)),
                      material.accepted});
  }
  return suite;
}

// What stands in the file besides the scenes' suites.
class OtherSuites {
public:
  explicit OtherSuites(bool warningsFail) : m_warningsFail(warningsFail) {}

  std::vector<Suite> of(const Report& report) {
    if (report.scenes.empty()) {
      m_suites.push_back({"report", "", {}});
      add("report", compare::Verdict::error, "the report holds no scene");
    }
    const std::vector<RunProblem> problems = problemsOf(report);
    if (!problems.empty() || !report.warnings.empty()) addRun(problems, report.warnings);
    if (report.baseline) addBaseline(*report.baseline);
    return std::move(m_suites);
  }

private:
  void add(const std::string& name, compare::Verdict verdict, const std::string& reason) {
    addCase(m_suites.back(), {m_suites.back().name, name, verdict, outcomeOf(verdict, m_warningsFail), reason});
  }
  // What concerns the run as a whole. CI servers follow cases by name, so that a name holds no figures.
  void addRun(const std::vector<RunProblem>& problems, const std::vector<std::string>& warnings) {
    m_suites.push_back({"run", "", {}});
    for (std::size_t i = 0; i < problems.size(); ++i)
      add(fmt::format("problem {}", i + 1), problems[i].verdict, problems[i].reason);
    for (std::size_t i = 0; i < warnings.size(); ++i)
      add(fmt::format("warning {}", i + 1), compare::Verdict::warn, warnings[i]);
  }
  void addBaseline(const BaselineSummary& baseline) {
    m_suites.push_back({"baseline", "", {}});
    add(baseline.source, baseline.error.empty() ? compare::Verdict::pass : compare::Verdict::error, baseline.error);
    for (const GoneRow& row : baseline.gone) add(describeGone(row), compare::Verdict::warn, describeGone(row));
  }

  bool m_warningsFail;
  std::vector<Suite> m_suites;
};

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
  const std::vector<Suite> others = OtherSuites(run.warningsFail).of(report);
  const std::unordered_map<std::string_view, double> times = timesOf(run);
  Tally total;
  std::optional<double> seconds;
  for (const SceneResult& scene : report.scenes) total.add(tallyOf(scene, run.warningsFail));
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
    Suite suite = makeSuite(scene, again, run.warningsFail);
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

// The result of parity flip for CI servers: JUnit XML and annotations.
#include <fmt/format.h>

#include "compare/report.h"
#include "compare/text.h"
#include "compare/wording.h"
#include "job/flip_text.h"

namespace parity::job {

namespace {

using compare::escapeMarkup;
using compare::Verdict;

std::string describeFigures(const FlipRow& row) {
  std::string lines;
  for (const compare::CheckResult& check : row.checks) lines += compare::describeCheck(check) + "\n";
  for (const compare::Figure& figure : row.figures.all.values)
    lines += fmt::format("{} {}\n", figure.name, compare::formatFigure(figure.name, figure.value));
  return lines;
}

std::string makeCase(const std::string& pair, const std::string& name, Verdict verdict, const std::string& reason,
                     const std::string& details) {
  const std::string message = escapeMarkup(reason), text = escapeMarkup(details);
  std::string inner;
  if (verdict == Verdict::fail)
    inner = fmt::format("      <failure type=\"limit\" message=\"{}\">{}</failure>\n", message, text);
  else if (verdict == Verdict::error)
    inner = fmt::format("      <error type=\"error\" message=\"{}\">{}</error>\n", message, text);
  else if (verdict != Verdict::pass)
    inner = fmt::format("      <system-out>warning: {}\n{}</system-out>\n", message, text);
  return fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n{}    </testcase>\n", escapeMarkup(pair),
                     escapeMarkup(name), inner);
}

struct Tally {
  std::size_t tests = 0, failures = 0, errors = 0;
  void count(Verdict verdict) {
    ++tests;
    failures += verdict == Verdict::fail;
    errors += verdict == Verdict::error;
  }
  std::string attributes() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", tests, failures, errors);
  }
};

} // namespace

std::string toJunit(const FlipResult& result) {
  Tally total;
  std::string suites;
  for (const FlipPair& pair : result.pairs) {
    Tally tally;
    std::string cases;
    const auto add = [&](const std::string& name, Verdict verdict, const std::string& reason, const std::string& text) {
      tally.count(verdict);
      total.count(verdict);
      cases += makeCase(pair.files.name, name, verdict, reason, text);
    };
    for (const FlipRow& row : pair.rows) add(row.figures.name, row.verdict, row.reason, describeFigures(row));
    // Also where an error came after the figures: a map that could not be written.
    if (pair.rows.empty() || pair.verdict == Verdict::error) add("pair", pair.verdict, pair.reason, "");
    suites += fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", escapeMarkup(pair.files.name),
                          tally.attributes(), cases);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"parity flip\" {}>\n{}</testsuites>\n",
      total.attributes(), suites);
}

std::string toAnnotations(const FlipResult& result) {
  // What failed goes where a report has scenes that could not be compared: the writer escapes and orders.
  compare::Report report;
  const auto add = [&](Verdict verdict, const std::string& name, const std::string& reason) {
    if (verdict == Verdict::pass) return;
    if (verdict < Verdict::fail) return report.warnings.push_back(name + ": " + reason);
    compare::SceneResult failed;
    failed.name = name;
    failed.error = reason;
    report.scenes.push_back(std::move(failed));
  };
  for (const FlipPair& pair : result.pairs) {
    for (const FlipRow& row : pair.rows)
      add(row.verdict, pair.rows.size() > 1 ? pair.files.name + ", " + row.figures.name : pair.files.name, row.reason);
    if (pair.verdict == Verdict::error) add(pair.verdict, pair.files.name, pair.reason);
  }
  // A report without scenes is an error of its own, which a run without failures is not.
  if (report.scenes.empty() && !result.pairs.empty()) report.scenes.emplace_back();
  return compare::toGithubAnnotations(report, {});
}

} // namespace parity::job

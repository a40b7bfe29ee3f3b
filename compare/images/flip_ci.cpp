// The result of parity flip for CI servers: JUnit XML and annotations.
#include <fmt/format.h>

#include "base/text/github_command.h"
#include "base/text/text.h"
#include "compare/images/flip_text.h"
#include "compare/verdict/wording.h"

namespace parity::compare {

namespace {

using base::escapeMarkup;

std::string describeFigures(const FlipRow& row) {
  std::string lines;
  for (const CheckResult& check : row.checks) lines += describeCheck(check) + "\n";
  for (const Figure& figure : row.figures.values)
    lines += fmt::format("{} {}\n", figure.name, formatFigure(figure.name, figure.value));
  return lines;
}

std::string makeCase(const std::string& pair, const std::string& name, Verdict verdict, const std::string& reason,
                     const std::string& details, bool judged) {
  const std::string message = base::escapeMarkup(reason), text = base::escapeMarkup(details);
  std::string inner;
  if (verdict == Verdict::fail)
    inner = fmt::format("      <failure type=\"limit\" message=\"{}\">{}</failure>\n", message, text);
  else if (verdict == Verdict::error)
    inner = fmt::format("      <error type=\"error\" message=\"{}\">{}</error>\n", message, text);
  else if (verdict != Verdict::pass)
    inner = fmt::format("      <system-out>warning: {}\n{}</system-out>\n", message, text);
  else if (!judged)
    inner = "      <skipped message=\"not judged: no limits were given\"/>\n";
  return fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n{}    </testcase>\n", base::escapeMarkup(pair),
                     base::escapeMarkup(name), inner);
}

struct Tally {
  bool judged = true;
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  void count(Verdict verdict) {
    ++tests;
    failures += verdict == Verdict::fail;
    errors += verdict == Verdict::error;
    skipped += verdict == Verdict::pass && !judged;
  }
  std::string attributes() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"", tests, failures, errors, skipped);
  }
};

} // namespace

std::string toJunit(const FlipResult& result) {
  Tally total{result.judged};
  std::string suites;
  for (const FlipPair& pair : result.pairs) {
    Tally tally{result.judged};
    std::string cases;
    const auto add = [&](const std::string& name, Verdict verdict, const std::string& reason, const std::string& text) {
      tally.count(verdict);
      total.count(verdict);
      cases += makeCase(pair.files.name, name, verdict, reason, text, result.judged);
    };
    for (const FlipRow& row : pair.rows) add(row.name, row.verdict, row.reason, describeFigures(row));
    // Also where an error came after the figures: a map that could not be written.
    if (pair.rows.empty() || pair.verdict == Verdict::error) add("pair", pair.verdict, pair.reason, "");
    suites += fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", base::escapeMarkup(pair.files.name),
                          tally.attributes(), cases);
  }
  if (!result.warnings.empty()) {
    Tally tally;
    std::string cases;
    for (const std::string& warning : result.warnings) {
      tally.count(Verdict::warn);
      total.count(Verdict::warn);
      cases += makeCase("run", "warning", Verdict::warn, warning, "", true);
    }
    suites += fmt::format("  <testsuite name=\"run\" {}>\n{}  </testsuite>\n", tally.attributes(), cases);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"parity flip\" {}>\n{}</testsuites>\n",
      total.attributes(), suites);
}

std::string toAnnotations(const FlipResult& result, const std::filesystem::path& root) {
  std::string errors, warnings;
  const auto add = [&](const FlipPair& pair, Verdict verdict, const std::string& name, const std::string& reason,
                       const AppliedRule& rule) {
    if (verdict == Verdict::pass) return;
    base::GithubCommand command{verdict >= Verdict::fail, "parity: " + name,
                                fmt::format("{}: {}", nameOf(verdict), reason), rule.file, rule.line};
    if (rule.line == 0) command.file = pair.files.list.string(), command.line = pair.files.line;
    if (!rule.reason.empty()) command.message += "\nReason for the budget: " + rule.reason;
    if (!rule.owner.empty()) command.message += "\nOwner: " + rule.owner;
    (command.error ? errors : warnings) += base::toText(command, root);
  };
  for (const FlipPair& pair : result.pairs) {
    if (pair.errorCode != 0) {
      add(pair, pair.verdict, pair.files.name, pair.reason, {});
      continue;
    }
    for (const FlipRow& row : pair.rows)
      add(pair, row.verdict, pair.rows.size() > 1 ? pair.files.name + ", " + row.name : pair.files.name, row.reason,
          row.rule);
  }
  for (const std::string& warning : result.warnings) warnings += base::toText({false, "parity", warning, "", 0}, root);
  return errors + warnings; // GitHub shows the first ten of a kind
}

} // namespace parity::compare

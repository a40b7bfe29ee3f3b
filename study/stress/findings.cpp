// What the tallies of a function come to, in words.
#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "study/stress/function_stress.h"

namespace parity::stress {

namespace {

std::string describeExample(const FunctionCase& function, Fault fault, const Example& example) {
  const std::string row = formatAt(function, example.row);
  if (example.second)
    return fmt::format("output {} from {} to {}: error of {:.3g} units in the last place", example.output, row,
                       formatAt(function, *example.second), example.value);
  if (fault == Fault::negative) return fmt::format("output {} is {:.4g} at {}", example.output, -example.value, row);
  if (fault == Fault::overUnity) return fmt::format("output {} is {:.6g} at {}", example.output, example.value, row);
  return "at " + row;
}

Finding makeFinding(const FunctionResult& result, const Column& column, std::string fault) {
  Finding finding;
  finding.subject = result.function.name;
  finding.place = column.name();
  finding.fault = std::move(fault);
  return finding;
}

void addUnexpected(const FunctionResult& result, const Column& column, std::vector<Finding>& findings) {
  for (std::size_t f = 0; f < kFaultCount; ++f) {
    const FaultCount& count = column.tally.faults[f];
    if (count.unexpected == 0) continue;
    Finding finding = makeFinding(result, column, nameOf(static_cast<Fault>(f)));
    finding.count = count.unexpected;
    finding.magnitude = count.worstUnexpected->value;
    finding.example = describeExample(result.function, static_cast<Fault>(f), *count.worstUnexpected);
    finding.reproduce = "--at " + formatAt(result.function, count.worstUnexpected->row);
    findings.push_back(finding);
  }
}

void addExpected(const FunctionResult& result, const Column& column, std::vector<Finding>& findings) {
  for (std::size_t e = 0; e < result.function.expected.size(); ++e) {
    const Expectation& expected = result.function.expected[e];
    if (!(expected.precisions & bitOf(column.precision))) continue;
    const std::uint64_t hits = column.tally.expectationHits[e];
    Finding finding = makeFinding(result, column, nameOf(expected.fault));
    finding.region = expected.regionText;
    finding.reason = expected.reason;
    finding.reproduce = "--at " + formatAt(result.function, expected.witness);
    finding.count = hits;
    finding.expected = hits > 0;
    if (hits == 0) {
      finding.fault = fmt::format("vanished: {}", nameOf(expected.fault));
      finding.example = fmt::format("the table expects it for {}, but no row shows it; remove it from the table",
                                    expected.regionText);
    } else if (const auto& worst = column.tally.faults[static_cast<std::size_t>(expected.fault)].worst) {
      finding.magnitude = worst->value;
      if (worst->value > 0) finding.example = describeExample(result.function, expected.fault, *worst);
    }
    findings.push_back(finding);
  }
}

} // namespace

std::vector<Finding> findingsOf(const FunctionResult& result) {
  std::vector<Finding> findings;
  for (const Column& column : result.columns) {
    if (!column.skipped.empty()) continue;
    addUnexpected(result, column, findings);
    addExpected(result, column, findings);
  }
  return findings;
}

void sortFindings(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.expected, a.subject, a.fault, a.place) < std::tie(b.expected, b.subject, b.fault, b.place);
  });
}

} // namespace parity::stress

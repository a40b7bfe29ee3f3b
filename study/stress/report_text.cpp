// parity stress on a terminal: findings first, then the worst errors.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "study/stress/stress_run.h"

namespace parity::stress {

namespace {

constexpr std::size_t kWorstShown = 15;

std::string describeFindings(const Report& report) {
  std::string text;
  for (const Finding& finding : report.findings) {
    if (finding.expected) continue;
    text += fmt::format("UNEXPECTED  {} ({}): {}", finding.subject, finding.place, finding.fault);
    if (finding.count > 0) text += fmt::format(", {} times", finding.count);
    text += fmt::format("\n    {}\n", finding.example);
    if (!finding.reason.empty()) text += fmt::format("    the table expected it because {}\n", finding.reason);
    text += fmt::format("    parity stress {}\n", finding.reproduce);
  }
  // What is known: a line for each, whatever the precisions and sides.
  std::map<std::string, std::pair<std::string, std::uint64_t>> known;
  for (const Finding& finding : report.findings)
    if (finding.expected) {
      auto& [places, count] = known[fmt::format("{}: {} where {}", finding.subject, finding.fault, finding.region)];
      places += (places.empty() ? "" : ", ") + finding.place;
      count += finding.count;
    }
  for (const auto& [what, where] : known) text += fmt::format("expected    {} ({})\n", what, where.first);
  return text;
}

struct WorstError {
  const FunctionResult* result;
  const Column* column;
  double p999, greatest;
};

std::string describeErrors(const Report& report) {
  std::vector<WorstError> worst;
  for (const FunctionResult& result : report.functions)
    for (const Column& column : result.columns)
      if (!column.onDevice && column.precision == Precision::f16)
        worst.push_back({&result, &column, column.tally.errors.percentile(0.999),
                         column.tally.worstError ? column.tally.worstError->value : 0});
  std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.p999 > b.p999; });
  std::string text = fmt::format("\n{:<26} {:>10} {:>10} {:>10} {:>10} {:>9}\n", "worst in half, of all", "fp16 99.9%",
                                 "fp16 max", "fp32 99.9%", "fp32 max", "dev. ulp");
  for (std::size_t i = 0; i < std::min(kWorstShown, worst.size()); ++i) {
    const FunctionResult& result = *worst[i].result;
    double p999 = 0, greatest = 0, ulps = 0;
    for (const Column& column : result.columns) {
      ulps = std::max(ulps, column.tally.greatestUlps);
      if (column.onDevice || column.precision != Precision::f32) continue;
      p999 = column.tally.errors.percentile(0.999);
      greatest = column.tally.worstError ? column.tally.worstError->value : 0;
    }
    text += fmt::format("{:<26} {:>10.3g} {:>10.3g} {:>10.3g} {:>10.3g} {:>9.3g}\n", result.function.name,
                        worst[i].p999, worst[i].greatest, p999, greatest, ulps);
  }
  return text;
}

} // namespace

std::string formatReport(const Report& report) {
  std::string text = describeFindings(report);
  if (!report.functions.empty()) {
    text += describeErrors(report);
    text += fmt::format("\n{} functions, {} points each on the CPU in fp64, fp32 and fp16", report.functions.size(),
                        report.points);
    text += report.devicePoints > 0 ? fmt::format(", {} on the device ({})\n", report.devicePoints, report.deviceName)
                                    : ", none on the device (--device-points 0)\n";
  }
  if (!report.scenes.empty())
    text += fmt::format("{} scenes, each rendered twice by {} paths, with the validation layers ({})\n",
                        report.scenes.size(), report.scenes.front().paths.size(), report.deviceName);
  if (!report.failure.empty()) text += fmt::format("stopped early: {}\n", report.failure);
  if (!report.halfSkipped.empty()) text += fmt::format("skipped: fp16 on the device: {}\n", report.halfSkipped);
  text += fmt::format("{} unexpected, {} expected findings\n", report.unexpected(),
                      report.findings.size() - report.unexpected());
  return text;
}

std::string formatList(const Options& options) {
  std::string text = "Functions of shading/, their inputs and requirements:\n";
  for (const FunctionCase& function : functionsNamed(options.functionGlob)) {
    text += fmt::format("  {}\n", function.name);
    for (const Input& input : function.domain.inputs)
      text += input.spacing == Spacing::direction ? fmt::format("      {:<22} a unit vector\n", input.name)
                                                  : fmt::format("      {:<22} {} to {}\n", input.name,
                                                                formatExactly(input.low), formatExactly(input.high));
    if (function.errorScale > 0)
      text += fmt::format("      errors are relative to at least {:.3g}\n", function.errorScale);
    for (const Claim& claim : function.claims) {
      const std::string& input = function.domain.inputs[static_cast<std::size_t>(claim.input)].name;
      text += claim.kind == Claim::Kind::symmetric
                  ? fmt::format("      unchanged if {} and {} are swapped\n", input,
                                function.domain.inputs[static_cast<std::size_t>(claim.other)].name)
                  : fmt::format("      {} with {}\n", claim.kind == Claim::Kind::increasing ? "grows" : "falls", input);
    }
    for (const Expectation& expected : function.expected)
      text += fmt::format("      expected: {} where {}: {}\n", nameOf(expected.fault), expected.regionText,
                          expected.reason);
  }
  text += "Scenes:\n";
  for (const StressScene& scene : namedScenes()) text += fmt::format("  {:<28} {}\n", scene.name, scene.wants);
  return text + "  random-SEED                  finite, the terms sum to the colour, two renders have the same bits\n";
}

} // namespace parity::stress

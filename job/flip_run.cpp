#include "job/flip_run.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "base/error.h"
#include "job/flip_pair.h"

namespace parity::job {

namespace {

using compare::Verdict;

bool isUsage(const base::Error& error) { return error.code() == base::ExitCode::usage; }

} // namespace

std::vector<std::string> defaultFlipMetrics(bool hdr) {
  return hdr ? std::vector<std::string>{"hdrflip", "relmse", "bias"}
             : std::vector<std::string>{"flip", "rmse", "psnr", "bias"};
}

void requireSense(const FlipRequest& request) {
  for (const std::string& name : request.metrics) {
    const compare::Metric& metric = compare::requireMetric(name, "--metrics");
    if (metric.needsLinear && request.range == DynamicRange::ldr)
      throw base::Error(base::ExitCode::usage, "--ldr", name, "does not apply to LDR: it needs linear light");
  }
  for (const compare::BudgetCheck& check : makeChecks(request.thresholds, request.range == DynamicRange::hdr))
    if (request.range == DynamicRange::ldr && compare::requireMetric(check.statistic.metric, "--metric").needsLinear)
      throw base::Error(base::ExitCode::usage, "--ldr", check.statistic.name,
                        "does not apply to LDR: it needs linear light");
}

FlipResult runFlip(const FlipRequest& request, const std::function<void(const std::string&, double)>& progress) {
  requireSense(request);
  FlipResult result;
  result.judged = !request.thresholds.empty() || request.budgets;
  const std::size_t count = request.files.pairs.size();
  for (const FilePair& files : request.files.pairs) {
    if (progress) progress(files.name, static_cast<double>(result.pairs.size()) / static_cast<double>(count));
    FlipPair pair;
    pair.files = files;
    try {
      compareFiles(request, pair);
    } catch (const base::Error& error) {
      if (isUsage(error)) throw;
      pair.verdict = Verdict::error;
      pair.reason = error.what();
      pair.errorCode = error.code() == base::ExitCode::notComparable ? 3 : 4;
    } catch (const std::bad_alloc&) {
      pair.verdict = Verdict::error;
      pair.reason = files.name + ": needs more memory than there is";
      pair.errorCode = 4;
    }
    result.pairs.push_back(std::move(pair));
  }
  if (progress) progress("", 1);
  return result;
}

Verdict worstVerdict(const FlipResult& result) {
  Verdict worst = Verdict::pass;
  for (const FlipPair& pair : result.pairs) worst = std::max(worst, pair.verdict);
  return result.pairs.empty() ? Verdict::error : worst;
}

int exitCode(const FlipPair& pair, bool warnExit) {
  switch (pair.verdict) {
  case Verdict::pass:
    return static_cast<int>(base::ExitCode::withinBudget);
  case Verdict::notSeen:
  case Verdict::warn:
    return warnExit ? static_cast<int>(base::ExitCode::warningsOnly) : 0;
  case Verdict::fail:
    return static_cast<int>(base::ExitCode::overBudget);
  case Verdict::error:
    break;
  }
  return pair.errorCode == 3 ? 3 : static_cast<int>(base::ExitCode::failed);
}

int exitCode(const FlipResult& result, bool warnExit) {
  int code = result.pairs.empty() ? static_cast<int>(base::ExitCode::failed) : 0;
  for (const FlipPair& pair : result.pairs) code = std::max(code, exitCode(pair, warnExit));
  return code;
}

} // namespace parity::job

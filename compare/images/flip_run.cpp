#include "compare/images/flip_run.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/text/error_words.h"
#include "compare/images/flip_pair.h"

namespace parity::compare {

namespace {

bool isUsage(const base::Error& error) { return error.code() == base::ExitCode::usage; }

void setError(FlipPair& pair, const std::string& reason, int exitCode) {
  pair.verdict = Verdict::error;
  pair.reason = reason;
  pair.errorCode = exitCode;
}

// The rules that judged nothing: pairs are the scenes, regions are the materials.
std::string describeUnused(const Budgets& budgets, const FlipResult& result) {
  std::vector<JudgedScene> scenes;
  for (const FlipPair& pair : result.pairs) {
    JudgedScene& scene = scenes.emplace_back();
    scene.name = pair.files.name;
    scene.isError = pair.rows.empty() && !pair.reason.empty();
    for (const FlipRow& row : pair.rows) (row.whole ? scene.wholes : scene.materials).push_back(row.rule);
  }
  return describeUnusedRules(budgets, scenes);
}

} // namespace

std::vector<std::string> defaultFlipMetrics(bool hdr) {
  return hdr ? std::vector<std::string>{"hdrflip", "relmse", "bias"}
             : std::vector<std::string>{"flip", "rmse", "psnr", "bias"};
}

void requireSense(const FlipRequest& request) {
  for (const std::string& name : request.metrics) {
    const Metric& metric = requireMetric(name, "--metrics");
    if (metric.needsLinear && request.range == DynamicRange::ldr)
      throw base::Error(base::ExitCode::usage, "--ldr", name, "does not apply to LDR: it needs linear light");
  }
  if (request.range == DynamicRange::ldr && !request.hdrOptions.empty())
    throw base::Error(base::ExitCode::usage, "--ldr", request.hdrOptions.front(), "needs HDR-FLIP");
  for (const BudgetCheck& check : makeChecks(request.thresholds, request.range == DynamicRange::hdr))
    if (request.range == DynamicRange::ldr && requireMetric(check.statistic.metric, "--metric").needsLinear)
      throw base::Error(base::ExitCode::usage, "--ldr", check.statistic.name,
                        "does not apply to LDR: it needs linear light");
}

FlipResult runFlip(const FlipRequest& request, const std::function<void(const std::string&, double)>& progress) {
  requireSense(request);
  FlipResult result;
  result.judged = !request.thresholds.empty() || request.budgets;
  const std::size_t count = request.files.pairs.size();
  for (const FilePair& files : request.files.pairs) {
    base::setInterruptNote(
        fmt::format("interrupted: {} of {} pairs are compared; finished maps stay, but no table, JSON, "
                    "CSV or JUnit was written",
                    result.pairs.size(), count));
    if (progress) progress(files.name, static_cast<double>(result.pairs.size()) / static_cast<double>(count));
    FlipPair pair;
    pair.files = files;
    try {
      compareFiles(request, pair);
      base::logDetail(fmt::format("{}: {} x {} pixels, {}, {} ({}); {} region{}, {} file{} written", files.name,
                                  pair.width, pair.height, pair.channels, pair.hdr ? "HDR" : "LDR", pair.rangeReason,
                                  pair.rows.size(), pair.rows.size() == 1 ? "" : "s", pair.written.size(),
                                  pair.written.size() == 1 ? "" : "s"));
    } catch (const base::Error& error) {
      // One of many pairs is no reason to lose what was found of the others.
      if (isUsage(error) && !request.files.many) throw;
      setError(pair, error.what(), error.code() == base::ExitCode::notComparable ? 3 : 4);
    } catch (const std::bad_alloc&) {
      setError(pair, files.name + ": out of memory; a lower --max-memory rejects such pairs in advance", 4);
    } catch (const std::exception& error) {
      setError(pair, files.name + ": " + base::wordsOf(error), 4);
    }
    result.pairs.push_back(std::move(pair));
  }
  if (progress) progress("", 1);
  result.skipped = request.files.skipped;
  if (request.budgets)
    if (std::string line = describeUnused(*request.budgets, result); !line.empty())
      result.warnings.push_back(std::move(line) +
                                (request.mask.file.empty() ? " (without a mask, pairs are whole images)" : ""));
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
  case Verdict::tooSmall: // these two are of a report's materials
  case Verdict::notJudged:
  case Verdict::warn:
    return warnExit ? static_cast<int>(base::ExitCode::warningsOnly) : 0;
  case Verdict::fail:
    return static_cast<int>(base::ExitCode::overBudget);
  case Verdict::notRun: // of a report's scenes
  case Verdict::error:
    break;
  }
  return pair.errorCode == 3 ? 3 : static_cast<int>(base::ExitCode::failed);
}

int exitCode(const FlipResult& result, bool warnExit) {
  int code = result.pairs.empty() ? static_cast<int>(base::ExitCode::failed) : 0;
  if (warnExit && !result.warnings.empty()) code = std::max(code, static_cast<int>(base::ExitCode::warningsOnly));
  for (const FlipPair& pair : result.pairs) code = std::max(code, exitCode(pair, warnExit));
  return code;
}

} // namespace parity::compare

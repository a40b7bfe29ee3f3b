#include "compare/metrics/measure_plan.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/metrics/color_rows.h"
#include "compare/metrics/metric_parts.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::uint64_t countWithin(const RegionRuns& region, const std::vector<std::uint32_t>& pixels) {
  std::uint64_t count = 0;
  auto next = pixels.begin();
  for (const Run& run : region.runs) {
    next = std::lower_bound(next, pixels.end(), run.first);
    if (next == pixels.end()) break;
    const auto end = std::lower_bound(next, pixels.end(), run.first + run.count);
    count += static_cast<std::uint64_t>(end - next);
    next = end;
  }
  return count;
}

enum Light { kBlack, kWhite, kReferenceLuma, kTestLuma, kReferenceLuminance, kTestLuminance };

void lightRow(RowSource& row, float* const* out) {
  const float *reference = row.displayed(0), *test = row.displayed(1);
  float *black = out[kBlack], *white = out[kWhite];
  for (int x = 0, n = row.count(); x < n; ++x) { // 1 where every value of both images is clipped
    const float *a = reference + 3 * x, *b = test + 3 * x;
    black[x] = std::max({a[0], a[1], a[2], b[0], b[1], b[2]}) <= 0 ? 1.f : 0.f;
    white[x] = std::min({a[0], a[1], a[2], b[0], b[1], b[2]}) >= 1 ? 1.f : 0.f;
  }
  for (int i = 0; i < 2; ++i) {
    lumaRow(row.displayed(i), row.count(), out[kReferenceLuma + i]);
    lumaRow(row.light(i), row.count(), out[kReferenceLuminance + i]);
  }
}

} // namespace

std::vector<MeasurePlan> makeMeasurePlans(const MeasureRequest& request, bool hasLinear) {
  for (const std::string& name : request.metrics) requireMetric(name, "metrics");
  for (const std::string& name : request.keepMaps) requireMetric(name, "maps");
  std::vector<Statistic> extra;
  for (const std::string& name : request.statistics) extra.push_back(requireStatistic(name, "figures"));

  std::vector<MeasurePlan> plans;
  for (const Metric& metric : metricRegistry()) {
    MeasurePlan plan{&metric, {}, holds(request.keepMaps, metric.name)};
    const bool whole = holds(request.metrics, metric.name);
    const auto isExtra = [&](const Statistic& s) {
      return std::any_of(extra.begin(), extra.end(), [&](const Statistic& e) { return e.name == s.name; });
    };
    for (const Statistic& statistic : metric.statistics)
      if (whole || isExtra(statistic)) plan.statistics.push_back(statistic);
    for (const Statistic& statistic : extra) { // those with a parameter
      const auto isIt = [&](const Statistic& s) { return s.name == statistic.name; };
      if (statistic.metric == metric.name && std::none_of(plan.statistics.begin(), plan.statistics.end(), isIt))
        plan.statistics.push_back(statistic);
    }
    if (plan.statistics.empty() && !plan.keepMap) continue;
    if (metric.needsLinear && !hasLinear)
      throw base::Error(base::ExitCode::notComparable, metric.name, "",
                        "needs linear (HDR) images, but these are displayed images");
    plans.push_back(std::move(plan));
  }
  return plans;
}

const MeanRows& lightRows() {
  static const MeanRows kRows{{0, 0, 0, 0, 0, 0}, lightRow};
  return kRows;
}

void fillLight(const MetricInput& input, std::span<const RegionRuns> regions,
               std::span<const std::vector<double>> means, std::span<Figures> figures) {
  base::parallelFor(regions.size(), 1, [&](std::size_t i, std::size_t) {
    if (regions[i].pixels == 0) return;
    Figures& own = figures[i];
    own.pixels = regions[i].pixels;
    own.nonFinite = countWithin(regions[i], input.nonFinite);
    own.clippedBlack = std::min(means[i][kBlack], 1.); // rounding
    own.clippedWhite = std::min(means[i][kWhite], 1.);
    own.referenceLuma = means[i][kReferenceLuma];
    own.testLuma = means[i][kTestLuma];
    own.referenceLuminance = means[i][kReferenceLuminance];
    own.testLuminance = means[i][kTestLuminance];
  });
}

} // namespace parity::compare

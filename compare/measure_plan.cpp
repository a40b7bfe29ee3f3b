#include "compare/measure_plan.h"

#include <algorithm>

#include "base/error.h"
#include "compare/color_rows.h"
#include "compare/metric_parts.h"
#include "compare/pooling.h"

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
                        "needs linear (HDR) images; these are displayed ones");
    plans.push_back(std::move(plan));
  }
  return plans;
}

LightMaps makeLightMaps(const MetricInput& input, const Rect& box) {
  const auto make = [&] { return base::Image(input.width(), input.height(), 1); };
  LightMaps maps{make(), make(), make(), make(), make(), make()};
  forRows(box, [&](int y) {
    const auto count = static_cast<std::size_t>(box.width);
    std::vector<float> displayed[2], linear(3 * count);
    for (int i = 0; i < 2; ++i) {
      const PixelView& view = i == 0 ? input.reference : input.test;
      displayed[i].resize(3 * count);
      readDisplayRow(view, box.x, y, box.width, displayed[i].data());
      lumaRow(displayed[i].data(), box.width, (i == 0 ? maps.referenceLuma : maps.testLuma).at(box.x, y));
      readLinearRow(view, i == 0 ? input.referenceLinear : input.testLinear, box.x, y, box.width, linear.data());
      lumaRow(linear.data(), box.width, (i == 0 ? maps.referenceLight : maps.testLight).at(box.x, y));
    }
    float *black = maps.black.at(box.x, y), *white = maps.white.at(box.x, y);
    for (std::size_t x = 0; x < count; ++x) {
      bool isBlack = true, isWhite = true;
      for (std::size_t c = 3 * x; c < 3 * x + 3; ++c)
        for (const std::vector<float>& values : displayed) {
          isBlack = isBlack && values[c] <= 0;
          isWhite = isWhite && values[c] >= 1;
        }
      black[x] = isBlack ? 1.f : 0.f;
      white[x] = isWhite ? 1.f : 0.f;
    }
  });
  for (base::Image* map :
       {&maps.referenceLuma, &maps.testLuma, &maps.referenceLight, &maps.testLight, &maps.black, &maps.white})
    setPixels(*map, input.nonFinite, 0);
  return maps;
}

void fillLight(const LightMaps& maps, const MetricInput& input, const RegionRuns& region, Figures& figures) {
  figures.pixels = region.pixels;
  figures.nonFinite = countWithin(region, input.nonFinite);
  figures.clippedBlack = std::min(meanOf(maps.black, region), 1.); // rounding
  figures.clippedWhite = std::min(meanOf(maps.white, region), 1.);
  figures.referenceLuma = meanOf(maps.referenceLuma, region);
  figures.testLuma = meanOf(maps.testLuma, region);
  figures.referenceLuminance = meanOf(maps.referenceLight, region);
  figures.testLuminance = meanOf(maps.testLight, region);
}

} // namespace parity::compare

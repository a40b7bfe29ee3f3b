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

// 1 where every value of both displayed images is `clipped`; 0 outside the box.
template <typename Clipped> base::Image clippedMap(const MetricInput& input, const Rect& box, const Clipped& clipped) {
  base::Image map(input.width(), input.height(), 1);
  forRows(box, [&](int y) {
    std::vector<float> rows[2];
    for (int i = 0; i < 2; ++i) {
      rows[i].resize(3 * static_cast<std::size_t>(box.width));
      readDisplayRow(i == 0 ? input.reference : input.test, box.x, y, box.width, rows[i].data());
    }
    float* out = map.at(box.x, y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(box.width); ++x) {
      bool isClipped = true;
      for (std::size_t c = 3 * x; c < 3 * x + 3; ++c)
        for (const std::vector<float>& values : rows) isClipped = isClipped && clipped(values[c]);
      out[x] = isClipped ? 1.f : 0.f;
    }
  });
  return map;
}

// Luminance of linear light, as the images have it; 0 outside the box.
base::Image lightMap(const PixelView& view, const base::Image* linear, const Rect& box) {
  base::Image map(view.width, view.height, 1);
  forRows(box, [&](int y) {
    std::vector<float> rgb(3 * static_cast<std::size_t>(box.width));
    readLinearRow(view, linear, box.x, y, box.width, rgb.data());
    lumaRow(rgb.data(), box.width, map.at(box.x, y));
  });
  return map;
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

void fillLight(const MetricInput& input, const Rect& box, std::span<const RegionRuns> regions,
               std::span<Figures> figures) {
  const auto forRegions = [&](const auto& body) {
    base::parallelFor(regions.size(), 1, [&](std::size_t i, std::size_t) {
      if (regions[i].pixels > 0) body(regions[i], figures[i]);
    });
  };
  forRegions([&](const RegionRuns& region, Figures& own) {
    own.pixels = region.pixels;
    own.nonFinite = countWithin(region, input.nonFinite);
  });
  const auto fill = [&](double Figures::*figure, base::Image map) {
    setPixels(map, input.nonFinite, 0);
    forRegions([&](const RegionRuns& region, Figures& own) { own.*figure = meanOf(map, region); });
  };
  fill(&Figures::clippedBlack, clippedMap(input, box, [](float v) { return v <= 0; }));
  fill(&Figures::clippedWhite, clippedMap(input, box, [](float v) { return v >= 1; }));
  fill(&Figures::referenceLuma, lumaMap(input.reference, box));
  fill(&Figures::testLuma, lumaMap(input.test, box));
  fill(&Figures::referenceLuminance, lightMap(input.reference, input.referenceLinear, box));
  fill(&Figures::testLuminance, lightMap(input.test, input.testLinear, box));
  for (Figures& own : figures)
    for (double* share : {&own.clippedBlack, &own.clippedWhite}) *share = std::min(*share, 1.); // rounding
}

} // namespace parity::compare

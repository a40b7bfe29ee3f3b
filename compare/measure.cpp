#include "compare/measure.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/metric_parts.h"
#include "compare/pooling.h"

namespace parity::compare {
namespace {

// A metric and what is wanted of it.
struct Plan {
  const Metric* metric;
  std::vector<Statistic> statistics;
  bool keepMap = false;
};

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<Plan> makePlans(const MeasureRequest& request) {
  for (const std::string& name : request.metrics) requireMetric(name, "metrics");
  for (const std::string& name : request.keepMaps) requireMetric(name, "maps");
  std::vector<Statistic> extra;
  for (const std::string& name : request.statistics) extra.push_back(requireStatistic(name, "figures"));

  std::vector<Plan> plans;
  for (const Metric& metric : metricRegistry()) {
    Plan plan{&metric, {}, holds(request.keepMaps, metric.name)};
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
    if (!plan.statistics.empty() || plan.keepMap) plans.push_back(std::move(plan));
  }
  return plans;
}

// A list with all that is pooled over it: all pixels, then the interior.
struct Region {
  RegionRuns parts[2];
};

std::vector<Region> makeRegions(const std::vector<base::PixelList>& lists, const MetricInput& input, const Rect& box,
                                int radius) {
  std::vector<Region> regions(lists.size());
  const auto width = static_cast<std::uint32_t>(input.width());
  base::parallelFor(lists.size(), 1, [&](std::size_t i, std::size_t) {
    Region& region = regions[i];
    region.parts[0] = runsOf(lists[i], input.width(), input.height());
    for (const Run& run : region.parts[0].runs) {
      const int x = static_cast<int>(run.first % width), y = static_cast<int>(run.first / width);
      if (x < box.x || x + static_cast<int>(run.count) > box.x + box.width || y < box.y || y >= box.y + box.height)
        throw base::Error(base::ExitCode::failed, "region '" + lists[i].name + "'",
                          "x " + std::to_string(x) + ", y " + std::to_string(y), "lies outside what is measured");
    }
    region.parts[1] = erodeRuns(region.parts[0], input.width(), input.height(), radius);
  });
  return regions;
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

Figures& figuresOf(RegionFigures& figures, int part) { return part == 0 ? figures.all : figures.interior; }

// Calls body(region, figures) for all parts of all regions that have pixels.
void forParts(const std::vector<Region>& regions, std::vector<RegionFigures>& figures,
              const std::function<void(const RegionRuns&, Figures&)>& body) {
  base::parallelFor(2 * regions.size(), 1, [&](std::size_t i, std::size_t) {
    const RegionRuns& part = regions[i / 2].parts[i % 2];
    if (part.pixels > 0) body(part, figuresOf(figures[i / 2], static_cast<int>(i % 2)));
  });
}

} // namespace

const base::Image* Measurement::findMap(std::string_view metric, std::size_t plane) const {
  for (const auto& [name, planes] : maps)
    if (name == metric && plane < planes.size()) return &planes[plane];
  return nullptr;
}

std::vector<std::string> defaultMetrics() { return {"flip", "rmse", "psnr", "bias"}; }

Measurement measureRegions(const ImagePair& pair, const std::vector<base::PixelList>& lists,
                           const MeasureRequest& request) {
  const std::vector<Plan> plans = makePlans(request);
  const MetricInput input(pair);
  const Rect box = boxOf(input, request.options);
  for (const Plan& plan : plans)
    if (plan.metric->needsLinear && !input.referenceLinear)
      throw base::Error(base::ExitCode::notComparable, plan.metric->name, "",
                        "needs linear (HDR) images; these are displayed ones");
  const int radius = request.interiorRadius.value_or(flipFilterRadius({.ppd = request.options.ppd}));
  const std::vector<Region> regions = makeRegions(lists, input, box, radius);

  Measurement out;
  for (const base::PixelList& list : lists) out.regions.push_back({list.name, {}, {}});
  {
    base::Image reference = lumaMap(input.reference, box), test = lumaMap(input.test, box);
    for (base::Image* luma : {&reference, &test}) setPixels(*luma, input.nonFinite, 0);
    forParts(regions, out.regions, [&](const RegionRuns& region, Figures& figures) {
      figures.pixels = region.pixels;
      figures.nonFinite = countWithin(region, input.nonFinite);
      figures.referenceLuma = meanOf(reference, region);
      figures.testLuma = meanOf(test, region);
    });
  }
  MetricMaps maps;
  std::string mapsName;
  for (const Plan& plan : plans) {
    if (mapsName.empty() || mapsName != plan.metric->mapsName) {
      maps = {}; // before the next ones are made
      maps = plan.metric->makeMaps(input, request.options);
    }
    mapsName = plan.metric->mapsName;
    if (!plan.statistics.empty())
      forParts(regions, out.regions, [&](const RegionRuns& region, Figures& figures) {
        const std::vector<double> values = plan.metric->pool(maps, region, plan.statistics);
        for (std::size_t i = 0; i < values.size(); ++i) figures.values.push_back({plan.statistics[i].name, values[i]});
      });
    if (!maps.note.empty()) out.notes.push_back(plan.metric->name + ": " + maps.note);
    if (plan.keepMap) out.maps.emplace_back(plan.metric->name, maps.planes);
  }
  return out;
}

} // namespace parity::compare

#include "compare/metrics/measure.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/metrics/measure_plan.h"
#include "compare/metrics/metric_parts.h"

namespace parity::compare {
namespace {

std::vector<RegionRuns> makeRegions(const std::vector<base::PixelList>& lists, const MetricInput& input,
                                    const Rect& box) {
  std::vector<RegionRuns> regions(lists.size());
  const auto width = static_cast<std::uint32_t>(input.width());
  base::parallelFor(lists.size(), 1, [&](std::size_t i, std::size_t) {
    regions[i] = runsOf(lists[i], input.width(), input.height());
    for (const Run& run : regions[i].runs) {
      const int x = static_cast<int>(run.first % width), y = static_cast<int>(run.first / width);
      if (x < box.x || x + static_cast<int>(run.count) > box.x + box.width || y < box.y || y >= box.y + box.height)
        throw base::Error(base::ExitCode::failed, "region '" + lists[i].name + "'",
                          "x " + std::to_string(x) + ", y " + std::to_string(y), "is outside the measured area");
    }
  });
  return regions;
}

// Calls body(region, figures) for all regions that have pixels.
void forRegions(const std::vector<RegionRuns>& regions, std::vector<Figures>& figures,
                const std::function<void(const RegionRuns&, Figures&)>& body) {
  base::parallelFor(regions.size(), 1, [&](std::size_t i, std::size_t) {
    if (regions[i].pixels > 0) body(regions[i], figures[i]);
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
  const MetricInput input(pair);
  const std::vector<MeasurePlan> plans = makeMeasurePlans(request, input.referenceLinear != nullptr);
  const Rect box = boxOf(input, request.options);
  const std::vector<RegionRuns> regions = makeRegions(lists, input, box);

  Measurement out;
  out.regions.resize(lists.size());
  fillLight(input, box, regions, out.regions);
  MetricMaps maps;
  std::string mapsName;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const MeasurePlan& plan = plans[i];
    if (mapsName.empty() || mapsName != plan.metric->mapsName) {
      maps = {}; // before the next ones are made
      maps = plan.metric->makeMaps(input, request.options);
    }
    mapsName = plan.metric->mapsName;
    if (!plan.statistics.empty())
      forRegions(regions, out.regions, [&](const RegionRuns& region, Figures& figures) {
        const std::vector<double> values = plan.metric->pool(maps, region, plan.statistics);
        for (std::size_t k = 0; k < values.size(); ++k) figures.values.push_back({plan.statistics[k].name, values[k]});
      });
    if (!maps.note.empty()) out.notes.push_back(plan.metric->name + ": " + maps.note);
    if (!plan.keepMap) continue;
    const bool isLastUse = i + 1 == plans.size() || plans[i + 1].metric->mapsName != mapsName || mapsName.empty();
    if (isLastUse)
      out.maps.emplace_back(plan.metric->name, std::move(maps.planes)), mapsName.clear();
    else
      out.maps.emplace_back(plan.metric->name, maps.planes);
  }
  return out;
}

} // namespace parity::compare

#include "compare/metrics/measure.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/metrics/mean_rows.h"
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

void addValues(const MeasurePlan& plan, const std::vector<double>& values, Figures& figures) {
  for (std::size_t k = 0; k < values.size(); ++k) figures.values.push_back({plan.statistics[k].name, values[k]});
}

// The light and all metrics that are means and whose maps nobody wants, in one pass over the pictures.
class Means {
public:
  Means(const MetricInput& input, std::span<const RegionRuns> regions, std::span<const MeasurePlan> plans)
      : m_plans(plans), m_metrics(plans.size()), m_starts(plans.size()) {
    std::vector<const MeanRows*> rows{&lightRows()};
    for (std::size_t p = 0; p < plans.size(); ++p) {
      if (plans[p].keepMap) continue;
      m_metrics[p] = findMeanMetric(plans[p].metric->name);
      if (!m_metrics[p].rows) continue;
      if (std::ranges::find(rows, m_metrics[p].rows) == rows.end()) rows.push_back(m_metrics[p].rows);
      for (const MeanRows* each : rows) {
        if (each == m_metrics[p].rows) break;
        m_starts[p] += each->worst.size();
      }
    }
    m_means = meansOf(rows, input, regions);
  }

  const std::vector<std::vector<double>>& all() const { return m_means; }
  bool holds(std::size_t plan) const { return m_metrics[plan].rows != nullptr; }
  std::vector<double> pool(std::size_t plan, std::size_t region) const {
    const std::span<const double> means(m_means[region]);
    return m_metrics[plan].pool(means.subspan(m_starts[plan], m_metrics[plan].rows->worst.size()),
                                m_plans[plan].statistics);
  }

private:
  std::span<const MeasurePlan> m_plans;
  std::vector<MeanMetric> m_metrics;
  std::vector<std::size_t> m_starts; // of the metric's means among all
  std::vector<std::vector<double>> m_means;
};

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
  const Means means(input, regions, plans);
  fillLight(input, regions, means.all(), out.regions);
  MetricMaps maps;
  std::string mapsName;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const MeasurePlan& plan = plans[i];
    if (means.holds(i)) {
      forRegions(regions, out.regions, [&](const RegionRuns& region, Figures& figures) {
        const auto r = static_cast<std::size_t>(&region - regions.data());
        addValues(plan, means.pool(i, r), figures);
      });
      continue;
    }
    if (mapsName.empty() || mapsName != plan.metric->mapsName) {
      maps = {}; // before the next ones are made
      maps = plan.metric->makeMaps(input, request.options);
    }
    mapsName = plan.metric->mapsName;
    if (!plan.statistics.empty())
      forRegions(regions, out.regions, [&](const RegionRuns& region, Figures& figures) {
        addValues(plan, plan.metric->pool(maps, region, plan.statistics), figures);
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

// What a measurement needs before any region is pooled: which metrics with which figures, and the light of the images.
#pragma once

#include <span>
#include <vector>

#include "compare/metrics/mean_rows.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/metric.h"
#include "compare/pooling/figures.h"

namespace parity::compare {

// A metric and what is wanted of it.
struct MeasurePlan {
  const Metric* metric = nullptr;
  std::vector<Statistic> statistics;
  bool keepMap = false;
};

// In the registry's order. Throws Error as measureRegions does.
std::vector<MeasurePlan> makeMeasurePlans(const MeasureRequest& request, bool hasLinear);

// The maps whose means fillLight() needs.
const MeanRows& lightRows();
// Fills all of `figures`, one for each region, but the values. means: meansOf() of lightRows() first. Regions without
// pixels are left as they are.
void fillLight(const MetricInput& input, std::span<const RegionRuns> regions,
               std::span<const std::vector<double>> means, std::span<Figures> figures);

} // namespace parity::compare

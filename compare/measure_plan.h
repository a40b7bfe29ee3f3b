// What a measurement needs before any region is pooled: which metrics with which figures, and the light of the images.
#pragma once

#include <vector>

#include "compare/figures.h"
#include "compare/measure.h"
#include "compare/metric.h"

namespace parity::compare {

// A metric and what is wanted of it.
struct MeasurePlan {
  const Metric* metric = nullptr;
  std::vector<Statistic> statistics;
  bool keepMap = false;
};

// In the registry's order. Throws Error as measureRegions does.
std::vector<MeasurePlan> makeMeasurePlans(const MeasureRequest& request, bool hasLinear);

// One-channel images of what Figures says besides its values; 0 outside the box and at pixels that are not finite.
struct LightMaps {
  base::Image referenceLuma, testLuma;   // of the displayed images
  base::Image referenceLight, testLight; // luminance of linear light, as the images have it
  base::Image black, white;              // 1 where both displayed images are
};
LightMaps makeLightMaps(const MetricInput& input, const Rect& box);

// Fills all of `figures` but the values. region: of at least one pixel.
void fillLight(const LightMaps& maps, const MetricInput& input, const RegionRuns& region, Figures& figures);

} // namespace parity::compare

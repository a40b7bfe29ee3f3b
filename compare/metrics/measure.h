// Measuring: a pair of images and regions in, named figures per region out.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/frame.h"
#include "compare/metrics/metric.h"
#include "compare/pooling/figures.h"

namespace parity::compare {

struct MeasureRequest {
  std::vector<std::string> metrics = {};    // all figures of these (compare/metrics/metric.h)
  std::vector<std::string> statistics = {}; // and these, of any metric: what budgets name
  MetricOptions options = {};
  std::vector<std::string> keepMaps = {}; // metrics whose maps are wanted in Measurement::maps, measured or not
};

struct Measurement {
  std::vector<Figures> regions;                                       // as many as lists, in their order
  std::vector<std::pair<std::string, std::vector<base::Image>>> maps; // name of the metric, its planes (metric.h)
  std::vector<std::string> notes;                                     // of the metrics, "name: note"

  // A kept plane of that metric, or null: 1 channel, 0 outside the box. The first one is what the metric is pooled
  // from; the second of HDR-FLIP is its exposure map.
  const base::Image* findMap(std::string_view metric, std::size_t plane = 0) const;
};

// The metrics of a run that names none: cheap ones, of which the verdicts by default need the first.
std::vector<std::string> defaultMetrics();

// Every map is made once, then all regions are pooled, on all threads; the result does not depend on their number. An
// empty region (or one of weight 0) gives pixels = 0 and no values. Pixels that are not finite in any image are counted
// in nonFinite and enter every figure as the metric's worst value, luma 0, so that no figure is NaN and none looks
// better for them.
// Throws Error: usage for an unknown metric or statistic, and for options out of range; notComparable for images that
// do not fit each other (see MetricInput), and for a metric that needs linear images where there are none; failed for a
// malformed list and for a region that reaches beyond options.box.
Measurement measureRegions(const ImagePair& pair, const std::vector<base::PixelList>& lists,
                           const MeasureRequest& request);

} // namespace parity::compare

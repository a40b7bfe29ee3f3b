// Metrics: what each makes of a pair of images, and how a region's part of it becomes named figures. A new one is a
// file that makes a Metric, and a line in metric_registry.cpp.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image/image.h"
#include "compare/flip/flip_hdr.h"
#include "compare/metrics/metric_input.h"
#include "compare/pooling/pixel_view.h"
#include "compare/pooling/region_runs.h"
#include "compare/pooling/statistic.h"

namespace parity::compare {

struct MetricOptions {
  float ppd = kDefaultPixelsPerDegree; // pixels per degree of the visual field, of both FLIPs
  HdrFlipOptions hdr = {};             // of HDR-FLIP; its ppd and region are those here
  std::optional<Rect> box = {};        // only there the maps are needed; none: everywhere
};

// What is known of each pixel: one-channel images in an order that the metric's own pooling knows. Of the size of the
// images unless the metric says otherwise; 0 outside the box.
struct MetricMaps {
  std::vector<base::Image> planes;
  std::string note; // how it was measured, where that depends on the images: the exposures of HDR-FLIP
};

// A swapped picture's pixels (compare/metrics/measure_swaps.h): y*width+x, and their values gathered, the reference's
// too. Null for a picture without pixels.
struct SwapPixels {
  std::span<const std::uint32_t> pixels;
  const MetricInput* gathered = nullptr;
};

// Metric::reach of a metric whose values depend on the whole pictures.
inline constexpr int kReachesAll = -1;

struct Metric {
  std::string name;        // "flip": what --metrics takes
  std::string label;       // in a sentence: "FLIP", "PSNR"
  std::string description; // one line: definition, source, on which images
  bool needsLinear = false;
  std::vector<Statistic> statistics; // its figures, in the order of reports
  bool hasFractionOver = false;      // also fraction_over(X): the share of weight strictly above X

  // Metrics that name the same maps, and stand one after the other in the registry, share them. Empty: none.
  std::string mapsName;
  // The maps of a pair. At input.nonFinite they hold the metric's worst value.
  std::function<MetricMaps(const MetricInput& input, const MetricOptions& options)> makeMaps;
  int reach = 0; // how far, in pixels along each axis, a pixel of the input reaches in the maps
  // For metrics that measure many swapped pictures cheaper together than one by one: for each the values of its pixels,
  // in their order, as makeMaps' first plane has them there. reference: the picture that all swaps differ from. Null:
  // none.
  std::function<std::vector<std::vector<float>>(const MetricInput& reference, std::span<const SwapPixels> swaps,
                                                const MetricOptions& options)>
      makeSwapMaps;
  // One value for each wanted statistic of this metric, over a region of at least one pixel that lies within the box.
  std::function<std::vector<double>(const MetricMaps& maps, const RegionRuns& region,
                                    std::span<const Statistic> wanted)>
      pool;
};

// All metrics, in the order of reports.
const std::vector<Metric>& metricRegistry();

// Null for a name that is not known.
const Metric* findMetric(std::string_view name);

// Throws Error (usage) naming `subject` and the nearest known name.
const Metric& requireMetric(std::string_view name, const std::string& subject);

// "flip,ssim,deltae" as names, in the registry's order and each once; a figure ("flip.mean") names its metric. Throws
// as parseFigures() (compare/pooling/figure_list.h).
std::vector<std::string> parseMetricNames(std::string_view commaSeparated, const std::string& subject);

} // namespace parity::compare

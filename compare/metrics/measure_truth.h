// Measuring both paths against the ground truth, and the truth's own error, per region.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/frame.h"
#include "compare/metrics/measure_swaps.h"
#include "compare/metrics/metric_input.h"
#include "compare/metrics/truth.h"

namespace parity::compare {

// One path's picture, of the colour or of a term.
struct TruthPicture {
  PixelView displayed;                           // display-encoded sRGB, 3 channels
  const base::Image* linear = nullptr;           // linear Rec.709 light as exposed, 3 channels
  std::span<const std::uint32_t> nonFinite = {}; // pixels (y*width+x) that cannot be used, ascending
};

struct TruthInput {
  TruthPicture truth, reference, test;
};

// A material against the truth: the truth's picture in which it alone carries a path's colours.
struct TruthSwap {
  Swap reference, test; // of the same list
};

// The truth's own error, an image of one channel each.
struct TruthErrorMaps {
  const base::Image* error = nullptr;   // standard error of the worst channel over the brightest channel of the pixel
  const base::Image* samples = nullptr; // taken
};

struct TruthMeasureRequest {
  std::optional<Rect> box = {};                       // as MetricOptions::box
  bool keepMaps = false;                              // whether TruthMeasurement holds the FLIP maps
  double wantedError = 0;                             // relative standard error that was asked for
  std::string reference = "reference", test = "test"; // what notes call the paths
};

struct TruthMeasurement {
  Truth truth;                         // without terms and images
  base::Image referenceFlip, testFlip; // of each path against the truth; empty unless asked for
};

// The whole image (or any list of its pixels): both paths' pictures against the truth's. Figures "flip", "relmse" and
// "bias". The truth's noise as relMSE: mean over pixels and RGB of (e r)^2 / (r^2 + 0.01), e being the pixel's relative
// standard error: an estimate, as each channel is taken to be off by the same share; 0.01 as in
// compare/metrics/metric_relmse.cpp. The measured relMSE holds that noise: E[(t-r)^2] = (t-E[r])^2 + s^2. Notes: a path
// that isWithinNoise, pixels that did not reach the wanted error, and those whose error is not known. Throws Error as
// measureRegions does.
TruthMeasurement measureTruth(const TruthInput& input, const TruthErrorMaps& maps, const base::PixelList& list,
                              const TruthMeasureRequest& request);

// The same for materials by the material swap (compare/metrics/measure_swaps.h): as many as swaps, in their order. Of
// the request neither box nor keepMaps matters. Throws Error as measureSwaps does.
std::vector<Truth> measureTruthSwaps(const TruthPicture& truth, const TruthErrorMaps& maps,
                                     std::span<const TruthSwap> swaps, const TruthMeasureRequest& request);

// One term: its figures "flip.mean" and "relmse", and mean luminances 0. Throw Error as measureRegions and measureSwaps
// do.
TruthTerm measureTerm(const std::string& name, const TruthInput& input, const base::PixelList& list,
                      const std::optional<Rect>& box);
std::vector<TruthTerm> measureTermSwaps(const std::string& name, const TruthPicture& truth,
                                        std::span<const TruthSwap> swaps);

// Mean Rec.709 luminance of a linear image over a list that is not empty, by weight.
double meanLuminance(const base::Image& linear, const base::PixelList& list);

// Whether all of the list is 0 in the image; NaN is not.
bool isBlack(const base::Image& linear, const base::PixelList& list);

} // namespace parity::compare

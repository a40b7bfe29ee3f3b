// HDR-FLIP: the largest LDR-FLIP over a range of exposures (Andersson et al. 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images").
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image/image.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_simd.h"
#include "compare/flip/flip_swap.h"

namespace parity::compare {

enum class Tonemapper { aces, hable, reinhard };
inline constexpr std::array<std::string_view, 3> kTonemapperNames = {"aces", "hable", "reinhard"};

// More exposures than this are never taken: a range that would need them is sampled more coarsely, which is noted.
inline constexpr int kMaxExposures = 100;

// Exposures lie within +-127 EV: 2^EV is then a normal float, and black stays black.
inline constexpr float kMaxExposureEv = 127;

struct HdrFlipOptions {
  float ppd = kDefaultPixelsPerDegree; // pixels per degree, 1..1000
  Tonemapper tonemapper = Tonemapper::aces;
  std::optional<float> start = {},
                       stop = {};    // first and last exposure, EV; none: from the reference, see exposureRange()
  std::optional<int> exposures = {}; // how many, both ends included, 2..kMaxExposures; none: one a stop
  std::optional<Rect> region = {};   // as FlipOptions; automatic exposures are still those of the whole reference
};

struct ExposureRange {
  float start = 0, stop = 0; // EV
  int count = 2;             // ends included, at equal distances
  std::string note;          // not empty where the range is not the reference's own: why
};

struct HdrFlip {
  base::Image flip;     // the largest over all exposures, [0,1]
  base::Image exposure; // which exposure that was: i/(count-1); the first of equal ones
  ExposureRange range;
};

// The tone curve's argument that comes out as 0.85, the larger root: ACES 2.119, Hable 3.128, Reinhard 5.667.
double brightestExposed(Tonemapper tonemapper);

// How rows are decoded for it, at exposure 1.
RowDecoder makeRowDecoder(Tonemapper tonemapper);

// start brings the largest luminance (0.2126/0.7152/0.0722) to brightestExposed(), stop the median of the positive
// ones; count = ceil(stop - start), at least 2 (Andersson 2021, section 4.1, but that zeros have no part in the median:
// a reference over half black would have no end). A reference without a positive luminance gives the test's range,
// which is noted; where neither has one, -1..1 if they are equal. Options given override. Throws Error: notComparable
// where neither has one and they differ; failed for NaN or infinite values; usage for a start above the stop, exposures
// out of range or given values beyond +-kMaxExposureEv.
ExposureRange exposureRange(const PixelView& reference, const PixelView& test, const HdrFlipOptions& options);

// reference, test: linear scene-referred Rec.709, 3 channels, or 4 whose last is passed over, floats. Negative values
// go through the tone curve as they are, as in the reference tool. Throws as flipMap() and exposureRange(), and Error
// (notComparable) for bytes.
HdrFlip flipHdr(const PixelView& reference, const PixelView& test, const HdrFlipOptions& options = {});

// The same for swapped pictures (compare/flip/flip_swap.h): for each the largest FLIP over the exposures at its pixels.
// The exposures are those of the reference; of a black one each swap has its own. Throws as flipSwaps() and flipHdr().
std::vector<std::vector<float>> flipHdrSwaps(const PixelView& reference, std::span<const FlipSwap> swaps,
                                             const HdrFlipOptions& options = {});

} // namespace parity::compare

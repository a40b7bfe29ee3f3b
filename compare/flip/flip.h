// LDR-FLIP: how different two displayed images look, per pixel (Andersson et al. 2020, "FLIP: A Difference Evaluator
// for Alternating Images").
#pragma once

#include <cstdint>
#include <optional>

#include "base/image/image.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// A 0.7 m wide screen of 3840 pixels seen from 0.7 m.
inline constexpr float kDefaultPixelsPerDegree = 67.0206451f;
inline constexpr float kMinPixelsPerDegree = 1, kMaxPixelsPerDegree = 1000;

struct FlipOptions {
  float ppd = kDefaultPixelsPerDegree; // pixels per degree of the visual field, 1..1000
  std::optional<Rect> region = {};     // only its pixels are computed, all others are 0; none: the whole image
};

// distance * (resolutionX / width) * pi/180 (Andersson 2020, section 4.1.1). distance: from the eye to the screen,
// metres; resolutionX: pixels across the screen; width: of the screen, metres. Throws Error (usage) unless all are
// positive and finite.
float pixelsPerDegree(float distance, float resolutionX, float width);

// How far, in pixels along each axis, a pixel of the input reaches in the map: ceil(3 sqrt(0.04/(2 pi^2)) ppd), 10 at
// the default (the colour filter's radius; the feature filters reach less far). Throws Error (usage) for a ppd outside
// its range.
int flipFilterRadius(const FlipOptions& options);

// The map and the two differences it is made of: flip = color^(1 - feature). One channel, [0,1].
struct FlipMaps {
  base::Image flip, color, feature;
  std::uint64_t filteredPixels = 0; // the others lie further than the filters' radius from any pixel that differs
};

// reference, test: display-encoded sRGB, 3 channels, or 4 whose last is passed over; bytes, or floats in [0,1] (what
// lies outside is clamped). Returns one channel in [0,1], 0 where nothing can be seen to differ; exactly 0 wherever the
// images are equal as far as the filters reach. The result depends neither on the number of threads nor on the region.
// Throws Error: notComparable for empty images, different sizes, channels or types, or channels other than 3 or 4;
// failed for NaN or infinite values in the region or in its margin, with their count and the first position; usage for
// a ppd outside its range and for a region that is empty or leaves the image.
base::Image flipMap(const PixelView& reference, const PixelView& test, const FlipOptions& options = {});

// The same with both parts.
FlipMaps flipMaps(const PixelView& reference, const PixelView& test, const FlipOptions& options = {});

} // namespace parity::compare

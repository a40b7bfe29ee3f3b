// The shadow of one light as mobile reads it: a distance field in texture space (docs/shading.md 7f).
#pragma once

#include "bake/encode/sun_mask.h"
#include "base/image/image.h"
#include "shading/shading.h"

namespace parity::bake {

struct DistanceFieldOptions {
  double range = 4;    // texels: a distance of as much is the end of the 8-bit scale, in light as in shadow
  double penumbra = 1; // width of the transition from shadow to light, texels, > 0, at most 2 range
  int sweeps = 2;      // of the fit, at most; 0: distances as they are
};

// codes / 255 = d, read bilinearly; visibility = saturate(d T + .5 - .5 T)^2.
struct DistanceField {
  base::Image8 codes; // of the mask's texels
  double transitionScale = 1;
};

// d: 0..1. Unreal Engine 4's mobile base pass.
inline double decodeVisibility(double d, double transitionScale) {
  return shading::f64::distanceFieldShadow(d, transitionScale);
}

// T by which a transition is `penumbra` texels wide: d runs over penumbra / (2 range) while d T runs over 1.
inline double transitionScaleOf(const DistanceFieldOptions& options) { return 2 * options.range / options.penumbra; }

// d of a signed distance to the shadow's edge, in texels, positive in the light; not clamped. The square in the
// decoding darkens: over a transition of width w its integral is w/3, that of a step in its middle w/2. All is
// therefore moved into the shadow by w/6, which keeps the shadow's area.
inline double encodeDistance(double distance, const DistanceFieldOptions& options) {
  return 0.5 + (distance + options.penumbra / 6) / (2 * options.range);
}

// Each chart by itself (findCharts): signed exact distances at the middles of texels, the edge midway between a lit and
// a shadowed sub-texel; a chart that is wholly lit is 1, a wholly shadowed one 0. Bilinear reading of them cuts off
// what is thinner than two texels, so texels about edges are then fitted: by sweeps over 8-bit codes that lessen the
// squared error of what is read, at all sub-texels, against the mask blurred to the penumbra (bake/encode/mask_blur.h).
// Texels beside a chart go on with its distances; farther ones are lit. Throws base::Error (exit 4) for a mask whose
// sides do not fit and for options that make no sense. The same for any number of threads.
DistanceField makeDistanceField(const SunMask& mask, const DistanceFieldOptions& options);

// How well a field shows its mask, over all known sub-texels.
struct DistanceFieldError {
  // Mean absolute error of visibility against the mask blurred to the penumbra: where that is neither 0 nor 1, and
  // elsewhere.
  double inBand = 0, outside = 0;
  double inBandSharp = 0; // as inBand, against the mask itself: a straight ramp has .25
  double bandShare = 0;   // of sub-texels
  double shadowArea = 1;  // over the mask's own; 1 without any shadow in both
};
DistanceFieldError measureDistanceField(const SunMask& mask, const DistanceField& field,
                                        const DistanceFieldOptions& options);

} // namespace parity::bake

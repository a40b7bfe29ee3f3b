// The gathered light of a group of neighbouring texels, each until its error is what is wanted.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bake/atlas/texel_points.h"
#include "bake/light/gather.h"
#include "bake/light/texel_groups.h"

namespace parity::bake {

// Plain data: cached as it is.
struct Gathered {
  TexelLight light;
  float error = 0;           // achieved, over the texel's light: 19 of 20 texels are within it
  std::uint32_t samples = 0; // taken
};
using GatheredGroup = std::array<Gathered, TexelGroups::kMost>; // in the order of the texels

struct GroupTexel {
  TexelPoints points; // none: it stays as it was
  bool bothSides = false;
  double known = 0;       // luminance of irradiance that is added to what is gathered: errors are relative to the sum
  std::uint32_t seed = 0; // independent of that of other texels and of what has been gathered before
  Gathered before;        // light gathered before, weighted by its number of samples; 0: ignored
};

struct GroupOptions {
  double error = 0.01; // wanted
  int maxSamples = 0;  // of a texel, in the mean over the group: those that are done leave theirs to the others
  double floor = 0;    // luminance of irradiance; what is darker need not be more exact than that
};

// A few samples of all texels train a guide. Then more by the guide, until they are enough: independent replicates of
// the sequence, whose scatter is the error of their mean. As neighbours' relative errors are alike, that of a texel is
// judged by theirs, too. texels: 1 to TexelGroups::kMost. rays: counted up.
GatheredGroup gatherGroup(const Surroundings& around, std::span<const GroupTexel> texels, const GroupOptions& options,
                          std::uint64_t& rays);

// The half-width of the interval that 95 % of Student's distribution lie in, to 1 % from 3 degrees of freedom on: the
// normal distribution's, expanded (Cornish and Fisher; Abramowitz and Stegun 1964, 26.7.5).
constexpr double studentOf95Percent(double degreesOfFreedom) {
  const double x = 1 / degreesOfFreedom;
  return 1.960 + x * (2.372 + x * (2.823 + x * 2.556));
}

} // namespace parity::bake

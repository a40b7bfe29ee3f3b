// How far the forms are from what they were fitted to, in the figures of docs/shading.md 2 and docs/shading.md 3.
#pragma once

#include <string>
#include <vector>

#include "study/fit/lobe_fit.h"

namespace parity::fit {

// Of an environment BRDF: absolute error of the directional albedo, single and multiple scattering together, over
// points.
struct AlbedoError {
  std::string F0; // as one number, or three
  double rms, max;
};

// The rows F0 = .04 .5 1 and gold (1, .71, .29), of the full domain in 96 x 96 points.
std::vector<AlbedoError> albedoErrors(const Truth& truth, const LobeModel& model);

// One row, for any form that has just a total: F0 of one or three channels.
AlbedoError albedoError(const Truth& truth, const std::vector<Point>& points, const std::vector<double>& F0,
                        const LobeModel& model);

// Of direct light at F0 = 1: what is reflected of light from everywhere, over the truth. As refitLight's D, V and F are
// those of the high-end path, its error is that of `multiple` (and, with Turquin's factor, of what it multiplies).
struct DirectError {
  double rmsLogRatio, least, most; // over the core
  double exitanceMax;              // over the full domain
};
DirectError directError(const Truth& truth, const LobeModel& model);

} // namespace parity::fit

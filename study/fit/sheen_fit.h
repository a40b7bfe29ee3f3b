// Fits what shading/sheen.glsl takes for the directional albedo of the sheen: sheenAlbedoFit.
#pragma once

#include <array>

namespace parity::fit {

// The terms, with r = max(sheenRoughness, 0.07), u = 1 / r, N = NoV, s = sqrt(N):
//   E = min(exp2(c . (1, u, r, r^2, s u^2, s u, s r, N u, N u^2, N^2 u^2)), 1)
using SheenConstants = std::array<double, 10>;

// sheenAlbedoFit with these constants, in double. Both arguments in [0, 1]; the result, too.
double evaluateSheen(const SheenConstants& c, double sheenRoughness, double NoV);

struct SheenFit {
  SheenConstants constants; // rounded to four decimals
  double rms, max;          // absolute errors over NoV .02 to 1 and roughness .07 to 1, at 241 x 241 points
};

// What is least is the mean square error plus a quarter of the square of the 8th-power mean, which holds the greatest
// error down; the truth is reference::SheenAlbedo, clamped to 1 as it is used. No setting changes it. About .3 s.
SheenFit fitSheen();

} // namespace parity::fit

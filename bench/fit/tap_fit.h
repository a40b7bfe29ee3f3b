// Fits the one read of the environment of shading/refit.glsl: how far it leans to the normal, and its mip.
//
// The error of a read is that of fit_lobe_taps: the true lobe against the mip's around the direction read, in spherical
// harmonics, weighted by the power of natural light in each band. Mips are blended as the sampler does, trilinearly in
// layer 0.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fit/harmonics.h"
#include "fit/truth.h"

namespace parity::fit {

// The constants of refitTap, in their order there.
struct TapConstants {
  std::array<double, 3> lean;
  std::array<double, 2> mip;
};

// Where to read: mix(N, R, blend), at a mip (cut off to [0, 5]).
struct Tap {
  double blend, mip;
};
using TapModel = std::function<Tap(double roughness, double NoV)>;

// refitTap with these constants, in double: R + lean N is along mix(N, R, 1 / (1 + lean)).
Tap evaluateTap(const TapConstants& c, double roughness, double NoV);

class TapFit {
public:
  // Over roughness 0.1, 0.15 ... 1 and NoV from 0.04 to 0.99, weighted with NoV + 0.1, as a sphere shows them. About 3
  // s of one core; the result does not depend on how many there are.
  explicit TapFit(GeometryTerm term, const LobeSteps& steps = {90, 60});

  // Root mean square error of the light read, over that of the light itself about its mean.
  double errorOf(const TapModel& model) const;
  // The constants at the minimum, rounded to six digits.
  TapConstants fit() const;

private:
  using Mips = std::array<double, 6>;
  struct Point {
    double roughness, NoV, weight;
    double power;               // of the true lobe with itself
    std::vector<Mips> products; // with each mip's lobe, by angle
  };
  double squaredError(const Point& p, const Tap& tap) const;

  std::vector<Point> m_points;
  std::array<Mips, 6> m_between; // of the mips' lobes with each other
};

} // namespace parity::fit

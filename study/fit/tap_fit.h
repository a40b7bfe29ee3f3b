// Fits what shading/refit.glsl takes for the lobe's mean of the environment: one read, how far it leans to the normal
// and at which mip, and how much of the irradiance is mixed with it.
//
// What is compared is what a display shows of a lamp in front of a uniform background, wherever the lamp is and whether
// it is dim or bright: by the true lobe, and by the mips' lobes, blended as the sampler does, trilinearly in layer 0,
// with the cosine around the normal. A bright lamp is cut off in its middle and shows the lobe's tails, a dim one its
// peak; squared radiance would count the peak alone. No map is fitted.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "study/fit/harmonics.h"
#include "study/fit/truth.h"

namespace parity::fit {

// The constants of refitTap, in their order there.
struct TapConstants {
  std::array<double, 2> lean;
  std::array<double, 3> mip, wide;
};

// Where to read: mix(N, R, blend), at a mip (cut off to [0, 5]); and the irradiance's share, in [0, 1].
struct Tap {
  double blend, mip, wide = 0;
};
using TapModel = std::function<Tap(double roughness, double NoV)>;

// refitTap with these constants, in double: R + lean N is along mix(N, R, 1 / (1 + lean)).
Tap evaluateTap(const TapConstants& c, double roughness, double NoV);

class TapFit {
public:
  // Over roughness 0.1, 0.2 ... 1 and NoV from 0.06 to 0.97, weighted with NoV + 0.1, as a sphere shows them. About 1 s
  // of one core; the result does not depend on how many there are.
  explicit TapFit(GeometryTerm term, const LobeSteps& steps = {90, 60});

  // The absolute error of what is displayed (sRGB), summed over places and powers of the lamp, over the sum of what the
  // lamp adds to the picture by the true lobe.
  double errorOf(const TapModel& model) const;
  // The constants at the minimum, rounded to six digits.
  TapConstants fit() const;

private:
  static constexpr int kAngles = 2048; // at which the mips' lobes are tabulated, from 0 to pi, linear between
  static constexpr int kPowers = 3;    // of lamps
  struct Direction {
    double x, z;   // in the plane of incidence; the normal is z
    double weight; // solid angle
    double cosine; // lobe of the irradiance over pi
    std::array<double, kPowers> shown;
  };
  struct Point {
    double roughness, NoV, weight;
    std::vector<Direction> directions; // where the lamp may be
  };
  double errorAt(const Point& p, const Tap& tap) const;

  std::vector<Point> m_points;
  std::array<std::vector<double>, 6> m_mips;
  double m_shown = 0; // what all lamps add to the picture, by the true lobe
};

} // namespace parity::fit

// Fits the specular lobe of shading/refit.glsl: B, what is lost between microfacets, and how F0 returns of that.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fit/truth.h"

namespace parity::fit {

// The constants of refitB, refitLoss and refitLobe, in their order there.
struct LobeConstants {
  std::array<double, 7> B;
  std::array<double, 3> loss;
  double k; // 0 without compensation
};

// The directional albedo of the forms at one place.
struct LobeAlbedo {
  double single, multiple;
  double total() const { return single + multiple; }
};

// refitLobe with these constants, in double, at F90 = 1; without compensation `multiple` is 0. Roughness in [1/64, 1],
// NoV and F0 in [0, 1].
LobeAlbedo evaluateLobe(const LobeConstants& c, Compensation compensation, double F0, double roughness, double NoV);

using LobeModel = std::function<LobeAlbedo(double F0, double roughness, double NoV)>;

// What is made least: the mean over `points` of the sum over F0 = .02 .04 .08 .2 .4 .6 .8 1 of
//   (error of the total)^2 (1 + e) / (total + e), e = 0.1,  and, from F0 = .2 on, half the squared error of `multiple`
// so that what is dim counts for more than its share, and both lobes are right on their own.
double lobeObjective(const Truth& truth, const std::vector<Point>& points, const LobeModel& model);

// The points that the fit uses: 32 x 32 over the full domain.
std::vector<Point> lobePointsOf(const Truth& truth);

// The constants at the minimum that the default's constants lead to, rounded to six digits. About 2 s.
LobeConstants fitLobe(const Truth& truth);

} // namespace parity::fit

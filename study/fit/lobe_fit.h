// Fits the specular lobe of shading/refit.glsl: B, what is lost between microfacets, and how F0 returns of that.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "study/fit/truth.h"

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

// The F0 that count, and what is to come out for them at one place.
inline constexpr std::array kFittedF0 = {0.02, 0.04, 0.08, 0.2, 0.4, 0.6, 0.8, 1.0};
struct LobeTarget {
  double roughness, NoV;
  std::array<double, kFittedF0.size()> total, multiple;
};

// At 32 x 32 points over the full domain.
std::vector<LobeTarget> lobeTargetsOf(const Truth& truth);

// What is made least: the mean over the targets of the sum over kFittedF0 of
//   (error of the total)^2 (1 + e) / (total + e), e = 0.1,  and, from F0 = .2 on, half the squared error of `multiple`
// so that what is dim counts for more than its share, and both lobes are right on their own.
double lobeObjective(const std::vector<LobeTarget>& targets, const LobeModel& model);

// The constants at the minimum that the default's constants lead to, rounded to six digits. About 1 s.
LobeConstants fitLobe(const Truth& truth);

} // namespace parity::fit

// The fit of the environment's one read.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "shading/shading.h"
#include "study/fit/tap_fit.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
using namespace fit;

// The addition theorem: sum over m of the products of two directions' harmonics is (2 l + 1) / (4 pi) P_l.
TEST(Harmonics, MeetTheAdditionTheorem) {
  const Harmonics a = harmonicsAt(0.3), b = harmonicsAt(-0.8);
  const double cosine = -0.3 * 0.8 + std::sqrt(1 - 0.09) * std::sqrt(1 - 0.64);
  for (const int l : {1, 2, 7, kBands}) {
    double sum = 0;
    for (int m = 0; m <= l; ++m) sum += a[indexOf(l, m)] * b[indexOf(l, m)];
    EXPECT_NEAR(sum, (2 * l + 1) / (4 * std::numbers::pi) * std::legendre(l, cosine), 1e-10) << l;
  }
}

// Seen along the normal and smooth, the lobe is what N = V = R takes it for.
TEST(Harmonics, OfASmoothLobeAlongTheNormalAreThoseOfItsMip) {
  const Harmonics lobe = projectLobe(GeometryTerm::heightCorrelated, 0.2, 1);
  const Zonal mip = dampingOf(0.2);
  const Harmonics up = harmonicsAt(1);
  for (int l = 0; l <= kBands; ++l) EXPECT_NEAR(lobe[indexOf(l, 0)], mip[l] * up[indexOf(l, 0)], 0.02);
}

TEST(TapFit, ShaderHoldsTheConstantsOfTheFitAndLeansBetterThanTheDominantDirection) {
  const TapFit taps(GeometryTerm::heightCorrelated);
  const TapConstants c = taps.fit();
  const double best = taps.errorOf([&](double R, double N) { return evaluateTap(c, R, N); });
  const double held = taps.errorOf([](double R, double N) {
    const f64::RefitTap tap = f64::refitTap(R, N);
    return Tap{1 / (1 + tap.lean), tap.mip, tap.wide};
  });
  EXPECT_NEAR(held / best, 1, 1e-3);
  const double without = taps.errorOf([&](double R, double N) {
    const Tap tap = evaluateTap(c, R, N);
    return Tap{tap.blend, tap.mip};
  });
  EXPECT_GT(without, 1.2 * best) << "the irradiance's share is worth something";
  const double mirror = taps.errorOf([](double R, double) { return Tap{1, f64::mipFromRoughness(R)}; });
  const double dominant = taps.errorOf([](double R, double) {
    return Tap{f64::dominantBlend(R * R), f64::mipFromRoughness(R)};
  });
  std::printf("mirror %.3f, dominant %.3f, refit %.3f\n", mirror, dominant, held);
  EXPECT_LT(dominant, 0.6 * mirror);
  EXPECT_LT(held, 0.6 * dominant);
}

TEST(TapFit, DoesNotDependOnTheNumberOfThreads) {
  const auto error = [] {
    return TapFit(GeometryTerm::schlickSmith, {12, 8}).errorOf([](double R, double N) {
      return Tap{1 - 0.5 * R * N, 5 * R};
    });
  };
  const double all = error();
  const base::ThreadLimit one(1);
  EXPECT_EQ(error(), all);
}

} // namespace
} // namespace parity::tests

// The preset refit over its whole domain in every precision, half with flushed denormals included: nothing is NaN,
// infinite or negative.
#include <cmath>

#include <gtest/gtest.h>

#include "shading/flushed_half.h"
#include "shading/shading.h"

namespace parity::shading {
// refit.glsl alone, once more.
#define FN inline
#define CONSTANT inline constexpr
#define PRECISE
#define R(x) real(x)
#define R32(x) real32(x)
namespace flushed {
using real = tests::FlushedHalf;
using real32 = float;
using real3 = Vec3<real>;
using real32x3 = Vec3<real32>;
inline constexpr real kSmallest(0x1p-14), kLargest(65504.0);
FN real32 dot32(real32x3 a, real32x3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
#define PARITY_SHADING_REAL
#include "shading/refit.glsl"
#undef PARITY_SHADING_REAL
} // namespace flushed
#undef FN
#undef CONSTANT
#undef PRECISE
#undef R
#undef R32
} // namespace parity::shading

namespace parity::tests {
namespace {

// From 0 to 1, dense towards both ends.
std::vector<double> places() {
  std::vector<double> all = {0, 1e-7, 1e-5, 1e-4, 1e-3, 0.004, 1.0 / 64, 0.03, 1.0 / 16, 0.09, 0.13};
  for (int i = 2; i < 10; ++i) all.push_back(0.1 * i);
  for (const double below : {0.07, 0.02, 4e-3, 1e-3, 1e-4, 1e-6, 0.0}) all.push_back(1 - below);
  return all;
}

// The functions of one precision, with the row's numbers brought to it.
#define PARITY_SWEEP(space, Real, Real32)                                                                              \
  [](double R, double N, double F0, double F90, double L, double H, double VoH) {                                      \
    namespace at = shading::space;                                                                                     \
    const Real f(F0);                                                                                                  \
    const at::RefitLobe lobe = at::refitLobe({f, f, f}, Real(F90), Real(R), Real(N));                                  \
    const at::RefitTap tap = at::refitTap(Real(R), Real(N));                                                           \
    const auto light = at::refitLight(lobe, Real(L), {static_cast<Real32>(H), static_cast<Real32>(VoH)});              \
    return std::array<double, 7>{double(lobe.single.x),                                                                \
                                 double(lobe.multiple.x),                                                              \
                                 double(light.x),                                                                      \
                                 double(at::refitDiffuseShare(lobe.single.x, lobe.multiple.x)),                        \
                                 std::fabs(double(tap.lean)),                                                          \
                                 std::fabs(double(tap.mip)),                                                           \
                                 double(tap.wide)};                                                                    \
  }

template <typename Sweep> void expectSound(const char* precision, Sweep sweep) {
  const std::vector<double> all = places();
  std::size_t count = 0;
  for (const double R : all)
    for (const double N : all)
      for (const auto& [F0, F90] : {std::pair{0.0, 0.0}, {0.0, 1.0}, {0.02, 0.5}, {0.04, 1.0}, {0.5, 1.0}, {1.0, 1.0}})
        for (const double L : all)
          for (const double H : {0.0, 0.99, 1.0})
            for (const double VoH : {0.0, 1.0}) {
              for (const double value : sweep(R, N, F0, F90, L, H, VoH))
                ASSERT_TRUE(value >= 0 && std::isfinite(value))
                    << precision << ": R " << R << ", N " << N << ", F0 " << F0 << ", NoL " << L << ", NoH " << H
                    << ", VoH " << VoH;
              ++count;
            }
  EXPECT_GT(count, 500000u);
}

TEST(Refit, IsSoundOverItsWholeDomainInEveryPrecision) {
  expectSound("f64", PARITY_SWEEP(f64, double, double));
  expectSound("f32", PARITY_SWEEP(f32, float, float));
  expectSound("f16", PARITY_SWEEP(f16, shading::Half, float));
  expectSound("f16, flushed", PARITY_SWEEP(flushed, FlushedHalf, float));
}

// What half costs, as a result: against f64 at the same halves, of what is above 1/1024 and not cut off.
TEST(Refit, LosesLittleInHalf) {
  double lobes = 0, lights = 0;
  for (int i = 6; i <= 64; ++i)
    for (int k = 1; k <= 32; ++k)
      for (int m = 1; m <= 16; ++m)
        for (int h = 0; h <= 12; ++h) {
          const shading::Half R(i / 64.0), N(k / 32.0), L(m / 16.0), F(0.5);
          const float NoH = std::max(0.0f, 1 - 0.25f * float(h) * float(R) * float(R) * float(R) * float(R));
          const auto lobe = shading::f64::refitLobe({0.5, 0.5, 0.5}, 1, float(R), float(N));
          const auto half = shading::f16::refitLobe({F, F, F}, shading::Half(1), R, N);
          const double exact = lobe.single.x + lobe.multiple.x;
          lobes = std::max(lobes, std::fabs((float(half.single.x) + float(half.multiple.x)) / exact - 1));
          const double light = shading::f64::refitLight(lobe, float(L), {NoH, 0.7}).x;
          if (light > 0x1p-10 && light < 29000) // at F0 = .5
            lights = std::max(lights, std::fabs(float(shading::f16::refitLight(half, L, {NoH, 0.7f}).x) / light - 1));
        }
  std::printf("half against f64, relative: albedo %.4f, direct light from roughness 6/64 on %.4f\n", lobes, lights);
  EXPECT_LE(lobes, 0.004);
  EXPECT_LE(lights, 0.02);
}

} // namespace
} // namespace parity::tests

// Baked light's encodings: round trips, exactness at the baked normal, directional reconstruction against quadrature.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/direction.h"
#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;
namespace f16 = shading::f16;

using std::numbers::pi;

Direction leaning(double angle) { return {std::sin(angle), 0, std::cos(angle)}; } // from +Z towards +X
f64::real32x3 vec(const Direction& d) { return {d.x, d.y, d.z}; }

// What is baked of light from the whole sphere, and its irradiance at any normal, by quadrature.
struct Baked {
  double l0 = 0;
  Direction l1{0, 0, 0};
  std::function<double(const Direction&)> irradianceOverPi;
};

void addTo(Baked& baked, const Direction& w, double radianceTimesSolidAngle) {
  baked.l0 += radianceTimesSolidAngle * std::sqrt(1 / (4 * pi));
  const double y1 = radianceTimesSolidAngle * std::sqrt(3 / (4 * pi));
  baked.l1 = {baked.l1.x + y1 * w.x, baked.l1.y + y1 * w.y, baked.l1.z + y1 * w.z};
}

Baked makeDelta(const Direction& w) {
  Baked baked;
  addTo(baked, w, 2);
  baked.irradianceOverPi = [=](const Direction& n) { return 2 * std::max(0.0, dot(w, n)) / pi; };
  return baked;
}

// Radiance 1 in the cap of directions that lean from +Z by less than this.
Baked makeCap(double angle) {
  const double least = std::cos(angle);
  const auto integrate = [least](const std::function<void(const Direction&, double)>& add) {
    const GaussRule rule(96);
    constexpr int kAround = 384;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double z = least + (1 - least) * (rule.nodes[i] + 1) / 2, s = std::sqrt(1 - z * z);
      for (int k = 0; k < kAround; ++k) {
        const double phi = 2 * pi * (k + 0.5) / kAround;
        add({s * std::cos(phi), s * std::sin(phi), z}, rule.weights[i] * (1 - least) / 2 * 2 * pi / kAround);
      }
    }
  };
  Baked baked;
  integrate([&](const Direction& w, double solidAngle) { addTo(baked, w, solidAngle); });
  baked.irradianceOverPi = [=](const Direction& n) {
    double sum = 0;
    integrate([&](const Direction& w, double solidAngle) { sum += std::max(0.0, dot(w, n)) * solidAngle; });
    return sum / pi;
  };
  return baked;
}

constexpr f64::LightmapScales kPlain{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, 1, {0, 0, 0}, 0};

// The texel of such light whose colour is C over the flat normal's scale, in double and not quantised; read at n.
f64::real4 readLq(const f64::real32x3& irradianceOverPi, const Baked& baked, const Direction& N0, const Direction& n) {
  const f64::LightmapSh SH = f64::encodeLightmapSh(baked.l0, vec(baked.l1));
  const double scale = f64::flatNormalScale(SH, vec(N0));
  const f64::real32x3 LogRGB =
      f64::encodeLightmapLogRgb({irradianceOverPi.x * scale, irradianceOverPi.y * scale, irradianceOverPi.z * scale});
  return f64::GetLightMapColorLQ(LogRGB, {SH.x, SH.y, SH.z, SH.w}, kPlain, vec(n));
}

double stored(double value) { return std::floor(std::clamp(value, 0.0, 1.0) * 255 + 0.5) / 255; }

// docs/shading.md 7a: a step of LogL is 4.5 % of L + 2^-8, so that half a step is 2.3 %.
TEST(Lightmap, EightBitsKeepGreysWithinHalfAStepOver16Stops) {
  double worst = 0, worstHalf = 0;
  for (double stop = -8; stop <= 8; stop += 1.0 / 64) {
    const double L = std::min(std::exp2(stop), 255.99); // LogL is 1 there
    const f64::real32x3 LogRGB = f64::encodeLightmapLogRgb({L, L, L});
    ASSERT_LE(LogRGB.x, 1 + 1e-6);
    const double texel = stored(LogRGB.x);
    const f64::real4 read = f64::GetLightMapColorLQ({texel, texel, texel}, {0, 0, 0, 1}, kPlain, {0, 0, 1});
    const auto half = shading::Half(texel), zero = shading::Half(0.0);
    const f16::LightmapScales plain{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, 1, {0, 0, 0}, 0};
    const f16::real4 inHalf =
        f16::GetLightMapColorLQ({half, half, half}, {zero, zero, zero, shading::Half(1.0)}, plain, {0, 0, 1});
    EXPECT_NEAR(read.x, L, 0.023 * (L + 1.0 / 256)) << stop;
    EXPECT_NEAR(read.w, read.x, 1e-12 * read.x) << "luma of a grey";
    worst = std::max(worst, std::abs(read.x - L) / (L + 1.0 / 256));
    worstHalf = std::max(worstHalf, std::abs(float(inHalf.x) - read.x) / (read.x + 1.0 / 256));
  }
  std::printf("  LQ lightmap, 8 bits: %.2f %% of L + 2^-8; half instead of double: %.2f %% more\n", 100 * worst,
              100 * worstHalf);
  EXPECT_GT(worst, 0.02) << "or nothing was quantised";
  EXPECT_LT(worstHalf, 0.012) << "16 ln 2 times the luminance's roundings (3 * 2^-12) and the exponent's (2^-8)";
}

TEST(Lightmap, BlackStaysBlackAndNothingIsNegative) {
  const f64::real32x3 black = f64::encodeLightmapLogRgb({0, 0, 0});
  EXPECT_EQ(black.x + black.y + black.z, 0);
  const f64::real32x3 negative = f64::encodeLightmapLogRgb({-1, 0, 0.5});
  EXPECT_EQ(negative.x, 0);
  EXPECT_GT(negative.z, 0);
  for (const double add : {0.0, -0.01, -1e-7, 1e-7}) { // an add that rounding has brought below 0
    f64::LightmapScales scales = kPlain;
    scales.Add0 = {add, add, add};
    const f64::real4 read = f64::GetLightMapColorLQ({0, 0, 0}, {0, 0, 0, 1}, scales, {0, 0, 1});
    EXPECT_GE(read.x, 0) << add;
    EXPECT_GE(read.w, 0) << add;
    EXPECT_LE(read.x, 1e-6) << add;
    f16::LightmapScales inHalf{{1, 1, 1}, {float(add), float(add), float(add)}, {1, 1, 1}, 1, {0, 0, 0}, 0};
    const shading::Half zero(0.0);
    const f16::real4 dark =
        f16::GetLightMapColorLQ({zero, zero, zero}, {zero, zero, zero, shading::Half(1.0)}, inHalf, {0, 0, 1});
    EXPECT_EQ(float(dark.x), 0) << add;
  }
}

TEST(Lightmap, TheMobileTexelIsExactAtTheBakedNormal) {
  const Direction N0 = leaning(0.3);
  const f64::real32x3 E{0.7, 1.9, 0.02};
  for (const Baked& baked : {makeDelta(leaning(1.1)), makeDelta(leaning(-0.4)), makeCap(pi / 2), makeCap(0.4)}) {
    const f64::real4 read = readLq(E, baked, N0, N0);
    EXPECT_NEAR(read.x, E.x, 1e-9);
    EXPECT_NEAR(read.y, E.y, 1e-9);
    EXPECT_NEAR(read.z, E.z, 1e-9);
    EXPECT_NEAR(read.w, 0.3 * E.x + 0.59 * E.y + 0.11 * E.z, 1e-9);
  }
}

// dot(SH, (N.yzx, 1)) is S(N) / l0: the order in which the components are stored and read.
TEST(Lightmap, TheMobileTexelIsLinearShElsewhere) {
  const Baked baked = makeCap(pi / 2); // its irradiance is of order 1: (1 + cos) / 2
  for (const double angle : {0.0, 0.5, 1.5, 2.5}) {
    const f64::real4 read = readLq({1, 1, 1}, baked, {0, 0, 1}, leaning(angle));
    EXPECT_NEAR(read.x, (1 + std::cos(angle)) / 2, 1e-9) << angle;
  }
  // Light along each axis in turn: only the normal on that axis sees it in full.
  const std::array<Direction, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const f64::real4 read = readLq({1, 1, 1}, makeDelta(axes[a]), axes[a], axes[b]);
      EXPECT_NEAR(read.x, a == b ? 1 : 1 / (1 + 2.0), 1e-9) << a << b; // S: .25 (1 + 2 cos)
    }
}

TEST(Lightmap, LightFromBelowTheNormalIsNotScaledWithoutBound) {
  const f64::LightmapSh below = f64::encodeLightmapSh(1, {0, 0, -1.7320508});
  EXPECT_EQ(f64::flatNormalScale(below, {0, 0, 1}), 64);
  EXPECT_NEAR(f64::flatNormalScale(f64::encodeLightmapSh(0, {0, 0, 0}), {0, 0, 1}), 1 / 0.2820948, 1e-5);
  const f64::real32x3 r = f64::encodeLightmapDirection(1, {0, 0, -1.7320508});
  EXPECT_LE(f64::directionalLightmapRatio(r, {0, 0, -1}, {0, 0, 1}), 64);
  EXPECT_EQ(f64::encodeLightmapDirection(0, {1, 2, 3}).x, 0);
  const f64::real32x3 clamped = f64::encodeLightmapDirection(1, {3, 0, 4});
  EXPECT_NEAR(clamped.x, 0.6, 1e-12);
  EXPECT_NEAR(clamped.z, 0.8, 1e-12);
}

TEST(Lightmap, TheHighEndRatioIsOneAtTheBakedNormalAndWithoutADirection) {
  const Direction n = leaning(0.9), N0 = leaning(0.2);
  EXPECT_NEAR(f64::directionalLightmapRatio({0, 0, 0}, vec(n), vec(N0)), 1, 1e-15);
  EXPECT_NEAR(f64::directionalLightmapRatio({0.3, -0.2, 0.6}, vec(N0), vec(N0)), 1, 1e-15);
  EXPECT_EQ(f64::nonlinearIrradiance({0, 0, 0}, vec(n)), 1);
  EXPECT_NEAR(f64::nonlinearIrradiance({0, 0, 1}, {0, 0, 1}), 4, 1e-12) << "a delta light's irradiance over its mean";
  EXPECT_NEAR(f64::nonlinearIrradiance({0, 0, 1}, {0, 0, -1}), 0, 1e-12);
}

// The mean over all normals is the irradiance of the same light from everywhere (Hazel 2015: what the model conserves).
TEST(Lightmap, TheHighEndFormConservesTheMean) {
  const GaussRule rule(64);
  for (const double length : {0.0, 0.25, 0.5, 1.0}) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      sum += rule.weights[i] / 2 *
             f64::nonlinearIrradiance({0, 0, length}, {0, std::sqrt(1 - rule.nodes[i] * rule.nodes[i]), rule.nodes[i]});
    EXPECT_NEAR(sum, 1, 1e-6) << length;
  }
}

// Irradiance at shading normals that lean from the baked one by up to 60 degrees: E(N0) R(n)/R(N0) against the linear
// form, E(N0) max(0, S(n))/S(N0). A hemisphere's irradiance is of order 1: there the linear form is exact.
TEST(Lightmap, TheNonlinearFormIsNearerToTheTruthThanTheLinearOneForLightFromFewDirections) {
  struct Case {
    const char* name;
    Baked baked;
    bool linearIsExact;
  };
  const Case cases[] = {{"delta light, 45 degrees", makeDelta(leaning(pi / 4)), false},
                        {"delta light, 75 degrees", makeDelta(leaning(pi / 2.4)), false},
                        {"cap of 20 degrees", makeCap(pi / 9), false},
                        {"cap of 45 degrees", makeCap(pi / 4), false},
                        {"hemisphere", makeCap(pi / 2), true},
                        {"uniform sky", makeCap(pi), true}};
  const Direction N0{0, 0, 1};
  for (const Case& c : cases) {
    const f64::real32x3 r = f64::encodeLightmapDirection(c.baked.l0, vec(c.baked.l1));
    const f64::LightmapSh SH = f64::encodeLightmapSh(c.baked.l0, vec(c.baked.l1));
    const double E0 = c.baked.irradianceOverPi(N0);
    double nonlinear = 0, linear = 0;
    int count = 0;
    for (double angle = -pi / 3; angle <= pi / 3 + 1e-9; angle += pi / 36, ++count) {
      const Direction n = leaning(angle);
      const double truth = c.baked.irradianceOverPi(n);
      nonlinear += std::pow(E0 * f64::directionalLightmapRatio(r, vec(n), vec(N0)) - truth, 2);
      linear += std::pow(E0 * f64::lightmapDirectionality(SH, vec(n)) * f64::flatNormalScale(SH, vec(N0)) - truth, 2);
    }
    nonlinear = std::sqrt(nonlinear / count) / E0;
    linear = std::sqrt(linear / count) / E0;
    std::printf("  %-24s rms error over E(N0): nonlinear %6.2f %%, linear %6.2f %%\n", c.name, 100 * nonlinear,
                100 * linear);
    if (c.linearIsExact) {
      EXPECT_LT(linear, 1e-3) << c.name;
      EXPECT_LT(nonlinear, 0.1) << c.name;
    } else {
      EXPECT_LT(nonlinear, linear) << c.name;
    }
  }
}

TEST(Lightmap, TheDistanceFieldShadowIsSquaredAboutTheEdge) {
  EXPECT_NEAR(f64::distanceFieldShadow(0.5, 8), 0.25, 1e-15) << "the edge, whatever T is";
  EXPECT_NEAR(f64::distanceFieldShadow(0.5, 2), 0.25, 1e-15);
  EXPECT_EQ(f64::distanceFieldShadow(1, 4), 1);
  EXPECT_EQ(f64::distanceFieldShadow(0, 4), 0);
  EXPECT_NEAR(f64::distanceFieldShadow(0.6, 4), 0.9 * 0.9, 1e-12); // .6 * 4 + .5 - 2
  EXPECT_NEAR(f64::distanceFieldShadow(0.75, 1), 0.75 * 0.75, 1e-12);
  for (double d = 0; d <= 1; d += 1.0 / 255)
    EXPECT_NEAR(float(f16::distanceFieldShadow(shading::Half(d), 16)), f64::distanceFieldShadow(d, 16), 0.009)
        << d << ": half an ulp of d times 16, squared";
}

} // namespace
} // namespace parity::tests

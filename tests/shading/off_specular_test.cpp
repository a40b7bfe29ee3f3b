// The taps against the integral that they stand for, under a soft light at many places.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

struct Vec {
  double x, y, z;
};
double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec operator*(double s, const Vec& v) { return {s * v.x, s * v.y, s * v.z}; }
Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec normalize(const Vec& v) { return 1 / std::sqrt(dot(v, v)) * v; }

using Sky = std::function<double(const Vec&)>;

// Mean of the sky over what GGX reflects at F = 1; N = +Z, V in the plane of x and z. Half vectors by their share of
// D NoH, midpoint rule.
double reflect(const Sky& sky, double roughness, double NoV) {
  constexpr int kSteps = 96;
  const double alpha = roughness * roughness;
  const Vec V{-std::sqrt(1 - NoV * NoV), 0, NoV};
  double sum = 0, total = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double share = (i + 0.5) / kSteps, phi = 2 * pi * (j + 0.5) / kSteps;
      const double cos2 = (1 - share) / (1 + (alpha * alpha - 1) * share), s = std::sqrt(1 - cos2);
      const Vec H{s * std::cos(phi), s * std::sin(phi), std::sqrt(cos2)};
      const double VoH = dot(V, H);
      const Vec L = 2 * VoH * H + -1 * V;
      if (VoH <= 0 || L.z <= 0) continue;
      const double weight = f64::V_SmithGGXCorrelated(alpha, NoV, L.z) * L.z * VoH / H.z;
      sum += weight * sky(L);
      total += weight;
    }
  return sum / total;
}

// The prefiltered cube: the sky's mean over the lobe of N = V = R about a direction, between its levels; or trilinear
// in layer 0, as the mobile path reads it.
double readCube(const Sky& sky, const Vec& direction, double mip, bool layered) {
  const auto atMip = [&](double level) {
    constexpr int kSteps = 48;
    const double alpha = f64::sqr(f64::roughnessFromMip(level));
    const Vec n = normalize(direction);
    const Vec up = std::abs(n.z) < 0.9 ? Vec{0, 0, 1} : Vec{1, 0, 0};
    const Vec x = normalize({up.y * n.z - up.z * n.y, up.z * n.x - up.x * n.z, up.x * n.y - up.y * n.x});
    const Vec y{n.y * x.z - n.z * x.y, n.z * x.x - n.x * x.z, n.x * x.y - n.y * x.x};
    double sum = 0, total = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double share = (i + 0.5) / kSteps, phi = 2 * pi * (j + 0.5) / kSteps;
        const double NoL = 2 * (1 - share) / (1 + (alpha * alpha - 1) * share) - 1;
        if (NoL <= 0) continue;
        const double s = std::sqrt(1 - NoL * NoL);
        sum += NoL * sky(s * std::cos(phi) * x + s * std::sin(phi) * y + NoL * n);
        total += NoL;
      }
    return sum / total;
  };
  if (!layered) {
    const double clamped = std::clamp(mip, 0.0, 1. * f64::kPrefilterRoughestMip), floor = std::floor(clamped);
    const double share = clamped - floor;
    return share > 0 ? atMip(floor) * (1 - share) + atMip(floor + 1) * share : atMip(floor);
  }
  const f64::PrefilterBlend blend = f64::finePrefilterBlend(mip);
  const double lower = atMip(1. * blend.lower / f64::kPrefilterLayers),
               upper = atMip(1. * blend.upper / f64::kPrefilterLayers);
  return lower * (1 - blend.upperShare) + upper * blend.upperShare;
}

// Irradiance over pi.
double irradianceOverPi(const Sky& sky) {
  constexpr int kSteps = 48;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double s = std::sqrt((i + 0.5) / kSteps), phi = 2 * pi * (j + 0.5) / kSteps; // by their cosine
      sum += sky({s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - s * s)});
    }
  return sum / (kSteps * kSteps);
}

// Root mean square error over views, roughnesses and skies, of one way to read; with a share of the irradiance.
double errorOf(const std::function<std::vector<f64::LobeTap>(double NoV, double roughness)>& taps, bool layered = true,
               const std::function<double(double NoV, double roughness)>& wide = {}) {
  double squares = 0;
  int count = 0;
  for (const double roughness : {0.25, 0.45, 0.65, 0.85, 1.0})
    for (const double NoV : {0.15, 0.4, 0.7, 0.95}) {
      const Vec mirrored{std::sqrt(1 - NoV * NoV), 0, NoV};
      for (int k = 0; k < 8; ++k) { // a soft light some 40 degrees across, at a spiral of places
        const double z = 1 - (k + 0.5) / 6, angle = 2.4 * k;
        const Vec towards{std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
        const Sky sky = [&](const Vec& d) { return 0.2 + 2 * std::exp(8 * (dot(d, towards) - 1)); };
        double read = 0;
        for (const f64::LobeTap& tap : taps(NoV, roughness))
          read += tap.weight * readCube(sky, (1 - tap.blend) * Vec{0, 0, 1} + tap.blend * mirrored, tap.mip, layered);
        if (wide) read += wide(NoV, roughness) * irradianceOverPi(sky);
        squares += std::pow(read / reflect(sky, roughness, NoV) - 1, 2);
        ++count;
      }
    }
  return std::sqrt(squares / count);
}

// Observed: 23.7, 10.4, 5.2, 3.7, 2.8 %.
TEST(OffSpecular, EachRemedyIsBetterThanTheOneBefore) {
  const double none = errorOf([](double, double R) {
    return std::vector<f64::LobeTap>{{1, f64::mipFromRoughness(R), 1}};
  });
  const double dominant = errorOf([](double, double R) {
    return std::vector<f64::LobeTap>{{f64::dominantBlend(R * R), f64::mipFromRoughness(R), 1}};
  });
  const double stretched = errorOf([](double N, double R) {
    return std::vector<f64::LobeTap>{f64::stretchedTap(0, N, R), f64::stretchedTap(1, N, R)};
  });
  const double two = errorOf([](double N, double R) {
    return std::vector<f64::LobeTap>{f64::twoTap(0, N, R), f64::twoTap(1, N, R)};
  });
  const double three = errorOf([](double N, double R) {
    return std::vector<f64::LobeTap>{f64::threeTap(0, N, R), f64::threeTap(1, N, R), f64::threeTap(2, N, R)};
  });
  std::printf("relative RMSE: none %.3f, dominant %.3f, stretched %.3f, two taps %.3f, three taps %.3f\n", none,
              dominant, stretched, two, three);
  EXPECT_GT(none, 0.2);
  EXPECT_LT(dominant, 0.6 * none);
  EXPECT_LT(stretched, 0.6 * dominant);
  EXPECT_LT(two, 0.8 * stretched);
  EXPECT_LT(three, 0.85 * two);
}

TEST(OffSpecular, WeightsAddUpToOneAndMipsExist) {
  for (int r = 0; r <= 20; ++r)
    for (int n = 0; n <= 20; ++n) {
      const double R = r / 20.0, N = n / 20.0;
      const f64::LobeTap taps[] = {f64::stretchedTap(0, N, R), f64::stretchedTap(1, N, R), f64::twoTap(0, N, R),
                                   f64::twoTap(1, N, R),       f64::threeTap(0, N, R),     f64::threeTap(1, N, R),
                                   f64::threeTap(2, N, R)};
      EXPECT_NEAR(taps[0].weight + taps[1].weight, 1, 1e-12);
      EXPECT_NEAR(taps[2].weight + taps[3].weight, 1, 1e-12);
      EXPECT_NEAR(taps[4].weight + taps[5].weight + taps[6].weight, 1, 1e-12);
      for (const f64::LobeTap& tap : taps) {
        EXPECT_TRUE(tap.weight >= 0 && tap.weight <= 1);
        EXPECT_LE(tap.mip, f64::kPrefilterRoughestMip);
        EXPECT_LT(std::abs(tap.blend), 3);
        if (r == 0) {
          EXPECT_EQ(tap.blend, 1) << "a mirror shows the mirror direction";
          EXPECT_LT(tap.mip, -3) << "and reads it sharp";
        }
      }
    }
}

// The mobile path's one read, trilinear, with its share of the irradiance: between the dominant direction and two reads
// of the layered cube.
TEST(RefitTap, IsBetterThanADominantReadOfTheSameCube) {
  const auto at = [](double blend, double mip) { return std::vector<f64::LobeTap>{{blend, mip, 1}}; };
  const double none = errorOf([&](double, double R) { return at(1, f64::mipFromRoughness(R)); }, false);
  const double dominant =
      errorOf([&](double, double R) { return at(f64::dominantBlend(R * R), f64::mipFromRoughness(R)); }, false);
  const double refit = errorOf(
      [&](double N, double R) {
        const f64::RefitTap tap = f64::refitTap(R, N);
        return std::vector<f64::LobeTap>{{1 / (1 + tap.lean), tap.mip, 1 - tap.wide}};
      },
      false, [](double N, double R) { return f64::refitTap(R, N).wide; });
  std::printf("trilinear: none %.3f, dominant %.3f, refit %.3f\n", none, dominant, refit);
  EXPECT_LT(dominant, 0.6 * none);
  EXPECT_LT(refit, 0.6 * dominant);
}

// Lagarde and de Rousiers' listing: a mirror at 1, the normal at full roughness.
TEST(OffSpecular, DominantDirectionRunsFromMirrorToNormal) {
  EXPECT_EQ(f64::dominantBlend(0), 1);
  EXPECT_EQ(f64::dominantBlend(1), 0);
  EXPECT_NEAR(f64::dominantBlend(0.5), 0.5 * (std::sqrt(0.5) + 0.5), 1e-15);
}

} // namespace
} // namespace parity::tests

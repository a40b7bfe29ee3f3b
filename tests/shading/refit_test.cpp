// The preset refit against the high-end path's own model, integrated independently: directional albedo, direct light,
// shape of highlights.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f16 = shading::f16;
using shading::Half;
using std::numbers::pi;

// The height-correlated lobe and what Kulla and Conty add to it (2017; Hill 2018), at one roughness.
class Truth {
public:
  explicit Truth(double roughness) : m_roughness(roughness) {
    const PanelRule cosines({0.0, 0.003, 0.02, 0.1, 0.4, 1.0}, 6);
    for (std::size_t i = 0; i < cosines.nodes.size(); ++i) {
      const EnvBrdf e = integrateEnvBrdf(Geometry::heightCorrelated, roughness, cosines.nodes[i], 8);
      m_average += 2 * cosines.weights[i] * cosines.nodes[i] * (e.A + e.B);
    }
  }
  EnvBrdf at(double NoV) const { return integrateEnvBrdf(Geometry::heightCorrelated, m_roughness, NoV, 8); }
  double multiple(double F0, const EnvBrdf& e) const {
    const double mean = F0 + (1 - F0) / 21; // of Schlick's Fresnel
    return mean * mean * m_average * (1 - e.A - e.B) / (1 - mean * (1 - m_average));
  }
  double total(double F0, const EnvBrdf& e) const { return F0 * e.A + e.B + multiple(F0, e); }
  // How the second spreads over light directions, times pi.
  double spread(double NoL) const {
    const EnvBrdf e = at(NoL);
    return (1 - e.A - e.B) / (1 - m_average);
  }

private:
  double m_roughness, m_average = 0;
};

struct RefitDeviation {
  double squares = 0, max = 0;
  int count = 0;
  void add(double error) {
    squares += error * error;
    max = std::max(max, std::fabs(error));
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }
};

double total64(double F0, double R, double N) {
  const f64::RefitLobe lobe = f64::refitLobe({F0, F0, F0}, 1, R, N);
  return lobe.single.x + lobe.multiple.x;
}
double total16(double F0, double R, double N) {
  const Half f(F0);
  const f16::RefitLobe lobe = f16::refitLobe({f, f, f}, Half(1), Half(R), Half(N));
  return float(lobe.single.x) + float(lobe.multiple.x);
}

// Over the full domain of docs/shading.md 2a: NoV >= 1/256, roughness >= 1/64. Wanted: .01 at F0 = .04, .02 at F0 = 1.
TEST(RefitLobe, ReflectsWhatTheCompensatedHighEndLobeDoes) {
  constexpr std::array kF0 = {0.02, 0.04, 0.5, 0.75, 1.0};
  std::array<RefitDeviation, kF0.size()> exact, half;
  RefitDeviation multiple;
  for (int i = 0; i < 20; ++i) {
    const double R = 1.0 / 64 + (1 - 1.0 / 64) * (i + 0.5) / 20;
    const Truth truth(R);
    for (int k = 0; k < 20; ++k) {
      const double N = 1.0 / 256 + (1 - 1.0 / 256) * (k + 0.5) / 20;
      const EnvBrdf e = truth.at(N);
      for (std::size_t f = 0; f < kF0.size(); ++f) {
        const double expected = truth.total(kF0[f], e);
        exact[f].add(total64(kF0[f], R, N) - expected);
        half[f].add(total16(kF0[f], R, N) - expected);
      }
      multiple.add(f64::refitLobe({1, 1, 1}, 1, R, N).multiple.x - truth.multiple(1, e));
    }
  }
  for (std::size_t f = 0; f < kF0.size(); ++f)
    std::printf("F0 %.2f: rms %.4f, max %.3f; in half %.4f, %.3f\n", kF0[f], exact[f].rms(), exact[f].max,
                half[f].rms(), half[f].max);
  EXPECT_LE(exact[1].rms(), 0.006);
  EXPECT_LE(exact[4].rms(), 1e-12) << "nothing is lost at F0 = 1";
  for (std::size_t f = 0; f < kF0.size(); ++f) {
    EXPECT_LE(exact[f].rms(), 0.0085) << kF0[f];
    EXPECT_LE(exact[f].max, 0.06) << kF0[f];
    EXPECT_LE(half[f].rms(), exact[f].rms() + 5e-4) << kF0[f];
  }
  EXPECT_LE(multiple.rms(), 0.025);
}

TEST(RefitLobe, GivesEachChannelItsOwnColourAndFollowsF90) {
  const f64::RefitLobe lobe = f64::refitLobe({0.1, 0.5, 0.9}, 1, 0.4, 0.3);
  EXPECT_EQ(lobe.single.x + lobe.multiple.x, total64(0.1, 0.4, 0.3));
  EXPECT_EQ(lobe.single.y + lobe.multiple.y, total64(0.5, 0.4, 0.3));
  EXPECT_EQ(lobe.single.z + lobe.multiple.z, total64(0.9, 0.4, 0.3));
  EXPECT_DOUBLE_EQ(f64::refitDiffuseShare(lobe.single.y, lobe.multiple.y), 1 - total64(0.5, 0.4, 0.3));
  // KHR_materials_specular: a factor on F0 and F90 alike is one on what scatters once.
  const f64::RefitLobe dim = f64::refitLobe({0.02, 0.02, 0.02}, 0.5, 0.4, 0.3);
  EXPECT_NEAR(dim.single.x, 0.5 * f64::refitLobe({0.04, 0.04, 0.04}, 1, 0.4, 0.3).single.x, 1e-15);
  const f64::RefitLobe off = f64::refitLobe({0, 0, 0}, 0, 0.4, 0.3);
  EXPECT_EQ(off.single.x, 0);
  EXPECT_EQ(off.multiple.x, 0);
  EXPECT_EQ(f64::refitDiffuseShare(off.single.y, off.multiple.y), 1);
}

// A half metal's diffuse light is dimmed channel by channel, by what its own F0 sends back.
TEST(RefitLobe, DimsDiffuseLightChannelByChannel) {
  const f64::real3 base(0.9, 0.5, 0.1), F0 = f64::refitSpecularColor({0.04, 0.04, 0.04}, base, 0.5);
  EXPECT_NEAR(F0.x, f64::specularColor({0.04, 0.04, 0.04}, base, 0.5).x, 1e-15);
  const f64::real3 diffuse = f64::refitDiffuseColor(base, 0.5, {0.5, 0.75, 1});
  EXPECT_DOUBLE_EQ(diffuse.x, 0.9 * 0.5 * 0.5);
  EXPECT_DOUBLE_EQ(diffuse.z, 0.1 * 0.5);
}

// Whichever bin a nonmetal falls into, it has the same colour.
template <typename Real, typename Lobe, typename Nonmetal, typename Light, typename NonmetalLight>
void expectSameNonmetal(Lobe makeLobe, Nonmetal makeNonmetal, Light light, NonmetalLight nonmetalLight) {
  for (int r = 0; r <= 16; ++r)
    for (int n = 0; n <= 16; ++n) {
      auto general = makeLobe({Real(0.04), Real(0.04), Real(0.04)}, Real(1), Real(r / 16.0), Real(n / 16.0));
      const auto nonmetal = makeNonmetal(Real(r / 16.0), Real(n / 16.0));
      EXPECT_EQ(general.single.y, nonmetal.single.y);
      EXPECT_LT(float(general.multiple.y), 1.2e-3f);
      general.multiple = {};
      EXPECT_EQ(light(general, Real(0.7), {0.9, 0.6}).z, nonmetalLight(nonmetal, Real(0.7), {0.9, 0.6}));
    }
}
TEST(RefitNonmetal, IsTheGeneralFormBitForBit) {
  namespace f32 = shading::f32;
  expectSameNonmetal<double>(f64::refitLobe, f64::refitNonmetalLobe, f64::refitLight, f64::refitNonmetalLight);
  expectSameNonmetal<float>(f32::refitLobe, f32::refitNonmetalLobe, f32::refitLight, f32::refitNonmetalLight);
  expectSameNonmetal<Half>(f16::refitLobe, f16::refitNonmetalLobe, f16::refitLight, f16::refitNonmetalLight);
}

// Light from everywhere at F0 = 1, and at F0 = .04: what leaves over what should. Wanted: rms log ratio <= .2, exitance
// <= 1.05.
TEST(RefitLight, ReflectsWhatTheCompensatedHighEndLightDoes) {
  for (const double F0 : {0.04, 1.0}) {
    RefitDeviation logs;
    double least = 10, most = 0, exitance = 0;
    for (const double R : {0.07, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
      const Truth truth(R);
      for (const double N : {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
        const f64::RefitLobe lobe = f64::refitLobe({F0, F0, F0}, 1, R, N);
        const double reflected = integrateLobe(R * R, N, 12, [&](const Cosines& c) {
          return f64::refitLight(lobe, c.NoL, {std::min(c.NoH, 1.0), std::min(c.VoH, 1.0)}).x / pi;
        });
        const double ratio = reflected / truth.total(F0, truth.at(N));
        logs.add(std::log(ratio));
        least = std::min(least, ratio);
        most = std::max(most, ratio);
        exitance = std::max(exitance, reflected);
      }
    }
    std::printf("F0 %.2f: rms log ratio %.4f, range %.3f to %.3f, exitance %.4f\n", F0, logs.rms(), least, most,
                exitance);
    EXPECT_LE(logs.rms(), 0.04);
    EXPECT_GE(least, 0.85);
    EXPECT_LE(most, 1.05);
    EXPECT_LE(exitance, 1.05);
  }
}

// Highlights have the high-end path's shape: the single lobe is its own, times pi NoL, wherever the peak is below
// 65000.
TEST(RefitLight, IsTheHighEndLobeWhereNothingScattersTwice) {
  for (const double R : {0.1, 0.3, 0.6, 1.0})
    for (const double N : {0.05, 0.4, 1.0})
      for (const double L : {0.03, 0.5, 0.95})
        for (const double H : {0.3, 0.9, 0.999, 1.0}) {
          f64::RefitLobe lobe = f64::refitLobe({0.04, 0.3, 0.9}, 1, R, N);
          lobe.multiple = {0, 0, 0};
          const double dv =
              distribution(R * R, H) * maskingShadowing(Geometry::heightCorrelated, R * R, N, L) / (4 * N * L);
          const double f = std::pow(1 - 0.7, 5);
          const f64::real3 light = f64::refitLight(lobe, L, {H, 0.7});
          EXPECT_NEAR(light.x / (pi * L * dv * (0.04 + 0.96 * f)), 1, 1e-9);
          EXPECT_NEAR(light.z / (pi * L * dv * (0.9 + 0.1 * f)), 1, 1e-9);
        }
}

// What scatters more than once spreads as Kulla and Conty's lobe does, to within a third where it is a tenth of the
// light or more; its integral is kept.
TEST(RefitLight, SpreadsMultipleScatteringWide) {
  double integral = 0;
  const PanelRule cosines({0.0, 1.0}, 8);
  for (const double R : {0.7, 0.85, 1.0}) {
    const Truth truth(R);
    f64::RefitLobe lobe = f64::refitLobe({0, 0, 0}, 0, R, 0.5);
    lobe.multiple = {1, 1, 1};
    for (const double L : {0.25, 0.5, 0.75, 1.0})
      EXPECT_NEAR(f64::refitLight(lobe, L, {0.5, 0.5}).x / (L * truth.spread(L)), 1, 0.2) << R << ", " << L;
    integral = 0;
    for (std::size_t i = 0; i < cosines.nodes.size(); ++i)
      integral += 2 * cosines.weights[i] * f64::refitLight(lobe, cosines.nodes[i], {0.5, 0.5}).x;
    EXPECT_NEAR(integral, 1, 1e-5);
  }
}

TEST(RefitHalfVector, HasTheCosinesOfTheHalfVector) {
  const f64::real3 N(0, 0, 1), V(0.6, 0, 0.8), L(-0.48, 0.64, 0.6);
  const f64::RefitHalfVector cosines = f64::refitHalfVector(N, V, L);
  const double length = std::sqrt(0.12 * 0.12 + 0.64 * 0.64 + 1.4 * 1.4);
  EXPECT_NEAR(cosines.NoH, 1.4 / length, 1e-15);
  EXPECT_NEAR(cosines.VoH, (0.6 * 0.12 + 0.8 * 1.4) / length, 1e-15);
  const f64::RefitHalfVector behind = f64::refitHalfVector(N, V, {-0.6, 0, -0.8});
  EXPECT_EQ(behind.NoH, 0);
  EXPECT_EQ(behind.VoH, 0);
}

TEST(RefitDirection, IsTheMirrorDirectionPlusTheNormal) {
  const f64::real3 N(0, 0.6, 0.8), V(0.6, 0, 0.8);
  const double twice = 2 * 0.64;
  const f64::real3 d = f64::refitDirection(N, V, 0.64, 0.5);
  EXPECT_NEAR(d.x, -0.6, 1e-15);
  EXPECT_NEAR(d.y, twice * 0.6 + 0.5 * 0.6, 1e-15);
  EXPECT_NEAR(d.z, twice * 0.8 - 0.8 + 0.5 * 0.8, 1e-15);
  EXPECT_NEAR(f64::refitTap(0, 0.3).lean, 0, 2.5e-4) << "a mirror shows the mirror direction: to 1/64 of a texel";
}

} // namespace
} // namespace parity::tests

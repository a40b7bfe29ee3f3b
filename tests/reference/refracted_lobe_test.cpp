// The lobe of refracted light: its directions against their density, and its values against the formulas of Walter et
// al. 2007, written out here.
#include "reference/refracted_lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/direction_density.h"
#include "shading/quadrature.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// From the amplitudes of both polarisations (Born and Wolf, "Principles of Optics", 1.5.2).
double textbookFresnel(double eta, double c) {
  const double sin2 = (1 - c * c) / (eta * eta);
  if (sin2 >= 1) return 1;
  const double t = std::sqrt(1 - sin2);
  const double s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
  return 0.5 * (s * s + p * p);
}

double textbookG1(double alpha, double cosine) {
  const double tan2 = (1 - cosine * cosine) / (cosine * cosine);
  return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
}

glm::dvec3 viewOf(double z) { return {std::sqrt(1 - z * z) * 0.8, std::sqrt(1 - z * z) * 0.6, z}; }

// The means over visible normals of what does not reflect totally, and of 1 - F.
struct Shares {
  double refracts = 0, passes = 0;
};
Shares sharesOfNormals(double alpha, double eta, const glm::dvec3& view) {
  constexpr int kHeights = 1500, kAround = 500;
  Shares sum;
  double all = 0;
  for (int i = 0; i < kHeights; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double tan = alpha * std::tan((i + 0.5) / kHeights * pi / 2), z = 1 / std::sqrt(1 + tan * tan);
      const double phi = (j + 0.5) / kAround * 2 * pi, s = tan * z;
      const double VoH = glm::dot(view, glm::dvec3(s * std::cos(phi), s * std::sin(phi), z));
      if (!(VoH > 0)) continue;
      // dh = s dtheta dphi, dtheta = z^2 dtan, dtan = (alpha + tan^2 / alpha) dpsi
      const double area = s * z * z * (alpha + tan * tan / alpha) * (pi / 2 / kHeights) * (2 * pi / kAround);
      const double mass = tests::distribution(alpha, z) * textbookG1(alpha, view.z) * VoH / view.z * area;
      all += mass;
      sum.refracts += textbookFresnel(eta, VoH) < 1 ? mass : 0;
      sum.passes += (1 - textbookFresnel(eta, VoH)) * mass;
    }
  EXPECT_NEAR(all, 1, 2e-3) << "visible normals have the density 1 together";
  return sum;
}

TEST(RefractedLobe, FresnelIsThatOfBothPolarisations) {
  for (const double eta : {1.0, 1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5})
    for (const double c : {1e-3, 0.1, 0.4, 0.7, 0.9, 1.0})
      EXPECT_NEAR(dielectricReflectance(eta, c), textbookFresnel(eta, c), 1e-12) << eta << ", " << c;
  EXPECT_NEAR(dielectricReflectance(1.5, 1), 0.04, 1e-12);
  EXPECT_EQ(dielectricReflectance(1 / 1.5, 0.7), 1) << "beyond the critical angle of 41.8 degrees";
  EXPECT_EQ(dielectricReflectance(1, 0), 1);
}

// Above the surface for the histogram, whose hemisphere that is.
TEST(RefractedLobe, DirectionsFollowTheirDensity) {
  for (const double eta : {1.5, 1 / 1.5})
    for (const double alpha : {0.25, 0.5, 1.0})
      for (const double z : {0.95, 0.5, 0.15}) {
        SCOPED_TRACE(testing::Message() << "eta " << eta << ", alpha " << alpha << ", view " << z);
        const RefractedLobe lobe(alpha, eta);
        const glm::dvec3 view = viewOf(z);
        tests::expectDensity(
            [&](const glm::dvec2& u) {
              const auto light = lobe.refract(view, lobe.sampleHalf(view, u));
              return light ? glm::dvec3(light->x, light->y, -light->z) : glm::dvec3(0, 0, -1);
            },
            [&](const glm::dvec3& d) {
              return lobe.evaluate(view, {d.x, d.y, -d.z}).pdf;
            },
            sharesOfNormals(alpha, eta, view).refracts, 4e-3);
      }
}

// Narrow lobes, in steps about the direction that a mirror would take.
TEST(RefractedLobe, IntegratesToWhatPasses) {
  for (const double eta : {1.5, 1.1, 1 / 1.5})
    for (const double alpha : {0.01, 0.1, 0.6})
      for (const double z : {1.0, 0.8, 0.3}) {
        const RefractedLobe lobe(alpha, eta);
        const glm::dvec3 view = viewOf(z);
        const Shares shares = sharesOfNormals(alpha, eta, view);
        // By refracted microfacets, each of the half vector's own density: dl = dh (i.h + eta o.h)^2 / (eta^2 |o.h|).
        double pdf = 0, value = 0;
        constexpr int kHeights = 900, kAround = 300;
        for (int i = 0; i < kHeights; ++i)
          for (int j = 0; j < kAround; ++j) {
            const double tan = alpha * std::tan((i + 0.5) / kHeights * pi / 2), c = 1 / std::sqrt(1 + tan * tan);
            const double phi = (j + 0.5) / kAround * 2 * pi, s = tan * c;
            const glm::dvec3 h(s * std::cos(phi), s * std::sin(phi), c);
            const double VoH = glm::dot(view, h), cos2 = 1 - (1 - VoH * VoH) / (eta * eta);
            if (!(VoH > 0 && cos2 > 0)) continue;
            const glm::dvec3 light = -view / eta + (VoH / eta - std::sqrt(cos2)) * h;
            if (!(light.z < 0)) continue; // counted below, where it is mirrored
            const double jacobian = std::pow(VoH + eta * glm::dot(light, h), 2) / (eta * eta * -glm::dot(light, h));
            const double area = s * c * c * (alpha + tan * tan / alpha) * (pi / 2 / kHeights) * (2 * pi / kAround);
            const RefractedValues at = lobe.evaluate(view, light);
            pdf += at.pdf * jacobian * area;
            value += at.value * jacobian * area;
          }
        // What is mirrored adds to directions that are here already: of rough surfaces seen from within alone.
        const double slack = eta < 1 && (alpha > 0.2 || z < 0.5) ? 0.12 : 3e-3;
        EXPECT_NEAR(pdf, shares.refracts, slack) << eta << ", " << alpha << ", " << z;
        EXPECT_NEAR(value, shares.passes, slack) << eta << ", " << alpha << ", " << z;
      }
}

// Eq. 21 of Walter et al. 2007 times |o.n|, less the masking of light, which the lobe gives back.
TEST(RefractedLobe, ValueIsThePapersFormula) {
  const double alpha = 0.4;
  const glm::dvec3 i = viewOf(0.7);
  for (const double eta : {1.5, 1 / 1.5}) {
    const RefractedLobe lobe(alpha, eta);
    int compared = 0;
    for (const glm::dvec2 u :
         {glm::dvec2(0.1, 0.2), glm::dvec2(0.6, 0.4), glm::dvec2(0.8, 0.7), glm::dvec2(0.3, 0.9)}) {
      const glm::dvec3 h = lobe.sampleHalf(i, u);
      const auto o = lobe.refract(i, h);
      if (!o) continue;
      const double etaI = eta > 1 ? 1 : 1.5, etaO = etaI * eta;
      const auto formula = [&](const glm::dvec3& light) {
        glm::dvec3 half = glm::normalize(-(etaI * i + etaO * light));
        if (half.z < 0) half = -half;
        const double VoH = glm::dot(i, half), LoH = glm::dot(light, half);
        if (!(VoH > 0 && LoH < 0)) return 0.0;
        const double G = textbookG1(alpha, i.z), D = tests::distribution(alpha, half.z);
        return std::abs(VoH * LoH / i.z) * etaO * etaO * (1 - textbookFresnel(eta, VoH)) * G * D /
               std::pow(etaI * VoH + etaO * LoH, 2);
      };
      const double expected = formula(*o) + formula({o->x, o->y, -o->z});
      EXPECT_NEAR(lobe.evaluate(i, *o).value / expected, 1, 1e-9) << eta;
      ++compared;
    }
    EXPECT_GE(compared, 2);
  }
}

TEST(RefractedLobe, MirrorFollowsSnell) {
  const RefractedLobe in(0, 1.5), out(0, 1 / 1.5);
  EXPECT_TRUE(in.isMirror());
  EXPECT_FALSE(in.hasDensity());
  for (const double z : {1.0, 0.6, 0.1}) {
    const glm::dvec3 view = viewOf(z), half = in.sampleHalf(view, {0.3, 0.7});
    EXPECT_EQ(half, glm::dvec3(0, 0, 1));
    const auto light = in.refract(view, half);
    ASSERT_TRUE(light);
    EXPECT_NEAR(std::hypot(light->x, light->y) * 1.5, std::hypot(view.x, view.y), 1e-12);
    EXPECT_NEAR(light->x * view.y - light->y * view.x, 0, 1e-12) << "in the plane of incidence";
    EXPECT_LT(light->x * view.x + light->y * view.y, 1e-12) << "on the other side of the normal";
    // And back again.
    const auto back = out.refract(glm::dvec3(light->x, light->y, -light->z), half);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->z, -view.z, 1e-12);
  }
  EXPECT_FALSE(out.refract(viewOf(0.7), {0, 0, 1})) << "total reflection";
}

// An index of 1 bends nothing; nor has it a density.
TEST(RefractedLobe, IndexOfAirGoesStraightOn) {
  const RefractedLobe lobe(0.5, 1);
  EXPECT_FALSE(lobe.hasDensity());
  for (const double z : {0.9, 0.2}) {
    const glm::dvec3 view = viewOf(z), half = lobe.sampleHalf(view, {0.4, 0.8});
    const auto light = lobe.refract(view, half);
    ASSERT_TRUE(light);
    EXPECT_NEAR(glm::length(*light + view), 0, 1e-9);
    EXPECT_NEAR(lobe.fresnel(glm::dot(view, half)), 0, 1e-9);
  }
}

} // namespace
} // namespace parity::reference

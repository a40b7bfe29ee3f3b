// Refraction through a sphere against a ray that is traced through one, absorption, dispersion and the spread of rough
// bodies.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::shading {
namespace {

using std::numbers::pi;

f64::real32x3 toReal(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real32x3& v) { return {v.x, v.y, v.z}; }

// Snell's law by angles: the direction that leaves a surface on the other side, for the ray `incident`; normal towards
// where it comes from.
std::optional<glm::dvec3> refract(const glm::dvec3& incident, const glm::dvec3& normal, double indexRatio) {
  const double theta = std::acos(std::clamp(-glm::dot(incident, normal), -1.0, 1.0)),
               sine = std::sin(theta) * indexRatio;
  if (sine > 1) return std::nullopt;
  const double refracted = std::asin(sine);
  const glm::dvec3 along = incident + std::cos(theta) * normal;
  const glm::dvec3 unit = glm::length(along) > 0 ? glm::normalize(along) : glm::dvec3(0);
  return std::sin(refracted) * unit - std::cos(refracted) * normal;
}

TEST(ThroughSphere, IsTheRayTracedThroughOne) {
  for (const double ior : {1.0, 1.1, 1.5, 2.4})
    for (const double theta : {0.0, 0.2, 0.7, 1.2, 1.5})
      for (const double turn : {0.0, 1.1, 4.0}) {
        constexpr double kRadius = 0.75;
        const glm::dvec3 N = glm::normalize(glm::dvec3(0.3, -0.5, 0.8)),
                         T = glm::normalize(glm::cross(N, glm::dvec3(1, 0, 0))), B = glm::cross(N, T);
        const glm::dvec3 V = std::cos(theta) * N + std::sin(theta) * (std::cos(turn) * T + std::sin(turn) * B);
        const glm::dvec3 entry = kRadius * N; // of a sphere about the origin
        const auto inside = refract(-V, N, 1 / ior);
        ASSERT_TRUE(inside);
        const double path = -2 * glm::dot(entry, *inside);
        const glm::dvec3 exit = entry + path * *inside;
        const auto outside = refract(*inside, -glm::normalize(exit), ior);
        ASSERT_TRUE(outside);
        const f64::Refraction r = f64::throughSphere(toReal(N), toReal(V), ior, 2 * kRadius, 0);
        EXPECT_NEAR(glm::length(toGlm(r.inside) - *inside), 0, 1e-7) << ior << " " << theta;
        EXPECT_NEAR(r.path, path, 1e-7) << ior << " " << theta;
        EXPECT_NEAR(glm::length(toGlm(r.outside) - *outside), 0, 1e-6) << ior << " " << theta;
        EXPECT_NEAR(glm::length(toGlm(r.exit) - glm::normalize(exit)), 0, 1e-7);
        EXPECT_NEAR(r.cosine, path / (2 * kRadius), 1e-7);
        const glm::dvec3 reflected = glm::reflect(*inside, glm::normalize(exit)),
                         last = exit - 2 * glm::dot(exit, reflected) * reflected;
        const auto again = refract(reflected, -glm::normalize(last), ior);
        ASSERT_TRUE(again);
        EXPECT_NEAR(glm::length(toGlm(r.again) - *again), 0, 1e-6) << ior << " " << theta;
      }
}

TEST(ThroughSphere, IndexOneKeepsTheDirectionAndNormalsThatTurnAwayStayFinite) {
  const f64::Refraction same = f64::throughSphere({0, 0, 1}, {0.6, 0, 0.8}, 1, 2, 0);
  EXPECT_NEAR(glm::length(toGlm(same.outside) - glm::dvec3(-0.6, 0, -0.8)), 0, 1e-12);
  EXPECT_NEAR(same.path, 1.6, 1e-12);
  for (const double z : {0.0, -0.2, -1.0}) {
    const double x = std::sqrt(1 - z * z);
    for (const f64::Refraction& r :
         {f64::throughSphere({0, 0, 1}, {x, 0, z}, 1.5, 2, 0), f64::throughSphere({0, 0, 1}, {x, 0, z}, 1, 2, 0.5)}) {
      EXPECT_NEAR(glm::length(toGlm(r.outside)), 1, 1e-9) << z;
      EXPECT_NEAR(glm::length(toGlm(r.inside)), 1, 1e-9) << z;
      EXPECT_GE(r.path, 0) << z;
    }
  }
}

TEST(Transmittance, FollowsBeerAndLambert) {
  const f64::real32x3 left = f64::transmittance({0, std::log(2.0), 3}, 2);
  EXPECT_DOUBLE_EQ(left.x, 1);
  EXPECT_NEAR(left.y, 0.25, 1e-12);
  EXPECT_NEAR(left.z, std::exp(-6.0), 1e-12);
}

// The extension's definition: dispersion = 20 / V, V = (n - 1) / (n of blue - n of red).
TEST(DispersedIors, HaveTheAbbeNumber) {
  for (const double abbe : {20.0, 55.0, 90.0}) {
    const f64::real32x3 n = f64::dispersedIors(1.6, 20 / abbe);
    EXPECT_NEAR((n.y - 1) / (n.z - n.x), abbe, 1e-9);
    EXPECT_DOUBLE_EQ(n.y, 1.6);
    EXPECT_NEAR(n.z - n.y, n.y - n.x, 1e-12);
  }
  EXPECT_GE(f64::dispersedIors(1.01, 100).x, 1);
}

// Tilts of both surfaces' microfacets that are small: the rays that leave a sphere along its axis spread by as much as
// reflected rays of the alpha that the formula gives.
TEST(AlphaOfRefraction, SpreadsAsReflectionsOfThatAlpha) {
  constexpr double kTilt = 1e-3;
  constexpr int kTurns = 64;
  // The normal, tilted: at an even angle around it.
  const auto tilted = [](const glm::dvec3& normal, int turn) {
    const double angle = 2 * pi * (turn + 0.5) / kTurns;
    const glm::dvec3 x = glm::normalize(glm::cross(normal, glm::dvec3(0, 1, 0))), y = glm::cross(normal, x);
    return glm::normalize(normal + kTilt * (std::cos(angle) * x + std::sin(angle) * y));
  };
  const glm::dvec3 down(0, 0, -1);
  for (const double ior : {1.1, 1.5, 2.0, 2.5}) {
    double squares = 0, ofReflection = 0;
    for (int i = 0; i < kTurns; ++i)
      for (int k = 0; k < kTurns; ++k) {
        const glm::dvec3 entry(0, 0, 1); // of a sphere of radius 1
        const auto inside = refract(down, tilted(entry, i), 1 / ior);
        const glm::dvec3 exit = entry - 2 * glm::dot(entry, *inside) * *inside;
        const auto outside = refract(*inside, -tilted(exit, k), ior);
        squares += glm::dot(*outside - down, *outside - down);
        const glm::dvec3 reflected = glm::reflect(down, tilted(entry, i));
        ofReflection += glm::dot(reflected - entry, reflected - entry);
      }
    EXPECT_NEAR(f64::alphaOfRefraction(0.1, ior, 1 / ior) / 0.1, std::sqrt(squares / ofReflection), 1e-3) << ior;
  }
  EXPECT_EQ(f64::alphaOfRefraction(1, 40, 1.0 / 40), 1);
}

// Off the axis, tilts in the plane of incidence: turns of the ray that leaves, by tracing.
TEST(TurnOfRefraction, IsThatOfARayInThePlaneOfIncidence) {
  constexpr double kTilt = 1e-5;
  const auto at = [](double angle) { return glm::dvec3(std::sin(angle), 0, std::cos(angle)); };
  for (const double ior : {1.3, 1.5, 2.0})
    for (const double theta : {0.0, 0.3, 0.8, 1.2}) {
      // The angle of the ray that leaves; tilts of the microfacets where it enters and leaves.
      const auto leaves = [&](double enter, double exit) {
        const auto inside = refract(-at(theta), at(enter), 1 / ior);
        const glm::dvec3 place = at(0) - 2 * glm::dot(at(0), *inside) * *inside;
        const auto outside = refract(*inside, -at(std::atan2(place.x, place.z) + exit), ior);
        return std::atan2(outside->x, outside->z);
      };
      const double whole = leaves(0, 0), enters = std::remainder(leaves(kTilt, 0) - whole, 2 * pi) / kTilt,
                   exits = std::remainder(leaves(0, kTilt) - whole, 2 * pi) / kTilt;
      const double cosT = std::sqrt(1 - std::pow(std::sin(theta) / ior, 2)), q = std::cos(theta) / (ior * cosT);
      EXPECT_NEAR(f64::turnOfRefraction2(q), enters * enters + exits * exits, 1e-3 * (1 + exits * exits))
          << ior << " " << theta;
    }
}

TEST(LeavingLater, SumsTheWaysOfAGeometricSeries) {
  for (const double left : {0.3, 0.9, 1.0})
    for (const double reflected : {0.0, 0.04, 0.5, 0.9}) {
      double sum = 0, rest = reflected * left; // what comes to the second surface
      for (int turn = 0; turn < 2000; ++turn) {
        sum += rest * (1 - reflected);
        rest *= reflected * left;
      }
      EXPECT_NEAR(f64::leavingLater(reflected, left, 0, 1.5), sum, 1e-9) << left << " " << reflected;
      EXPECT_NEAR(f64::leavingLater(reflected, 1, 0.7, 1.5), reflected, 1e-9) << "nothing is lost";
      EXPECT_LE(f64::leavingLater(reflected, left, 0.7, 1.5), sum + 1e-12) << "longer ways absorb more";
    }
  EXPECT_EQ(f64::leavingLater(1, 1, 0, 1.5), 0) << "none ever leaves";
}

// The direction of the sum over the cap of visible normals before it is unstretched.
TEST(MeanVisibleNormal, IsThatOfTheCap) {
  for (const double alpha : {0.05, 0.3, 0.8})
    for (const double c : {1.0, 0.6, 0.2, 0.02}) {
      const glm::dvec3 view(std::sqrt(1 - c * c), 0, c),
          stretched = glm::normalize(glm::dvec3(alpha * view.x, 0, view.z));
      glm::dvec3 sum(0);
      constexpr int kHeights = 64, kAround = 16;
      for (int i = 0; i < kHeights; ++i)
        for (int k = 0; k < kAround; ++k) {
          const double z = 1 - (i + 0.5) / kHeights * (1 + stretched.z), r = std::sqrt(std::max(1 - z * z, 0.0)),
                       turn = 2 * pi * (k + 0.5) / kAround;
          sum += glm::dvec3(r * std::cos(turn), r * std::sin(turn), z) + stretched;
        }
      const glm::dvec3 mean = glm::normalize(glm::dvec3(alpha * sum.x, alpha * sum.y, sum.z));
      EXPECT_NEAR(glm::length(toGlm(f64::meanVisibleNormal({0, 0, 1}, toReal(view), alpha)) - mean), 0, 1e-6)
          << alpha << " " << c;
    }
  const glm::dvec3 smooth = toGlm(f64::meanVisibleNormal({0, 0, 1}, {0.8, 0, 0.6}, 0));
  EXPECT_EQ(smooth, glm::dvec3(0, 0, 1));
}

// A dielectric's reflectance from within, by amplitudes.
double reflectanceWithin(double ior, double c) {
  const double sine = ior * std::sqrt(1 - c * c);
  if (sine >= 1) return 1;
  const double o = std::sqrt(1 - sine * sine), s = (ior * c - o) / (ior * c + o), p = (ior * o - c) / (ior * o + c);
  return 0.5 * (s * s + p * p);
}

// Its mean over visible normals: the cap of the stretched view's sphere, evenly.
double reflectedBySum(double alpha, double ior, double c) {
  constexpr int kHeights = 96, kAround = 48;
  const glm::dvec3 view(std::sqrt(1 - c * c), 0, c), stretched = glm::normalize(glm::dvec3(alpha * view.x, 0, view.z));
  double sum = 0;
  for (int i = 0; i < kHeights; ++i)
    for (int k = 0; k < kAround; ++k) {
      const double z = 1 - (i + 0.5) / kHeights * (1 + stretched.z), r = std::sqrt(std::max(1 - z * z, 0.0)),
                   turn = 2 * pi * (k + 0.5) / kAround;
      const glm::dvec3 h = glm::dvec3(r * std::cos(turn), r * std::sin(turn), z) + stretched;
      const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 0.0)));
      sum += reflectanceWithin(ior, std::clamp(glm::dot(view, half), 0.0, 1.0));
    }
  return sum / (kHeights * kAround);
}

TEST(ReflectedWithin, IsTheDielectricsOfASmoothSurface) {
  for (const double ior : {1.0, 1.3, 1.5, 2.4})
    for (const double c : {0.0, 0.2, 0.7, 0.9, 1.0})
      EXPECT_NEAR(f64::reflectedWithin(0, ior, c), ior == 1 && c == 0 ? 1 : reflectanceWithin(ior, c), 1e-12)
          << ior << " " << c;
}

// Over the cosines that rays have which entered a sphere.
TEST(ReflectedWithin, FitsTheMeanOverMicrofacets) {
  const auto rmsOf = [](double ior) {
    double squares = 0;
    int count = 0;
    for (int r = 0; r <= 10; ++r)
      for (const double outside : {1.0, 0.9, 0.7, 0.5, 0.3, 0.1}) {
        const double c = std::sqrt(1 - (1 - outside * outside) / (ior * ior)), alpha = r * r / 100.0;
        const double error = f64::reflectedWithin(alpha, ior, c) - reflectedBySum(std::max(alpha, 1e-4), ior, c);
        squares += error * error;
        ++count;
      }
    const double rms = std::sqrt(squares / count);
    std::printf("  index %.1f: rms %.3f\n", ior, rms);
    return rms;
  };
  EXPECT_LT(rmsOf(1.5), 0.034);
  for (const double ior : {1.3, 1.8, 2.4}) EXPECT_LT(rmsOf(ior), 0.085) << ior;
}

// What a dense sum over the cap has: the share that is reflected, and sums of directions.
struct DenseCrossing {
  double reflected = 0;
  glm::dvec3 outside{0}, reflection{0};
};

// inside, within a surface of normal +Z: light from below.
DenseCrossing crossingBySum(const glm::dvec3& inside, double ior, double alpha) {
  constexpr int kHeights = 96, kAround = 48;
  const glm::dvec3 view(-inside.x, -inside.y, inside.z); // as seen from above the mirrored surface
  const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * view.x, alpha * view.y, view.z));
  DenseCrossing sum;
  for (int i = 0; i < kHeights; ++i)
    for (int k = 0; k < kAround; ++k) {
      const double z = 1 - (i + 0.5) / kHeights * (1 + stretched.z), r = std::sqrt(std::max(1 - z * z, 0.0)),
                   turn = 2 * pi * (k + 0.5) / kAround;
      const glm::dvec3 h = glm::dvec3(r * std::cos(turn), r * std::sin(turn), z) + stretched;
      const glm::dvec3 up = glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-9)));
      const glm::dvec3 facet(up.x, up.y, -up.z); // inwards
      const double F = reflectanceWithin(ior, std::clamp(-glm::dot(inside, facet), 0.0, 1.0));
      glm::dvec3 back = glm::reflect(inside, facet);
      back.z = -std::abs(back.z);
      sum.reflected += F / (kHeights * kAround);
      sum.reflection += F * back;
      if (auto out = F < 1 ? refract(inside, facet, ior) : std::nullopt) {
        out->z = std::abs(out->z);
        sum.outside += (1 - F) * *out;
      }
    }
  return sum;
}

TEST(CrossingFromWithin, IsThatOfAMirror) {
  for (const double ior : {1.1, 1.5, 2.4})
    for (const double theta : {0.1, 0.3, 0.7, 1.3}) {
      const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.5, 0.8)),
                       along = glm::normalize(glm::cross(normal, glm::dvec3(1, 0, 0))),
                       inside = std::cos(theta) * normal + std::sin(theta) * along;
      const f64::Crossing c = f64::crossingFromWithin(toReal(inside), toReal(normal), ior, 0);
      EXPECT_NEAR(c.reflected, reflectanceWithin(ior, std::cos(theta)), 1e-7) << ior << " " << theta;
      EXPECT_NEAR(glm::length(toGlm(c.reflection) - glm::reflect(inside, normal)), 0, 1e-6);
      const auto out = refract(inside, -normal, ior);
      if (out) {
        EXPECT_NEAR(glm::length(toGlm(c.outside) - *out), 0, 1e-5) << ior << " " << theta;
      }
    }
}

TEST(CrossingFromWithin, IsTheMeanOverMicrofacets) {
  for (const double ior : {1.2, 1.5, 2.0, 2.4}) {
    double squares = 0, most = 0, outside = 0, reflection = 0;
    int count = 0;
    for (const double alpha : {0.04, 0.16, 0.36, 0.64, 1.0})
      for (int k = 0; k <= 20; ++k) {
        const double theta = k / 20.0 * 0.5 * pi * 0.97;
        const glm::dvec3 inside(std::sin(theta), 0, std::cos(theta));
        const f64::Crossing c = f64::crossingFromWithin(toReal(inside), {0, 0, 1}, ior, alpha);
        const DenseCrossing dense = crossingBySum(inside, ior, alpha);
        const double error = c.reflected - dense.reflected;
        squares += error * error;
        most = std::max(most, std::abs(error));
        ++count;
        if (dense.reflected < 0.8)
          outside = std::max(outside, glm::length(toGlm(c.outside) - glm::normalize(dense.outside)));
        if (dense.reflected > 0.3)
          reflection = std::max(reflection, glm::length(toGlm(c.reflection) - glm::normalize(dense.reflection)));
      }
    std::printf("  index %.1f: reflected rms %.3f, at most %.3f; directions within %.3f and %.3f\n", ior,
                std::sqrt(squares / count), most, outside, reflection);
    EXPECT_LT(std::sqrt(squares / count), 0.055);
    EXPECT_LT(most, 0.2);
    EXPECT_LT(outside, 0.3);
    EXPECT_LT(reflection, 0.4);
  }
}

// Also where the rule's facets reflect all, along the surface, and without a difference of indices.
TEST(CrossingFromWithin, IsFiniteAtTheEdgesOfItsDomain) {
  for (const float ior : {1.f, 1.5f, 2.5f, 40.f})
    for (const float alpha : {0.f, 0.01f, 1.f})
      for (const float theta : {0.f, 1e-4f, 1.f, 1.5f, 1.5707963f}) {
        const f32::Crossing c = f32::crossingFromWithin({std::sin(theta), 0, std::cos(theta)}, {0, 0, 1}, ior, alpha);
        EXPECT_TRUE(c.reflected >= 0 && c.reflected <= 1) << ior << " " << alpha << " " << theta;
        if (alpha == 1) {
          EXPECT_LT(c.reflected, 1) << "some of it leaves";
        }
        EXPECT_NEAR(f32::dot32(c.outside, c.outside), 1, 1e-5) << ior << " " << alpha << " " << theta;
        EXPECT_NEAR(f32::dot32(c.reflection, c.reflection), 1, 1e-5) << ior << " " << alpha << " " << theta;
        EXPECT_GE(c.outside.z, 0);
        EXPECT_LE(c.reflection.z, 0);
      }
}

TEST(MobileSceneShare, FadesFromAMirrorToHalfRoughness) {
  EXPECT_EQ(f64::mobileSceneShare(0), 1);
  EXPECT_EQ(f64::mobileSceneShare(0.25), 0.5);
  for (const double roughness : {0.5, 0.7, 1.0}) EXPECT_EQ(f64::mobileSceneShare(roughness), 0);
}

} // namespace
} // namespace parity::shading

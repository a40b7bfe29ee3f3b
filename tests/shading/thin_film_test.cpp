// The thin film's reflectance against Airy's sum over the spectrum, the published text, its limits, and in half.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shading/flushed_half.h"
#include "shading/shading.h"

namespace parity::shading {
inline tests::FlushedHalf floor(tests::FlushedHalf x) { return tests::FlushedHalf(std::floor(float(x))); }
inline tests::FlushedHalf cos(tests::FlushedHalf x) { return tests::FlushedHalf(std::cos(float(x))); }
// thin_film.glsl alone, once more.
#define FN inline
#define CONSTANT inline constexpr
#define PRECISE
#define R(x) real(x)
namespace flushedFilm {
using real = tests::FlushedHalf;
using real3 = Vec3<real>;
inline constexpr real kSmallest(0x1p-14), kLargest(65504.0), kPi(3.14159265358979324);
FN real saturate(real x) { return min(max(x, R(0.0)), R(1.0)); }
FN real3 saturate(real3 v) { return real3(saturate(v.x), saturate(v.y), saturate(v.z)); }
FN real schlickWeight(real VoH) {
  const real x = R(1.0) - VoH, x2 = x * x;
  return x2 * x2 * x;
}
#define PARITY_SHADING_REAL
#define PARITY_SHADING_BRDF
#undef PARITY_SHADING_THIN_FILM
#include "shading/thin_film.glsl"
#undef PARITY_SHADING_BRDF
#undef PARITY_SHADING_REAL
} // namespace flushedFilm
#undef FN
#undef CONSTANT
#undef PRECISE
#undef R
} // namespace parity::shading

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;
namespace f16 = shading::f16;
using shading::Half;
using std::numbers::pi;

using Color = std::array<double, 3>;
Color toColor(const f64::real3& v) { return {v.x, v.y, v.z}; }
Color filmAt(double ior, double nm, const Color& F0, double cosine) {
  return toColor(f64::thinFilmFresnel(ior, nm, {F0[0], F0[1], F0[2]}, cosine));
}
Color grey(double x) { return {x, x, x}; }
double worstOf(const Color& a, const Color& b) {
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(a[c] - b[c]));
  return worst;
}
double schlick(double F0, double cosine) { return F0 + (1 - F0) * std::pow(1 - cosine, 5); }
double sqr(double x) { return x * x; }
Color toRec709(const Color& xyz) {
  return {3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2],
          -0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2],
          0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2]};
}

// The colour matching functions of CIE 1931, 2 degrees, as Wyman, Sloan and Shirley 2013 fit them ("Simple Analytic
// Approximations to the CIE XYZ Color Matching Functions", multi-lobe). nm.
Color matching(double nm) {
  const auto g = [&](double mean, double below, double above) {
    return std::exp(-0.5 * sqr((nm - mean) / (nm < mean ? below : above)));
  };
  return {1.056 * g(599.8, 37.9, 31.0) + 0.362 * g(442.0, 16.0, 26.7) - 0.065 * g(501.1, 20.4, 26.2),
          0.821 * g(568.8, 46.9, 40.5) + 0.286 * g(530.9, 16.3, 31.1),
          1.217 * g(437.0, 11.8, 36.0) + 0.681 * g(459.0, 26.0, 13.8)};
}

// The two interfaces of one channel.
struct Interfaces {
  double R12, R23, phase21, phase23, opd; // opd: nm
  Interfaces(double n2, double nm, double F0, double cosine) {
    const double n3 = (1 + std::sqrt(F0)) / (1 - std::sqrt(F0));
    const double cosFilm = std::sqrt(1 - (1 - cosine * cosine) / (n2 * n2));
    R12 = schlick(sqr((n2 - 1) / (n2 + 1)), cosine);
    R23 = schlick(sqr((n3 - n2) / (n3 + n2)), cosFilm);
    phase21 = n2 < 1 ? 0 : pi;
    phase23 = n3 < n2 ? pi : 0;
    opd = 2 * n2 * nm * cosFilm;
  }
  double C0() const { return R12 + sqr(1 - R12) * R23 / (1 - R12 * R23); }
  // Airy's sum in closed form: r12 + t12 t21 r23 e / (1 - r21 r23 e), r12 = -r21.
  double reflectanceAt(double nm) const {
    const std::complex<double> r21 = std::polar(std::sqrt(R12), phase21);
    const std::complex<double> r23 = std::polar(std::sqrt(R23), phase23 + 2 * pi * opd / nm);
    return std::norm(-r21 + (1 - R12) * r23 / (1.0 - r21 * r23));
  }
};

// What is seen under equal-energy light; fluctuation: of R - C0, to which C0 is added as white of Rec.709.
Color spectralTruth(const Interfaces& film, bool fluctuation) {
  Color xyz{};
  double luminance = 0;
  const double mean = fluctuation ? film.C0() : 0;
  for (double nm = 340; nm < 860; nm += 0.5) {
    const Color c = matching(nm);
    luminance += c[1];
    for (std::size_t k = 0; k < 3; ++k) xyz[k] += c[k] * (film.reflectanceAt(nm) - mean);
  }
  for (double& x : xyz) x /= luminance;
  Color rgb = toRec709(xyz);
  for (double& x : rgb) x = std::clamp(x + mean, 0.0, 1.0);
  return rgb;
}

// KHR_materials_iridescence as it is printed, with the guards of Khronos' sample viewer.
Color sensitivityAsPrinted(double opd, const Color& shift) {
  const double phase = 2 * pi * opd * 1e-9;
  const double val[] = {5.4856e-13, 4.4201e-13, 5.2481e-13}, pos[] = {1.6810e+06, 1.7953e+06, 2.2084e+06},
               var[] = {4.3278e+09, 9.3046e+09, 6.6121e+09};
  Color xyz;
  for (std::size_t k = 0; k < 3; ++k)
    xyz[k] = val[k] * std::sqrt(2 * pi * var[k]) * std::cos(pos[k] * phase + shift[k]) * std::exp(-sqr(phase) * var[k]);
  xyz[0] += 9.7470e-14 * std::sqrt(2 * pi * 4.5282e+09) * std::cos(2.2399e+06 * phase + shift[0]) *
            std::exp(-4.5282e+09 * sqr(phase));
  for (double& x : xyz) x /= 1.0685e-7;
  return xyz;
}
Color filmAsPrinted(double ior, double nm, const Color& F0, double cosine) {
  Color F, C, r, S[2];
  for (std::size_t k = 0; k < 3; ++k) {
    const Interfaces film(ior, nm, std::min(F0[k], 0.9999), cosine);
    const double R123 = std::clamp(film.R12 * film.R23, 1e-5, 0.9999), T = 1 - film.R12;
    const double Rs = sqr(T) * film.R23 / (1 - R123);
    F[k] = film.R12 + Rs;
    C[k] = Rs - T;
    r[k] = std::sqrt(R123);
    for (int m = 1; m <= 2; ++m) S[m - 1][k] = m * (film.phase21 + film.phase23);
  }
  for (int m = 1; m <= 2; ++m) {
    const Color color = toRec709(sensitivityAsPrinted(m * Interfaces(ior, nm, 0, cosine).opd, S[m - 1]));
    for (std::size_t k = 0; k < 3; ++k) F[k] += (C[k] *= r[k]) * 2 * color[k];
  }
  for (double& x : F) x = std::clamp(x, 0.0, 1.0);
  return F;
}

const double kIors[] = {1.1, 1.3, 1.5, 1.8, 2.5};
const double kThicknesses[] = {30, 100, 250, 400, 700, 1200};
const double kF0s[] = {0.02, 0.04, 0.2, 0.6, 0.95};
const double kCosines[] = {0.02, 0.1, 0.3, 0.6, 0.85, 1};

TEST(ThinFilm, SensitivityHasThePublishedConstants) {
  double worst = 0;
  for (double opd = 0; opd < 6000; opd += 37)
    for (const double turns : {0.0, 0.5, 1.0}) {
      const Color fit = toColor(f64::filmSensitivity(opd * 1e-3, {turns, turns, turns}));
      worst = std::max(worst, worstOf(fit, sensitivityAsPrinted(opd, grey(2 * pi * turns))));
    }
  EXPECT_LT(worst, 2e-6);
}

TEST(ThinFilm, IsThePublishedFormulaFrom30NmOn) {
  double worst = 0;
  for (const double ior : kIors)
    for (const double nm : kThicknesses)
      for (const Color& F0 : {grey(0.02), grey(0.04), grey(0.6), Color{0.95, 0.64, 0.54}, Color{0.03, 0.1, 0.9}})
        for (const double cosine : kCosines) {
          const Interfaces film(ior, nm, F0[0], cosine);
          if (film.R12 * film.R23 < 1e-5) continue; // its guard acts
          worst = std::max(worst, worstOf(filmAt(ior, nm, F0, cosine), filmAsPrinted(ior, nm, F0, cosine)));
        }
  EXPECT_LT(worst, 1e-5);
}

// Two orders and Gaussian fits against Airy's whole sum over the spectrum, docs/shading.md 12. The more both interfaces
// reflect, the more orders there are: at grazing angles over metals two are too few. balanced: against the spectrum's
// colour where equal-energy light is white, which the formula has for its mean but not for its oscillation.
TEST(ThinFilm, IsNearAirysSumOverTheSpectrum) {
  struct Errors {
    double squares = 0, worst = 0, balanced = 0;
    int count = 0;
  } steep, grazing;
  const Color white = toRec709({1, 1, 1}); // of equal energy
  for (const double ior : {1.3, 1.5, 1.8})
    for (const double nm : kThicknesses)
      for (const double F0 : kF0s)
        for (const double cosine : kCosines) {
          const Interfaces film(ior, nm, F0, cosine);
          const Color fit = filmAt(ior, nm, grey(F0), cosine);
          const double error = worstOf(fit, spectralTruth(film, true));
          Color whitened = spectralTruth(film, false);
          for (std::size_t c = 0; c < 3; ++c) whitened[c] = std::min(whitened[c] / white[c], 1.0);
          Errors& errors = cosine >= 0.3 ? steep : grazing;
          errors.worst = std::max(errors.worst, error);
          errors.balanced = std::max(errors.balanced, worstOf(fit, whitened));
          errors.squares += sqr(error);
          ++errors.count;
        }
  for (const Errors* e : {&steep, &grazing})
    std::printf("thin film against Airy, %s: rms %.4f, max %.4f; with white balance %.4f\n",
                e == &steep ? "cosine from .3 on" : "below", std::sqrt(e->squares / e->count), e->worst, e->balanced);
  EXPECT_LT(std::sqrt(steep.squares / steep.count), 0.02);
  EXPECT_LT(steep.worst, 0.08);
  EXPECT_LT(steep.balanced, 0.2);
  EXPECT_LT(std::sqrt(grazing.squares / grazing.count), 0.1);
  EXPECT_LT(grazing.worst, 0.6);
}

TEST(ThinFilm, WithoutThicknessItIsTheBase) {
  for (const double ior : {1.0, 1.3, 2.5})
    for (const double cosine : {0.0, 0.1, 0.5, 1.0}) {
      const Color F0{0.04, 0.5, 1}, F = filmAt(ior, 0, F0, cosine);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(F[c], schlick(F0[c], cosine), 1e-12);
      const Color thin = filmAt(ior, 0.1, F0, cosine);
      EXPECT_LT(worstOf(thin, F), cosine > 0 ? 0.01 : 0.15) << "no step at 0";
    }
}

// Schlick's curve gives even such an interface a reflection at grazing, in the text as here.
TEST(ThinFilm, OfIndexOneItIsTheBaseFromAbove) {
  for (const double nm : {0.0, 50.0, 400.0}) {
    EXPECT_NEAR(filmAt(1, nm, grey(0.3), 1)[1], 0.3, 1e-12);
    EXPECT_NEAR(filmAt(1, nm, grey(0.3), 0.8)[1], schlick(0.3, 0.8), 0.03);
  }
}

TEST(ThinFilm, OverAWholeMirrorReflectsAll) {
  for (const double ior : kIors)
    for (const double nm : kThicknesses)
      for (const double cosine : kCosines) EXPECT_LT(worstOf(filmAt(ior, nm, grey(1), cosine), grey(1)), 1e-12);
}

TEST(ThinFilm, TotalReflectionIsWhole) {
  EXPECT_EQ(filmAt(0.8, 400, grey(0.04), 0.3), grey(1));
  EXPECT_NE(filmAt(0.8, 400, grey(0.04), 0.9), grey(1));
}

TEST(ThinFilm, AThickFilmHasNoColour) {
  const Color F = filmAt(1.5, 60000, grey(0.2), 0.8);
  EXPECT_NEAR(F[0], Interfaces(1.5, 60000, 0.2, 0.8).C0(), 1e-12);
  EXPECT_EQ(F[0], F[2]);
}

TEST(ThinFilm, ShareMixesExactly) {
  const f64::real3 bare(0.1, 0.2, 0.3), film(0.7, 0.8, 0.9);
  EXPECT_EQ(f64::iridescentFresnel(bare, film, 0).y, 0.2);
  EXPECT_EQ(f64::iridescentFresnel(bare, film, 1).z, 0.9);
  EXPECT_DOUBLE_EQ(f64::iridescentFresnel(bare, film, 0.25).x, 0.25);
}

TEST(ThinFilm, CosineOfTurnsReducesItsArgument) {
  for (const double x : {-3.3, 0.0, 0.2, 0.5, 17.75, 1000.1}) {
    EXPECT_NEAR(f64::cosOfTurns(x), std::cos(2 * pi * x), 1e-12);
    EXPECT_NEAR(float(f16::cosOfTurns(Half(x))), std::cos(2 * pi * double(float(Half(x)))), 2e-3);
  }
}

// Finite and in [0, 1] in every precision, with and without denormals.
#define PARITY_EXPECT_FILM_SOUND(space, Real)                                                                          \
  for (const double ior : {0.5, 0.9, 1.0, 1.001, 1.3, 2.0, 3.0})                                                       \
    for (const double nm : {0.0, 1e-5, 0.1, 1.0, 10.0, 29.0, 30.0, 100.0, 400.0, 1200.0, 9000.0, 65504.0})             \
      for (const double F0 : {0.0, 1e-7, 1e-4, 0.02, 0.04, 0.3, 0.9, 0.9995, 1.0})                                     \
        for (const double cosine : {0.0, 1e-7, 1e-4, 0.01, 0.1, 0.5, 0.9, 0.9995, 1.0}) {                              \
          const shading::Vec3<Real> base(Real(F0), Real(1 - F0), Real(0.04));                                          \
          const auto F = shading::space::thinFilmFresnel(Real(ior), Real(nm), base, Real(cosine));                     \
          for (const double x : {double(F.x), double(F.y), double(F.z)})                                               \
            ASSERT_TRUE(x >= 0 && x <= 1)                                                                              \
                << #space << ": " << x << " of " << ior << ", " << nm << " nm, F0 " << F0 << ", cosine " << cosine;    \
        }

TEST(ThinFilm, IsSoundOverItsWholeDomainInEveryPrecision){
    PARITY_EXPECT_FILM_SOUND(f64, double) PARITY_EXPECT_FILM_SOUND(f32, float) PARITY_EXPECT_FILM_SOUND(f16, Half)
        PARITY_EXPECT_FILM_SOUND(flushedFilm, FlushedHalf)}

// What single and half precision cost, as a result, up to 1200 nm.
TEST(ThinFilm, LosesLittleInHalf) {
  double half = 0, squares = 0, single = 0;
  int count = 0;
  for (const double ior : {1.2, 1.3, 1.5, 2.0})
    for (int t = 0; t <= 48; ++t)
      for (const double F0 : {0.04, 0.3, 0.9})
        for (int i = 0; i <= 32; ++i) {
          const Half n(ior), nm(25.0 * t), base(F0), cosine(i / 32.0);
          const Color exact = filmAt(float(n), float(nm), grey(float(base)), float(cosine));
          const auto F = f16::thinFilmFresnel(n, nm, {base, base, base}, cosine);
          const auto S = f32::thinFilmFresnel(n, nm, {base, base, base}, cosine);
          const double error = worstOf({float(F.x), float(F.y), float(F.z)}, exact);
          half = std::max(half, error);
          single = std::max(single, worstOf({S.x, S.y, S.z}, exact));
          squares += sqr(error);
          ++count;
        }
  std::printf("thin film against f64: half rms %.4f, max %.4f; single max %.1e\n", std::sqrt(squares / count), half,
              single);
  EXPECT_LT(half, 0.05);
  EXPECT_LT(single, 1e-5);
}

} // namespace
} // namespace parity::tests

// A clear sky with sun and ground (Preetham, Shirley and Smits 1999).
#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "base/parallel.h"
#include "scenes/builtin/procedural_environment.h"

namespace parity::scenes {
namespace {

// F(theta, gamma) = (1 + A e^(B / cos theta)) (1 + C e^(D gamma) + E cos^2 gamma) (Perez et al. 1993).
struct Perez {
  double a, b, c, d, e;

  double operator()(double theta, double gamma) const {
    const double up = std::max(std::cos(theta), 0.01); // at the horizon B / cos theta has no bound
    const double cosGamma = std::cos(gamma);
    return (1 + a * std::exp(b / up)) * (1 + c * std::exp(d * gamma) + e * cosGamma * cosGamma);
  }
};

// Preetham et al. 1999, A.2: the distributions of luminance and chromaticity by turbidity.
Perez luminanceCoefficients(double t) {
  return {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
}
Perez chromaXOf(double t) {
  return {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
}
Perez chromaYOf(double t) {
  return {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
}

// A.2: chromaticity of the zenith, cubic in the sun's angle, quadratic in turbidity.
double zenith(const double (&m)[3][4], double turbidity, double thetaSun) {
  double sum = 0;
  const double turbidities[3] = {turbidity * turbidity, turbidity, 1};
  for (int row = 0; row < 3; ++row)
    sum += turbidities[row] * (((m[row][0] * thetaSun + m[row][1]) * thetaSun + m[row][2]) * thetaSun + m[row][3]);
  return sum;
}
constexpr double kZenithX[3][4] = {
    {0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}};
constexpr double kZenithY[3][4] = {
    {0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}};

// CIE xyY to linear Rec.709 (IEC 61966-2-1 matrix); what lies outside of the gamut is clamped.
glm::dvec3 rgbFromXyY(double x, double y, double luminance) {
  const double bigX = x / y * luminance, bigZ = (1 - x - y) / y * luminance;
  return glm::max(glm::dvec3(3.2406 * bigX - 1.5372 * luminance - 0.4986 * bigZ,
                             -0.9689 * bigX + 1.8758 * luminance + 0.0415 * bigZ,
                             0.0557 * bigX - 0.2040 * luminance + 1.0570 * bigZ),
                  0.0);
}

double luma(const glm::dvec3& rgb) { return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)); }

} // namespace

glm::dvec3 directionAt(double u, double v) {
  const double phi = (u - 0.5) * glm::two_pi<double>(), theta = v * glm::pi<double>();
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

double perezLuminance(double turbidity, double theta, double gamma, double thetaSun) {
  const Perez perez = luminanceCoefficients(turbidity);
  return perez(theta, gamma) / perez(0, thetaSun);
}

Environment makeSky(const SkyOptions& options) {
  const double t = options.turbidity, thetaSun = glm::radians(90 - options.sunElevationDeg);
  const double azimuth = glm::radians(options.sunAzimuthDeg);
  const glm::dvec3 sun(std::sin(thetaSun) * std::cos(azimuth), std::cos(thetaSun),
                       std::sin(thetaSun) * std::sin(azimuth));
  const Perez chromaX = chromaXOf(t), chromaY = chromaYOf(t);
  const double zenithX = zenith(kZenithX, t, thetaSun), zenithY = zenith(kZenithY, t, thetaSun);
  const auto skyAt = [&](const glm::dvec3& d) {
    const double theta = std::acos(std::clamp(d.y, 0.0, 1.0));
    const double gamma = std::acos(std::clamp(glm::dot(d, sun), -1.0, 1.0));
    return rgbFromXyY(zenithX * chromaX(theta, gamma) / chromaX(0, thetaSun),
                      zenithY * chromaY(theta, gamma) / chromaY(0, thetaSun),
                      perezLuminance(t, theta, gamma, thetaSun));
  };
  // Full radiance within 3/4 of the radius, none beyond 5/4: the same energy as a hard disc, to a percent.
  const double radius = glm::radians(options.sunRadiusDeg);
  const glm::dvec3 sunTint(1.04, 1.0, 0.86); // about 5300 K
  const double sunRadiance = options.sunIrradiance / (glm::two_pi<double>() * (1 - std::cos(radius)));
  const auto sunAt = [&](const glm::dvec3& d) {
    const double gamma = std::acos(std::clamp(glm::dot(d, sun), -1.0, 1.0));
    return sunTint * (sunRadiance * (1 - glm::smoothstep(0.75 * radius, 1.25 * radius, gamma)));
  };

  // The sky's irradiance on a level surface, by the midpoint rule over the map's own upper half.
  const int width = kProceduralWidth, height = kProceduralHeight;
  const auto directionOf = [&](int x, int y) { return directionAt((x + 0.5) / width, (y + 0.5) / height); };
  glm::dvec3 irradiance(0);
  for (int y = 0; y < height / 2; ++y) {
    const double solidAngle =
        glm::two_pi<double>() / width * glm::pi<double>() / height * std::sin(glm::pi<double>() * (y + 0.5) / height);
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 d = directionOf(x, y);
      irradiance += skyAt(d) * d.y * solidAngle;
    }
  }
  const double scale = options.skyIrradiance / luma(irradiance);
  const glm::dvec3 groundTint(1.08, 1.0, 0.88);
  const glm::dvec3 ground = groundTint * options.groundAlbedo *
                            (irradiance * scale + sunTint * options.sunIrradiance * std::max(sun.y, 0.0)) /
                            glm::pi<double>();

  Environment environment;
  environment.name = "sky";
  environment.radiance = base::Image(width, height, 3);
  base::parallelFor(static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x) {
        const glm::dvec3 d = directionOf(x, y);
        const double above = glm::smoothstep(-0.02, 0.005, d.y); // haze softens the horizon
        const glm::dvec3 color = glm::mix(ground, skyAt(d) * scale, above) + (d.y > 0 ? sunAt(d) : glm::dvec3(0));
        for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(color[c]);
      }
  });
  return environment;
}

} // namespace parity::scenes

#include "external/transfer.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace parity::external {

namespace {

double toSrgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }
double fromSrgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

glm::dvec3 vec(const Rgb& c) { return {c[0], c[1], c[2]}; }
Rgb rgb(const glm::dvec3& c) { return {c.x, c.y, c.z}; }
glm::dvec3 clip(const glm::dvec3& c) { return glm::clamp(c, 0.0, 1.0); }

// The x in [low, high] at which a function that grows is y.
template <typename F> double solve(const F& f, double y, double low, double high) {
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < y ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// ---- ACES as three.js has it: columns as in the shader.
const glm::dmat3 kAcesIn{0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777};
const glm::dmat3 kAcesOut{1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602};
constexpr double kAcesExposure = 1 / 0.6;

double acesFit(double v) { return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081); }

glm::dvec3 acesForward(const glm::dvec3& c) {
  const glm::dvec3 in = kAcesIn * (c * kAcesExposure);
  return clip(kAcesOut * glm::dvec3(acesFit(in.x), acesFit(in.y), acesFit(in.z)));
}

glm::dvec3 acesBack(const glm::dvec3& v) {
  constexpr double kMost = 1e4; // of light: the curve ends at 1 / 0.983729
  const glm::dvec3 fitted = glm::inverse(kAcesOut) * v;
  glm::dvec3 in;
  for (int i = 0; i < 3; ++i) in[i] = solve(acesFit, fitted[i], 0, kMost);
  return glm::inverse(kAcesIn) * in / kAcesExposure;
}

// ---- AgX as three.js has it.
const glm::dmat3 kTo2020{0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956};
const glm::dmat3 kFrom2020{1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187};
const glm::dmat3 kInset{0.856627153315983,  0.137318972929847, 0.11189821299995,
                        0.0951212405381588, 0.761241990602591, 0.0767994186031903,
                        0.0482516061458583, 0.101439036467562, 0.811302368396859};
const glm::dmat3 kOutset{1.1271005818144368,    -0.1413297634984383,   -0.14132976349843826,
                         -0.11060664309660323,  1.157823702216272,     -0.11060664309660294,
                         -0.016493938717834573, -0.016493938717834257, 1.2519364065950405};
constexpr double kMinEv = -12.47393, kMaxEv = 4.026069;

double agxContrast(double x) {
  const double x2 = x * x, x4 = x2 * x2;
  return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
}

glm::dvec3 agxForward(const glm::dvec3& c) {
  glm::dvec3 x = glm::log2(glm::max(kInset * (kTo2020 * c), 1e-10));
  x = clip((x - kMinEv) / (kMaxEv - kMinEv));
  x = kOutset * glm::dvec3(agxContrast(x.x), agxContrast(x.y), agxContrast(x.z));
  return clip(kFrom2020 * glm::pow(glm::max(x, 0.0), glm::dvec3(2.2)));
}

glm::dvec3 agxBack(const glm::dvec3& v) {
  const glm::dvec3 out = glm::pow(glm::max(glm::inverse(kFrom2020) * v, 0.0), glm::dvec3(1 / 2.2));
  const glm::dvec3 curved = glm::inverse(kOutset) * out;
  glm::dvec3 x;
  for (int i = 0; i < 3; ++i) x[i] = std::exp2(solve(agxContrast, curved[i], 0, 1) * (kMaxEv - kMinEv) + kMinEv);
  return glm::inverse(kTo2020) * (glm::inverse(kInset) * x);
}

// ---- Khronos PBR Neutral, and its inverse as Khronos gives it.
constexpr double kNearOne = 1 - 1e-6; // where a curve that ends at 1 is cut
constexpr double kStart = 0.8 - 0.04, kDesaturation = 0.15;

glm::dvec3 neutralForward(glm::dvec3 c) {
  const double least = std::min({c.x, c.y, c.z});
  c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  const double peak = std::max({c.x, c.y, c.z});
  if (peak < kStart) return clip(c);
  const double d = 1 - kStart, newPeak = 1 - d * d / (peak + d - kStart);
  const double g = 1 - 1 / (kDesaturation * (peak - newPeak) + 1);
  return clip(glm::mix(c * (newPeak / peak), glm::dvec3(newPeak), g));
}

glm::dvec3 neutralBack(glm::dvec3 v) {
  const double peak = std::min(std::max({v.x, v.y, v.z}), kNearOne);
  if (peak > kStart) {
    const double d = 1 - kStart, oldPeak = d * d / (1 - peak) - d + kStart;
    const double g = 1 - 1 / (kDesaturation * (oldPeak - peak) + 1);
    v = (v - peak * g) / (1 - g) * (oldPeak / peak);
  }
  const double least = std::min({v.x, v.y, v.z});
  return v + (least < 0.04 ? std::sqrt(std::max(least, 0.0) / 6.25) - std::max(least, 0.0) : 0.04);
}

template <typename F> glm::dvec3 each(const glm::dvec3& c, const F& f) { return {f(c.x), f(c.y), f(c.z)}; }

} // namespace

Rgb encode(Transfer transfer, const Rgb& linear) {
  const glm::dvec3 c = vec(linear);
  switch (transfer) {
  case Transfer::linear:
    return linear;
  case Transfer::srgb:
    return rgb(each(clip(c), toSrgb));
  case Transfer::gamma22:
    return rgb(glm::pow(clip(c), glm::dvec3(1 / 2.2)));
  case Transfer::acesThree:
    return rgb(each(acesForward(c), toSrgb));
  case Transfer::agx:
    return rgb(each(agxForward(c), toSrgb));
  case Transfer::neutral:
    return rgb(each(neutralForward(c), toSrgb));
  case Transfer::reinhard:
    return rgb(each(c / (1.0 + c), toSrgb));
  }
  return linear;
}

Rgb decode(Transfer transfer, const Rgb& value) {
  const glm::dvec3 v = vec(value);
  switch (transfer) {
  case Transfer::linear:
    return value;
  case Transfer::srgb:
    return rgb(each(v, fromSrgb));
  case Transfer::gamma22:
    return rgb(glm::pow(v, glm::dvec3(2.2)));
  case Transfer::acesThree:
    return rgb(acesBack(each(v, fromSrgb)));
  case Transfer::agx:
    return rgb(agxBack(each(v, fromSrgb)));
  case Transfer::neutral:
    return rgb(neutralBack(each(v, fromSrgb)));
  case Transfer::reinhard:
    return rgb(each(v, [](double x) {
      const double y = std::min(fromSrgb(x), kNearOne);
      return y / (1 - y);
    }));
  }
  return value;
}

const char* nameOf(Transfer transfer) { return kTransferNames[static_cast<std::size_t>(transfer)]; }

std::optional<Transfer> findTransfer(std::string_view name) {
  const auto found = std::ranges::find(kTransferNames, name);
  if (found == kTransferNames.end()) return std::nullopt;
  return static_cast<Transfer>(found - kTransferNames.begin());
}

} // namespace parity::external

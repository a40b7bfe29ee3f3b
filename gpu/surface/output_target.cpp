#include "gpu/surface/output_target.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "shading/shading.h"

namespace parity::gpu {

namespace {

namespace f16 = shading::f16;
namespace f32 = shading::f32;
using shading::Half;

// The sRGB curve of 8-bit codes, IEC 61966-2-1: light of each code, and from which light on a code is the nearest.
struct SrgbCodes {
  std::array<float, 256> light;
  std::array<float, 255> least; // of codes 1..255
  SrgbCodes() {
    for (int code = 0; code < 256; ++code)
      light[static_cast<std::size_t>(code)] = static_cast<float>(shading::f64::srgbToLinear(code / 255.0));
    for (int code = 1; code < 256; ++code)
      least[static_cast<std::size_t>(code - 1)] = static_cast<float>(shading::f64::srgbToLinear((code - 0.5) / 255.0));
  }
};
const SrgbCodes& srgbCodes() {
  static const SrgbCodes codes;
  return codes;
}

// The light of the nearest code.
float roundToSrgb8(float light) {
  const SrgbCodes& codes = srgbCodes();
  const auto code = std::upper_bound(codes.least.begin(), codes.least.end(), light) - codes.least.begin();
  return codes.light[static_cast<std::size_t>(code)];
}

float roundToUnorm8(float value) { return std::floor(std::clamp(value, 0.f, 1.f) * 255 + 0.5f) / 255; }

// By its bits: a library's ldexp takes longer than all the rounding. exponent: of a normal float.
float powerOfTwo(int exponent) { return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23); }

// The nearest float of 5 exponent bits and this many mantissa bits. value: 0 or more; for NaN the result has no
// meaning.
float roundMagnitude(float value, int mantissaBits) {
  const float largest = powerOfTwo(16) - powerOfTwo(15 - mantissaBits);
  if (value < powerOfTwo(-14)) { // adding 2^23 of the smallest steps rounds to a whole number of them, ties to even
    const float shift = powerOfTwo(23 - 14 - mantissaBits);
    return (value + shift) - shift;
  }
  const int dropped = 23 - mantissaBits;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t even = bits >> dropped & 1u;
  const std::uint32_t rounded = (bits + (1u << (dropped - 1)) - 1 + even) & ~((1u << dropped) - 1);
  return std::min(std::bit_cast<float>(rounded), largest);
}

// Infinities become the largest half. For NaN the result has no meaning.
float roundToHalf(float value) { return std::copysign(roundMagnitude(std::min(std::abs(value), 65504.f), 10), value); }

glm::vec3 gamma2(const glm::vec3& c, bool half) {
  if (half) {
    const f16::real3 e = f16::encodeGamma2({Half(c.x), Half(c.y), Half(c.z)});
    return {e.x, e.y, e.z};
  }
  const f32::real3 e = f32::encodeGamma2({c.x, c.y, c.z});
  return {e.x, e.y, e.z};
}

// f's channels, but those of `value` that are not finite.
glm::vec3 keepNonFinite(const glm::vec3& value, glm::vec3 f) {
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(value[c])) f[c] = value[c];
  return f;
}

} // namespace

const std::vector<std::string>& outputTargetNames() {
  static const std::vector<std::string> names = {"rgba16f", "r11g11b10f", "rgba8-srgb", "rgba8-gamma2"};
  return names;
}

bool isDisplayed(OutputTarget target) {
  return target == OutputTarget::rgba8Srgb || target == OutputTarget::rgba8Gamma2;
}

float roundToUnsignedFloat(float value, int mantissaBits) {
  if (std::isnan(value)) return value;
  if (!(value > 0)) return 0;
  if (std::isinf(value)) return value;
  return roundMagnitude(value, mantissaBits);
}

TargetCodec::TargetCodec(OutputTarget target, float exposureEv, bool half)
    : m_target(target), m_gain(std::exp2(exposureEv)), m_half(half) {}

glm::vec3 TargetCodec::write(const glm::vec3& radiance) const {
  if (!isDisplayed()) {
    const f32::real3 kept = f32::saturateToHalf({radiance.x, radiance.y, radiance.z});
    return keepNonFinite(radiance, {kept.x, kept.y, kept.z});
  }
  const glm::vec3 exposed = radiance * m_gain;
  // A fixed-point target clamps before it blends (Vulkan 1.3, "Blending"); the shader's root clamps by itself.
  return keepNonFinite(exposed,
                       m_target == OutputTarget::rgba8Srgb ? glm::clamp(exposed, 0.f, 1.f) : gamma2(exposed, m_half));
}

glm::vec3 TargetCodec::store(const glm::vec3& value) const {
  glm::vec3 kept(0.f);
  switch (m_target) {
  case OutputTarget::rgba16f:
    kept = {roundToHalf(value.x), roundToHalf(value.y), roundToHalf(value.z)};
    break;
  case OutputTarget::r11g11b10f:
    kept = {roundToUnsignedFloat(value.x, 6), roundToUnsignedFloat(value.y, 6), roundToUnsignedFloat(value.z, 5)};
    break;
  case OutputTarget::rgba8Srgb:
    kept = {roundToSrgb8(value.x), roundToSrgb8(value.y), roundToSrgb8(value.z)};
    break;
  case OutputTarget::rgba8Gamma2:
    kept = {roundToUnorm8(value.x), roundToUnorm8(value.y), roundToUnorm8(value.z)};
    break;
  }
  return keepNonFinite(value, kept);
}

glm::vec3 TargetCodec::read(const glm::vec3& stored) const {
  if (!isDisplayed()) return stored;
  glm::vec3 light = stored;
  if (m_target == OutputTarget::rgba8Gamma2) // the screen takes the codes for sRGB
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(stored[c])) // others have no code
        light[c] = srgbCodes().light[static_cast<std::size_t>(std::lround(std::clamp(stored[c], 0.f, 1.f) * 255))];
  return keepNonFinite(stored, light / m_gain);
}

} // namespace parity::gpu

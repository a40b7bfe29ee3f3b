#include "lighting/environment/capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/parallel.h"
#include "lighting/environment/cube.h"
#include "shading/shading.h"

namespace parity::lighting {

namespace {

// texelOf: a texel of the cube to four numbers as they are stored.
template <typename Texel> Capture encode(const CubeMap& prefiltered, const Texel& texelOf) {
  using Stored = decltype(texelOf(glm::vec4()));
  Capture capture;
  capture.faceSize = prefiltered.faceSize;
  for (std::size_t m = 0; m < prefiltered.mips.size(); ++m) {
    const std::size_t count = texelIndex(kCubeFaces, 0, 0, prefiltered.faceSize >> m);
    std::vector<std::byte>& mip = capture.mips.emplace_back(count * sizeof(Stored));
    base::parallelFor(count, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Stored stored = texelOf(prefiltered.mips[m][i]);
        std::memcpy(mip.data() + i * sizeof stored, &stored, sizeof stored);
      }
    });
  }
  return capture;
}

// Vulkan 1.3 specification, "RGB to Shared Exponent Conversion": N = 9 bits, bias B = 15, codes times 2^(exponent - B -
// N); red in the lowest bits, the exponent in the highest.
std::uint32_t packRgb9e5(const glm::vec3& radiance) {
  const glm::vec3 color = glm::clamp(radiance, 0.f, 65408.f);
  int exponent = 0; // the largest is in [1/2, 1) times 2 to it
  std::frexp(std::max({color.x, color.y, color.z}), &exponent);
  exponent = std::max(exponent, -15);
  const auto codeOf = [&](float value) { return static_cast<std::uint32_t>(std::ldexp(value, 9 - exponent) + 0.5f); };
  if (std::max({codeOf(color.x), codeOf(color.y), codeOf(color.z)}) == 512) ++exponent; // rounded up to the next
  return codeOf(color.x) | codeOf(color.y) << 9 | codeOf(color.z) << 18 |
         static_cast<std::uint32_t>(exponent + 15) << 27;
}

} // namespace

Capture encodeRgbm(const CubeMap& prefiltered) {
  return encode(prefiltered, [](const glm::vec4& texel) {
    const shading::f32::Rgbm m = shading::f32::encodeRgbm({texel.x, texel.y, texel.z});
    const auto code = [](float value) { return static_cast<std::uint8_t>(value * 255 + 0.5f); };
    return std::array{code(m.r), code(m.g), code(m.b), code(m.a)};
  });
}

Capture encodeRgb9e5(const CubeMap& prefiltered) {
  return encode(prefiltered, [](const glm::vec4& texel) { return packRgb9e5(glm::vec3(texel)); });
}

Capture encodeHalf(const CubeMap& prefiltered) {
  return encode(prefiltered, [](const glm::vec4& texel) {
    const auto bits = [](float value) { return shading::Half(std::min(value, 65504.f)).bits(); };
    return std::array{bits(texel.x), bits(texel.y), bits(texel.z), bits(1)};
  });
}

} // namespace parity::lighting

#include "lighting/capture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "base/parallel.h"
#include "lighting/cube.h"
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

} // namespace

Capture encodeRgbm(const CubeMap& prefiltered) {
  return encode(prefiltered, [](const glm::vec4& texel) {
    const shading::f32::Rgbm m = shading::f32::encodeRgbm({texel.x, texel.y, texel.z});
    const auto code = [](float value) { return static_cast<std::uint8_t>(value * 255 + 0.5f); };
    return std::array{code(m.r), code(m.g), code(m.b), code(m.a)};
  });
}

Capture encodeHalf(const CubeMap& prefiltered) {
  return encode(prefiltered, [](const glm::vec4& texel) {
    const auto bits = [](float value) { return shading::Half(std::min(value, 65504.f)).bits(); };
    return std::array{bits(texel.x), bits(texel.y), bits(texel.z), bits(1)};
  });
}

} // namespace parity::lighting

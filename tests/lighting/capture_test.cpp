// The capture of the mobile path: texels in their places, and how close 8 and 16 bits are.
#include "lighting/capture.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::lighting {
namespace {

// Faces of 2 texels, then one of 1 with two layers; every texel and channel differs.
CubeMap makeCube() {
  CubeMap cube;
  cube.faceSize = 2;
  const auto texel = [](int i) {
    const auto x = static_cast<float>(i);
    return glm::vec4(0.25f + x, 20 + 3 * x, 0.5f + 0.125f * x, 1);
  };
  cube.mips.resize(2);
  for (int i = 0; i < 24; ++i) cube.mips[0].push_back(texel(i));
  for (int i = 0; i < 12; ++i) cube.mips[1].push_back(texel(40 + i));
  return cube;
}

TEST(Capture, holdsTheFirstLayerOfEachMipInTheCubesOrder) {
  const CubeMap cube = makeCube();
  const Capture rgbm = encodeRgbm(cube), half = encodeHalf(cube);
  ASSERT_EQ(rgbm.mips.size(), 2u);
  EXPECT_EQ(rgbm.mips[0].size(), 24u * 4);
  EXPECT_EQ(rgbm.mips[1].size(), 6u * 4) << "the second layer is left out";
  EXPECT_EQ(half.mips[1].size(), 6u * 8);
  for (int m = 0; m < 2; ++m)
    for (int i = 0; i < (m == 0 ? 24 : 6); ++i) {
      const glm::vec4& texel = cube.mips[static_cast<std::size_t>(m)][static_cast<std::size_t>(i)];
      std::uint8_t code[4];
      std::memcpy(code, rgbm.mips[static_cast<std::size_t>(m)].data() + 4 * i, 4);
      const auto value = [&](int c) { return static_cast<float>(code[c]) / 255; };
      const shading::f32::real3 L = shading::f32::decodeRgbm({value(0), value(1), value(2)}, value(3));
      // The smallest channel beside the largest has the fewest codes: sqrt(.5/90) of 255 is 19.
      EXPECT_NEAR(L.x, texel.x, 0.06f * texel.x);
      EXPECT_NEAR(L.y, texel.y, 0.01f * texel.y);
      EXPECT_NEAR(L.z, texel.z, 0.06f * texel.z);
      std::uint16_t bits[4];
      std::memcpy(bits, half.mips[static_cast<std::size_t>(m)].data() + 8 * i, 8);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(float(shading::Half::fromBits(bits[c])), texel[c], texel[c] * 0x1p-11f);
    }
}

TEST(Capture, saturatesWhereItsNumbersEnd) {
  CubeMap cube;
  cube.faceSize = 1;
  cube.mips = {std::vector<glm::vec4>(6, glm::vec4(1e6f, 0, 0, 1))};
  std::uint16_t bits[4];
  const Capture half = encodeHalf(cube), rgbm = encodeRgbm(cube);
  std::memcpy(bits, half.mips[0].data(), 8);
  EXPECT_EQ(float(shading::Half::fromBits(bits[0])), 65504);
  EXPECT_EQ(static_cast<int>(rgbm.mips[0][0]), 255);
  EXPECT_EQ(static_cast<int>(rgbm.mips[0][1]), 0);
  EXPECT_EQ(static_cast<int>(rgbm.mips[0][3]), 255);
}

} // namespace
} // namespace parity::lighting

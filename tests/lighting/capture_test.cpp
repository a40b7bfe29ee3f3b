// The capture of the mobile path: texels in their places, and how close 8 and 16 bits are.
#include "lighting/environment/capture.h"

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

TEST(Capture, HoldsTheFirstLayerOfEachMipInTheCubesOrder) {
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

// Three codes of 9 bits times 2^(exponent - 24): the largest channel to half a code of 256 at least, the others as
// exactly.
glm::dvec3 readRgb9e5(const Capture& capture, std::size_t mip, std::size_t texel) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, capture.mips[mip].data() + 4 * texel, 4);
  const double unit = std::pow(2.0, static_cast<double>(bits >> 27) - 24);
  return unit * glm::dvec3(bits & 511, bits >> 9 & 511, bits >> 18 & 511);
}

TEST(Capture, WithASharedExponentIsExactToHalfACode) {
  CubeMap cube = makeCube();
  const glm::vec3 special[] = {{0, 0, 0},     {0.99999f, 0.5f, 0}, {1, 0, 1e-3f},
                               {1e-7f, 0, 0}, {65408, 1, 0},       {0.25f, 300, 7}};
  for (std::size_t i = 0; i < std::size(special); ++i) cube.mips[0][i] = glm::vec4(special[i], 1);
  const Capture capture = encodeRgb9e5(cube);
  ASSERT_EQ(capture.mips[0].size(), 24u * 4);
  ASSERT_EQ(capture.mips[1].size(), 6u * 4);
  for (std::size_t m = 0; m < 2; ++m)
    for (std::size_t i = 0; i < (m == 0 ? 24u : 6u); ++i) {
      const glm::dvec3 texel(cube.mips[m][i]), held = readRgb9e5(capture, m, i);
      const double most = std::max({texel.x, texel.y, texel.z});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(held[c], texel[c], std::max(most / 512, 0x1p-25)) << m << " " << i;
    }
  EXPECT_EQ(readRgb9e5(capture, 0, 0), glm::dvec3(0));
  EXPECT_EQ(readRgb9e5(capture, 0, 1).x, 1) << "rounds up to the next exponent";
  cube.mips[0][0] = glm::vec4(1e30f, -1, 5e4f, 1);
  EXPECT_EQ(readRgb9e5(encodeRgb9e5(cube), 0, 0), glm::dvec3(65408, 0, 49920 + 128)) << "saturates";
}

TEST(Capture, SaturatesWhereItsNumbersEnd) {
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

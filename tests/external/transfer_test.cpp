// Tone curves and transfer functions of engines, against published values, and back.
#include "external/transfer.h"

#include <cmath>

#include <gtest/gtest.h>

namespace parity::external {
namespace {

double mostDifference(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

TEST(Transfer, NamesAreFound) {
  for (std::size_t i = 0; i < kTransferNames.size(); ++i) {
    ASSERT_TRUE(findTransfer(kTransferNames[i]));
    EXPECT_EQ(static_cast<std::size_t>(*findTransfer(kTransferNames[i])), i);
  }
  EXPECT_FALSE(findTransfer("sRGB"));
}

// IEC 61966-2-1's own examples, and the curves at points that can be computed by hand.
TEST(Transfer, ValuesAreThosePublished) {
  EXPECT_NEAR(encode(Transfer::srgb, {0.0031308, 0.214041, 1})[0], 0.04045, 1e-5);
  EXPECT_NEAR(encode(Transfer::srgb, {0.0031308, 0.214041, 1})[1], 0.5, 1e-5);
  EXPECT_NEAR(encode(Transfer::gamma22, {0.5, 0, 2})[0], std::pow(0.5, 1 / 2.2), 1e-12);
  EXPECT_EQ(encode(Transfer::gamma22, {0.5, 0, 2})[2], 1);
  EXPECT_NEAR(encode(Transfer::reinhard, {1, 1, 1})[0], encode(Transfer::srgb, {0.5, 0, 0})[0], 1e-12);
  // Khronos: colours up to 0.8 keep their hue and are lowered by F90's 0.04 alone.
  EXPECT_NEAR(decode(Transfer::srgb, encode(Transfer::neutral, {0.5, 0.5, 0.5}))[0], 0.46, 1e-9);
  // AgX: middle grey stays near middle grey; white is far away.
  EXPECT_NEAR(decode(Transfer::srgb, encode(Transfer::agx, {0.18, 0.18, 0.18}))[0], 0.2, 0.04);
  EXPECT_LT(encode(Transfer::agx, {1, 1, 1})[0], 0.85);
  // Hill's fit of a grey of exposure 1/0.6 by hand: v = 1/0.6 (1 / 0.6 of the matrix rows, which sum to 1).
  const double v = 1 / 0.6, fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  EXPECT_NEAR(decode(Transfer::srgb, encode(Transfer::acesThree, {1, 1, 1}))[0], fit, 2e-3);
}

TEST(Transfer, GreyStaysGreyAndCurvesGrow) {
  for (const char* name : kTransferNames) {
    double last = -1;
    for (const double grey : {0.001, 0.01, 0.1, 0.18, 0.5, 0.9}) {
      const Rgb value = encode(*findTransfer(name), {grey, grey, grey});
      EXPECT_LT(mostDifference(value, {value[0], value[0], value[0]}), 2e-3) << name << " " << grey;
      EXPECT_GT(value[0], last) << name << " " << grey;
      last = value[0];
    }
  }
}

TEST(Transfer, DecodingTurnsEncodingBack) {
  for (const char* name : kTransferNames) {
    const Transfer transfer = *findTransfer(name);
    for (const Rgb& light : {Rgb{0.18, 0.18, 0.18}, Rgb{0.6, 0.2, 0.05}, Rgb{0.02, 0.3, 0.7}, Rgb{0.004, 0.01, 0.002},
                             Rgb{0.9, 0.85, 0.8}})
      EXPECT_LT(mostDifference(decode(transfer, encode(transfer, light)), light), 4e-3) << name << " " << light[0];
  }
  for (const Transfer transfer : {Transfer::acesThree, Transfer::neutral, Transfer::reinhard, Transfer::agx})
    EXPECT_NEAR(decode(transfer, encode(transfer, {3, 3, 3}))[0], 3, 0.05)
        << kTransferNames[static_cast<std::size_t>(transfer)] << ": light above white";
}

} // namespace
} // namespace parity::external

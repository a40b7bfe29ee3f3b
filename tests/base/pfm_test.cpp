// Portable float maps: the layout in the file, both byte orders, and what is refused.
#include "base/image/pfm.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "expect_error.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

std::string floatBytes(std::initializer_list<float> values, bool bigEndian = false) {
  std::string bytes;
  for (const float value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (bigEndian) one.assign(one.rbegin(), one.rend());
    bytes += one;
  }
  return bytes;
}

Image readText(const TempFolder& folder, const std::string& content) {
  writeText(folder / "a.pfm", content);
  return readPfm(folder / "a.pfm");
}

TEST(Pfm, StoresTheBottomRowFirst) {
  const TempFolder folder;
  Image image(1, 2, 1);
  image.at(0, 0)[0] = 1; // top
  image.at(0, 1)[0] = 2;
  writePfm(folder / "a.pfm", image);
  EXPECT_EQ(parity::base::readText(folder / "a.pfm"), "Pf\n1 2\n-1.0\n" + floatBytes({2, 1}));
}

TEST(Pfm, ComesBackBitForBit) {
  const TempFolder folder;
  for (const int channels : {1, 3}) {
    Image image(5, 3, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(std::sin(i)) * 1e6f;
    image.pixels[0] = -0.0f;
    image.pixels[1] = std::numeric_limits<float>::infinity();
    writeImage(folder / "a.pfm", image);
    EXPECT_EQ(readPfm(folder / "a.pfm"), image);
    EXPECT_EQ(readImage(folder / "a.pfm"), image);
    EXPECT_FALSE(isIntegerImage(folder / "a.pfm"));
  }
}

TEST(Pfm, ReadsEitherByteOrderAndAnyWhiteSpace) {
  const TempFolder folder;
  Image expected(2, 1, 1);
  expected.pixels = {1.5f, -2};
  EXPECT_EQ(readText(folder, "Pf 2 1 1.0\n" + floatBytes({1.5f, -2}, true)), expected);
  EXPECT_EQ(readText(folder, "Pf\n2\n1\n-2.5 " + floatBytes({1.5f, -2})), expected);
  EXPECT_EQ(readText(folder, "PF\r\n1 1\r\n-1.000000\n" + floatBytes({1, 2, 3})).channels, 3);
}

TEST(Pfm, TakesDataThatLookLikeWhiteSpaceForData) {
  const TempFolder folder;
  EXPECT_EQ(readText(folder, "Pf 1 1 -1\n" + std::string("\n\n  ")).pixels.size(), 1u);
}

TEST(Pfm, RefusesWhatItCannotHold) {
  const TempFolder folder;
  expectError([&] { writePfm(folder / "a.pfm", Image(2, 2, 2)); }, "a.pfm", "1 or 3 channels");
  expectError([&] { writePfm(folder / "a.pfm", Image()); }, "a.pfm", "has no pixels");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(Pfm, RefusesDamage) {
  const TempFolder folder;
  const auto refuses = [&](const std::string& content, const std::string& reason) {
    expectError([&] { readText(folder, content); }, (folder / "a.pfm").string(), reason);
  };
  refuses("", "must begin with PF or Pf");
  refuses("P6\n1 1\n255\nabc", "must begin with PF or Pf");
  refuses("PFx 1 1 -1\n" + floatBytes({1, 2, 3}), "must begin with PF or Pf");
  refuses("Pf\n1", "no width, height and scale");
  refuses("Pf\n1 1\n-1", "no width, height and scale");
  refuses("Pf\n1 1\n0\n" + floatBytes({1}), "no width, height and scale");
  refuses("Pf\none 1\n-1\n" + floatBytes({1}), "no width, height and scale");
  refuses("Pf\n99999999999 1\n-1\n" + floatBytes({1}), "no width, height and scale");
  refuses("Pf\n0 5\n-1\n", "has no pixels");
  refuses("Pf\n-3 5\n-1\n", "has no pixels");
  refuses("Pf\n100000 1\n-1\n", "largest allowed side");
  refuses("Pf\n16384 16384\n-1\n" + floatBytes({1}), "truncated");
  refuses("Pf\n2 1\n-1\n" + floatBytes({1}), "truncated");
  refuses("Pf\n1 1\n-1\n" + floatBytes({1, 2}), "pixels need");
}

} // namespace
} // namespace parity::base

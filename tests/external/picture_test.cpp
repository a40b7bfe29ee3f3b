// Pictures of other engines: what is read, and what is refused in words.
#include "external/picture.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image/image_io.h"
#include "base/temp_folder.h"
#include "support/exr_primaries.h"

namespace parity::external {
namespace {

class PictureTest : public testing::Test {
protected:
  std::string path(const std::string& name) const { return (m_folder / name).string(); }
  void write8(const std::string& name, int width, int height, int channels, std::uint8_t value) const {
    base::writeImage8(path(name), base::Image8(width, height, channels, value));
  }
  std::string refusal(const std::string& name, Transfer transfer = Transfer::srgb, int code = 3) const {
    try {
      readPicture(path(name), 8, 8, transfer);
    } catch (const base::Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), code) << error.what();
      return error.what();
    }
    return "taken";
  }
  const base::TempFolder m_folder;
};

TEST_F(PictureTest, ValuesBecomeLight) {
  write8("a.png", 8, 8, 3, 188);
  const Picture picture = readPicture(path("a.png"), 8, 8, Transfer::srgb);
  EXPECT_NEAR(picture.light.pixels[0], std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
  EXPECT_TRUE(picture.alpha.empty());
  EXPECT_EQ(picture.clipped[5], 0);
  write8("white.png", 8, 8, 3, 255);
  EXPECT_EQ(readPicture(path("white.png"), 8, 8, Transfer::srgb).clipped[0], 1);
  base::writeImage(path("a.exr"), base::Image(8, 8, 3, 2.5f));
  EXPECT_EQ(readPicture(path("a.exr"), 8, 8, Transfer::linear).light.pixels[0], 2.5f);
}

TEST_F(PictureTest, AlphaIsKeptApart) {
  write8("a.png", 8, 8, 4, 128);
  const Picture picture = readPicture(path("a.png"), 8, 8, Transfer::srgb);
  ASSERT_FALSE(picture.alpha.empty());
  EXPECT_NEAR(picture.alpha.pixels[3], 128 / 255.0, 1e-6);
}

TEST_F(PictureTest, NanStaysNan) {
  base::Image image(8, 8, 3, 0.5f);
  image.pixels[10] = NAN;
  base::writeImage(path("nan.exr"), image);
  EXPECT_TRUE(std::isnan(readPicture(path("nan.exr"), 8, 8, Transfer::linear).light.pixels[10]));
}

TEST_F(PictureTest, WhatCannotBeComparedIsRefusedInWords) {
  write8("large.png", 16, 8, 3, 100);
  EXPECT_EQ(refusal("large.png"), path("large.png") + ": is 16 x 8 pixels; the view is 8 x 8");
  write8("grey.png", 8, 8, 1, 100);
  EXPECT_NE(refusal("grey.png").find("is grey"), std::string::npos);
  base::writeImage(path("float.exr"), base::Image(8, 8, 3, 0.5f));
  EXPECT_NE(refusal("float.exr").find("holds floats, which are linear light; its transfer is 'srgb'"),
            std::string::npos);
  EXPECT_EQ(refusal("float.exr", Transfer::linear), "taken");
  EXPECT_NE(refusal("none.png", Transfer::srgb, 4).find("none.png"), std::string::npos);
  const std::vector<std::byte> whole = base::readFile(path("large.png"));
  base::writeBytes(path("cut.png"),
                   std::vector<std::byte>(whole.begin(), whole.begin() + static_cast<long>(whole.size() / 2)));
  EXPECT_NE(refusal("cut.png", Transfer::srgb, 4), "taken");
}

// A TIFF 6.0 file of `pages` 8-bit images of 8 x 8 in colour, little-endian, uncompressed.
std::string makeTiff(int pages, std::uint32_t orientation) {
  constexpr std::uint32_t kPixels = 8 * 8 * 3, kHead = 8, kTags = 10, kPage = 2 + 12 * kTags + 4 + 6 + kPixels;
  std::string bytes("II*\0", 4);
  const auto append = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  };
  append(kHead, 4);
  for (int page = 0; page < pages; ++page) {
    const std::uint32_t start = kHead + static_cast<std::uint32_t>(page) * kPage, bits = start + kPage - kPixels - 6;
    append(kTags, 2);
    const auto tag = [&](std::uint32_t name, std::uint32_t value, std::uint32_t count = 1, std::uint32_t type = 4) {
      append(name, 2), append(type, 2), append(count, 4), append(value, 4);
    };
    tag(256, 8), tag(257, 8), tag(258, bits, 3, 3), tag(259, 1), tag(262, 2); // size, bits, raw, RGB
    tag(273, bits + 6), tag(274, orientation), tag(277, 3), tag(278, 8), tag(279, kPixels);
    append(page + 1 < pages ? start + kPage : 0, 4);
    for (int i = 0; i < 3; ++i) append(8, 2);
    bytes.append(kPixels, 'x');
  }
  return bytes;
}

TEST_F(PictureTest, NoPartNoTurnedOneAndNoneOfSeveralIsTaken) {
  base::writeText(path("one.tif"), makeTiff(1, 1));
  EXPECT_EQ(refusal("one.tif"), "taken");
  base::writeText(path("turned.tif"), makeTiff(1, 6));
  EXPECT_NE(refusal("turned.tif").find("is turned by its EXIF orientation"), std::string::npos);
  base::writeText(path("two.tif"), makeTiff(2, 1));
  EXPECT_NE(refusal("two.tif").find("holds several pictures"), std::string::npos);

  base::writeImage(path("a.exr"), base::Image(8, 8, 3, 0.5f));
  std::string part = base::readText(path("a.exr"));
  const std::string window("displayWindow\0box2i\0", 20); // then its size and xMin, yMin, xMax, yMax
  part[part.find(window) + window.size() + 4 + 8] = 20;
  base::writeText(path("part.exr"), part);
  EXPECT_NE(refusal("part.exr", Transfer::linear).find("holds a part of a picture only"), std::string::npos);
}

TEST_F(PictureTest, OtherPrimariesAreRefused) {
  base::writeImage(path("a.exr"), base::Image(8, 8, 3, 0.5f));
  base::writeText(path("wide.exr"),
                  tests::withPrimaries(base::readText(path("a.exr")), // Rec.2020
                                       {0.708f, 0.292f, 0.17f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.329f}));
  EXPECT_NE(refusal("wide.exr", Transfer::linear).find("has other primaries than Rec.709"), std::string::npos);
}

TEST_F(PictureTest, ValuesOfACalibrationAreFinite) {
  base::Image image(8, 8, 3, 0.5f);
  image.pixels[7] = NAN;
  base::writeImage(path("nan.exr"), image);
  EXPECT_THROW(readValues(path("nan.exr")), base::Error);
  write8("grey.png", 8, 8, 1, 100);
  EXPECT_THROW(readValues(path("grey.png")), base::Error);
}

} // namespace
} // namespace parity::external

// Pictures of other engines: what is read, and what is refused in words.
#include "external/picture.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "base/image/image_io.h"
#include "base/temp_folder.h"

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

} // namespace
} // namespace parity::external

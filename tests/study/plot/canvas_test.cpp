// Boxes, lines and letters land where they are told to, and nowhere else.
#include "study/plot/canvas.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "study/plot/color_scale.h"

namespace parity::plot {
namespace {

constexpr Rgb kWhite{255, 255, 255}, kBlack{0, 0, 0};

struct Box {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
// Of all that is not white.
Box inkOf(const Canvas& canvas) {
  Box box;
  for (int y = 0; y < canvas.image().height; ++y)
    for (int x = 0; x < canvas.image().width; ++x)
      if (canvas.image().at(x, y)[0] != 255) {
        box.left = std::min(box.left, x);
        box.right = std::max(box.right, x);
        box.top = std::min(box.top, y);
        box.bottom = std::max(box.bottom, y);
      }
  return box;
}

TEST(Canvas, LettersStandOnTheirLineAndAreAsWideAsIsSaid) {
  for (const Align align : {Align::left, Align::middle, Align::right}) {
    Canvas canvas(200, 60, kWhite);
    canvas.text(100, 40, "HxH", Font::body, kBlack, align);
    const Box ink = inkOf(canvas);
    const double width = Canvas::widthOf("HxH", Font::body);
    const double left = align == Align::left ? 100 : align == Align::middle ? 100 - width / 2 : 100 - width;
    EXPECT_EQ(ink.bottom, 39) << "they stand on the line";
    EXPECT_NEAR(ink.top, 40 - 13, 2) << "capitals of 18 pixels";
    EXPECT_GE(ink.left, left - 1);
    EXPECT_LE(ink.right, left + width + 1);
    EXPECT_GT(ink.right - ink.left, 0.8 * width);
  }
}

TEST(Canvas, UpwardsIsTheSameTurned) {
  Canvas flat(80, 80, kWhite), turned(80, 80, kWhite);
  flat.text(10, 40, "roughness", Font::small, kBlack, Align::left);
  turned.textUpwards(40, 70, "roughness", Font::small, kBlack, Align::left);
  for (int y = 0; y < 80; ++y)
    for (int x = 10; x < 80; ++x) ASSERT_EQ(flat.image().at(x, y)[0], turned.image().at(y, 80 - x)[0]) << x << " " << y;
}

TEST(Canvas, LinesAreAsLongAndThickAsAskedFor) {
  Canvas canvas(60, 60, kWhite);
  canvas.line(10, 30, 50, 30, 2, kBlack);
  double ink = 0;
  for (std::size_t i = 0; i < canvas.image().pixels.size(); i += 3) ink += (255 - canvas.image().pixels[i]) / 255.0;
  EXPECT_NEAR(ink, 2 * 40, 6); // and round ends
  EXPECT_EQ(canvas.image().at(30, 27)[0], 255);
  EXPECT_EQ(canvas.image().at(30, 29)[0], 0);
}

TEST(Canvas, LeavesOutWhatLiesBeyondThePicture) {
  Canvas canvas(20, 20, kWhite);
  canvas.fill(-5, -5, 100, 10, kBlack);
  canvas.line(-50, -50, 70, 70, 3, kBlack);
  canvas.text(-30, 300, "beyond", Font::title, kBlack);
  canvas.text(5, 15, "\xc3\xa4\n", Font::small, kBlack); // not ASCII: question marks
  EXPECT_EQ(canvas.image().at(10, 2)[0], 0);
  EXPECT_EQ(Canvas::widthOf("\xc3", Font::small), Canvas::widthOf("?", Font::small));
}

TEST(ColorScale, IsWhiteAtNothingAndRedWhereThereIsMore) {
  const ColorScale scale = scaleAbout0(0.083);
  EXPECT_DOUBLE_EQ(scale.low, -0.1);
  EXPECT_DOUBLE_EQ(scale.high, 0.1);
  EXPECT_EQ(scale.of(0), (Rgb{247, 247, 247}));
  EXPECT_GT(scale.of(0.09)[0], scale.of(0.09)[2]) << "red above";
  EXPECT_LT(scale.of(-0.09)[0], scale.of(-0.09)[2]) << "blue below";
  EXPECT_EQ(scale.of(5), scale.of(0.1));
  const std::vector<double> ticks = scale.ticks();
  ASSERT_EQ(ticks.size(), 5u);
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_NEAR(ticks[i], 0.05 * static_cast<double>(i) - 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(scaleUpTo(0.32).high, 0.4);
  EXPECT_DOUBLE_EQ(scaleUpTo(0.3).high, 0.3);
  EXPECT_DOUBLE_EQ(scaleUpTo(1).high, 1);
  EXPECT_DOUBLE_EQ(scaleUpTo(0).high, 1) << "nothing to show is no scale of nothing";
  EXPECT_EQ(scale.of(std::nan("")), (Rgb{0, 160, 60}));
}

} // namespace
} // namespace parity::plot

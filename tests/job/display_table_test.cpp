// The page's table of a display transform against the transform itself.
#include "job/view/display_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace parity::job {
namespace {

// As the page reads it: trilinear between nodes, clamped at the ends.
std::array<float, 3> lookUp(const base::Image& table, const float* rgb) {
  std::array<int, 3> low;
  std::array<float, 3> part;
  for (std::size_t c = 0; c < 3; ++c) {
    const float at = (std::log2(std::max(rgb[c], 0x1p-12f)) - kDisplayTableMinLog2) /
                     float{kDisplayTableMaxLog2 - kDisplayTableMinLog2} * (kDisplayTableSide - 1);
    low[c] = std::clamp(static_cast<int>(at), 0, kDisplayTableSide - 2);
    part[c] = std::clamp(at - static_cast<float>(low[c]), 0.f, 1.f);
  }
  std::array<float, 3> out{};
  for (int corner = 0; corner < 8; ++corner) {
    const int r = corner & 1, g = corner >> 1 & 1, b = corner >> 2;
    const float weight = (r ? part[0] : 1 - part[0]) * (g ? part[1] : 1 - part[1]) * (b ? part[2] : 1 - part[2]);
    const float* node = table.at((low[1] + g) * kDisplayTableSide + low[0] + r, low[2] + b);
    for (std::size_t c = 0; c < 3; ++c) out[c] += weight * node[c];
  }
  return out;
}

// Of each colour the largest of its channels' errors, in steps of 8 bits, ascending. The brightest channel is anything
// from 2^-14 to 2^11, the others are up to 2^spread less.
std::vector<float> errorsOf(const base::DisplayTransform& display, const base::Image& table, float spread) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> ev(-14, 11), less(-spread, 0);
  base::Image linear(300, 300, 3);
  for (std::size_t p = 0; p < linear.pixels.size(); p += 3) {
    const float brightest = ev(engine);
    for (std::size_t c = 0; c < 3; ++c)
      linear.pixels[p + c] = std::exp2(brightest + (c == p / 3 % 3 ? 0 : less(engine)));
  }
  const base::Image truth = display.apply(linear);
  std::vector<float> errors;
  for (std::size_t p = 0; p < linear.pixels.size(); p += 3) {
    const auto shown = lookUp(table, &linear.pixels[p]);
    float largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, 255 * std::abs(shown[c] - truth.pixels[p + c]));
    errors.push_back(largest);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(DisplayTable, ShowsColoursAsTheTransformDoes) {
  const base::DisplayTransform aces("ACES SDR");
  const base::Image table = makeDisplayTable(aces);
  EXPECT_LE(errorsOf(aces, table, 0).back(), 0.5f) << "grey";
  EXPECT_LE(errorsOf(aces, table, 2).back(), 2.f) << "a channel is a quarter of another";
  const std::vector<float> saturated = errorsOf(aces, table, 8);
  EXPECT_LE(saturated[saturated.size() * 99 / 100], 1.f);
}

TEST(DisplayTable, IsAFileWithItsRange) {
  const base::DisplayTransform aces("ACES SDR");
  const std::vector<std::byte> file = encodeDisplayTable(aces);
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  EXPECT_TRUE(
      text.starts_with("parityChunk({\"file\":\"pixels/display.js\",\"format\":2,\"width\":4225,\"height\":65,"));
  EXPECT_TRUE(text.ends_with("],\"minLog2\":-12,\"maxLog2\":10});\n"));
  EXPECT_TRUE(needsDisplayTable(aces));
  for (const char* formula : {"sRGB", "raw"}) EXPECT_FALSE(needsDisplayTable(base::DisplayTransform(formula)));
}

} // namespace
} // namespace parity::job

// JPEGs with bytes cut out, which decoders fill in silence.
#include "base/image/jpeg_check.h"

#include <gtest/gtest.h>

#include "base/jpeg_bytes.h"

namespace parity::base {
namespace {

TEST(JpegCheck, BytesThatAreMissingAreFound) {
  const std::vector<std::byte> whole = makeNoisyJpeg(128, 96);
  EXPECT_EQ(findJpegDamage(whole), "");
  for (const double place : {0.3, 0.5, 0.8}) {
    std::vector<std::byte> cut = whole;
    const auto at = cut.begin() + static_cast<std::ptrdiff_t>(place * static_cast<double>(cut.size()));
    cut.erase(at, at + 600); // several blocks
    EXPECT_NE(findJpegDamage(cut), "") << place;
  }
  EXPECT_EQ(findJpegDamage({}), "");
  EXPECT_EQ(findJpegDamage(std::span(whole).first(20)), "") << "no image: its decoder says so";
}

} // namespace
} // namespace parity::base

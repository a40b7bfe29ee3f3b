// What comparing a pair takes is told by the headers, and refused before it is taken.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/image/image_io.h"
#include "base/temp_folder.h"
#include "compare/images/flip_memory.h"

namespace parity::compare {
namespace {

constexpr std::size_t kFixed = std::size_t{256} << 20;

// 12 bytes for each colour; 28 for a list of pixels and six maps.
TEST(FlipMemory, IsThatOfColoursAndMapsForPairsOf8Bit) {
  const base::ImageShape shape{8192, 8192, 3, true};
  EXPECT_EQ(estimateFlipBytes(shape, shape, {}), kFixed + 52 * (std::size_t{1} << 26));
}

TEST(FlipMemory, GrowsWithFloatsAlphaMasksAndMetrics) {
  const base::ImageShape rgb{100, 100, 3, true}, rgba{100, 100, 4, true}, floats{100, 100, 3, false};
  const std::size_t least = estimateFlipBytes(rgb, rgb, {});
  EXPECT_GT(estimateFlipBytes(rgba, rgba, {}), least);
  EXPECT_GT(estimateFlipBytes(floats, floats, {}), least);
  FlipRequest similar, hdr;
  similar.metrics = {"ssim"};
  hdr.range = DynamicRange::hdr;
  EXPECT_GT(estimateFlipBytes(rgb, rgb, similar), least);
  EXPECT_GT(estimateFlipBytes(rgb, rgb, hdr), least);
  FlipRequest masked;
  masked.mask.file = "mask.png";
  EXPECT_GT(estimateFlipBytes(rgb, rgb, masked), least);
}

TEST(FlipMemory, BeyondTheLimitIsRefusedWithTheFigureAndTheOption) {
  const base::TempFolder folder;
  const FilePair pair{.name = "a", .reference = folder / "a.png", .test = folder / "b.png", .missing = ""};
  for (const auto& file : {pair.reference, pair.test}) base::writeImage(file, base::Image(1024, 512, 3, 0.5f));
  FlipRequest request;
  request.image.limits.maxBytes = kFixed + 52 * 1024 * 512;
  EXPECT_NO_THROW(requireFlipMemory(request, pair));
  --request.image.limits.maxBytes;
  base::expectError([&] { requireFlipMemory(request, pair); },
                    {"comparing 1024x512 pixels with 1024x512 needs 283 MiB; the limit is 281 MiB (--max-memory)"});
}

} // namespace
} // namespace parity::compare

// KTX 2 of Basis Universal, against what the format's own encoder (basisu 1.16.3) unpacks of its files.
#include "base/image/ktx2.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "base/parallel.h"
#include "expect_error.h"

namespace parity::base {
namespace {

using Bytes = std::vector<std::byte>;

const std::filesystem::path kData = std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ktx2";

Bytes fileOf(const std::string& name) { return readFile(kData / (name + ".ktx2")); }

// Skipped, visibly, where the program is built without the transcoder.
class Ktx2 : public testing::Test {
protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::filesystem::path(PARITY_BINARY_DIR) / "parity_basis.so"))
      GTEST_SKIP() << "built without npm or wabt: no transcoder of KTX 2";
  }
};

// Root of the mean square of one channel's differences, 0 to 1.
double rmsOf(const Image8& a, const Image8& b, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < a.pixels.size(); i += 4) sum += std::pow((a.pixels[i] - b.pixels[i]) / 255.0, 2);
  return std::sqrt(sum / static_cast<double>(a.pixelCount()));
}

TEST_F(Ktx2, IsWhatItsOwnEncoderUnpacks) {
  const Image8 golden = readImage8(kData / "uastc.png");
  for (const char* name : {"uastc", "uastc_zstd"}) {
    const Image8 image = decodeKtx2(fileOf(name), name);
    ASSERT_EQ(image.width, 42);
    ASSERT_EQ(image.height, 30);
    EXPECT_EQ(image.pixels, golden.pixels) << name;
  }
  const Image8 etc1s = decodeKtx2(fileOf("etc1s"), "etc1s"), color = readImage8(kData / "etc1s.png", 3);
  for (std::size_t p = 0; p < color.pixelCount(); ++p)
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(etc1s.pixels[4 * p + c], color.pixels[3 * p + c]) << p;
}

TEST_F(Ktx2, IsNearThePictureThatWasCompressed) {
  const Image8 source = readImage8(kData / "basis.png"), uastc = decodeKtx2(fileOf("uastc"), ""),
               etc1s = decodeKtx2(fileOf("etc1s"), "");
  for (std::size_t c = 0; c < 4; ++c) EXPECT_LT(rmsOf(uastc, source, c), 0.02) << c;
  EXPECT_LT(rmsOf(etc1s, source, 3), 0.04) << "alpha has a slice of its own";
}

TEST_F(Ktx2, IsTheSameOnAnyThread) {
  const Image8 golden = readImage8(kData / "uastc.png");
  std::vector<Image8> images(16);
  parallelFor(images.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) images[i] = decodeKtx2(fileOf("uastc_zstd"), "");
  });
  for (const Image8& image : images) EXPECT_EQ(image.pixels, golden.pixels);
}

TEST_F(Ktx2, DamageIsAnErrorOrAnotherPicture) {
  std::mt19937 random(7);
  for (const char* name : {"etc1s", "uastc", "uastc_zstd"}) {
    const Bytes whole = fileOf(name);
    int refused = 0;
    for (int round = 0; round < 30; ++round) {
      Bytes damaged = whole;
      for (int i = 0; i < 4; ++i) damaged[random() % damaged.size()] = static_cast<std::byte>(random() % 256);
      try {
        EXPECT_EQ(decodeKtx2(damaged, name, {.maxBytes = std::size_t{256} << 20}).channels, 4);
      } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(name)) << error.what();
        ++refused;
      }
    }
    EXPECT_GT(refused, 3) << name;
  }
}

Bytes changed(std::size_t at, std::uint32_t value, const char* name = "uastc") {
  Bytes file = fileOf(name);
  for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<std::byte>(value >> (8 * i));
  return file;
}

// By the header alone: no transcoder is needed.
TEST(Ktx2Header, TellsSizeAndRefusesInWords) {
  EXPECT_EQ(readKtx2Header(fileOf("etc1s"), "").width, 42);
  EXPECT_EQ(readKtx2Header(fileOf("uastc_zstd"), "").height, 30);
  const auto refused = [](const Bytes& file, const char* words, const ImageLimits& limits = {}) {
    expectError([&] { readKtx2Header(file, "a.ktx2", limits); }, {"a.ktx2", words});
  };
  const Bytes whole = fileOf("uastc");
  for (const std::size_t size : {std::size_t{0}, std::size_t{79}, std::size_t{90}, whole.size() - 1})
    refused({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}, "is truncated");
  refused(changed(12, 37), "is not Basis Universal (ETC1S or UASTC)");
  refused(changed(20, 0), "a width or height of 0");
  refused(changed(20, 4000000), "4000000");
  refused(changed(24, 31 + 4), "a first level of another size than its width and height");
  refused(changed(28, 1), "is not one two-dimensional picture");
  refused(changed(32, 2), "is not one two-dimensional picture");
  refused(changed(36, 6), "is not one two-dimensional picture");
  refused(changed(40, 33), "has 33 levels");
  refused(changed(44, 1), "the supercompression 1, which does not go with UASTC");
  refused(changed(44, 0, "etc1s"), "the supercompression 0, which does not go with ETC1S");
  refused(changed(48, 0xfffffff0u), "its descriptor ends beyond the file");
  refused(changed(80, 0xfffffff0u), "its level ends beyond the file");
  refused(whole, "42 x 30 pixels: the largest allowed side is 16", {.maxSide = 16});
  expectError([&] { decodeKtx2(whole, "a.ktx2", {.maxBytes = 1000}); }, {"a.ktx2", "--max-memory"});
}

} // namespace
} // namespace parity::base

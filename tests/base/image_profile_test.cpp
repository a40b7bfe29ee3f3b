// An ICC profile changes nothing, whatever stands in it, and the library never decodes it; what is no picture of a
// known format reaches no reader.
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/image_format.h"
#include "base/image/image_io.h"
#include "expect_error.h"
#include "png_bytes.h"
#include "profiled_images.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

std::span<const std::byte> profileBytes(const std::string& text) { return std::as_bytes(std::span(text)); }

// The library's own decoder ends the process with a segmentation fault on most of these.
TEST(IccProfile, WhoseOffsetsWrapIsReadPast) {
  const TempFolder folder;
  const auto plain = makeProfiledImages("");
  for (const std::string& profile : makeWrappingProfiles())
    for (const auto& [name, bytes] : makeProfiledImages(profile)) {
      SCOPED_TRACE(name);
      const std::filesystem::path file = folder / name;
      writeBytes(file, plain.at(name));
      const Image expected = readImage(file);
      writeBytes(file, bytes);
      testing::internal::CaptureStderr(); // no library may talk past us
      EXPECT_EQ(readImage(file), expected);
      EXPECT_EQ(readImage8(file, 3), decodeImage8(plain.at(name), name, 3));
      EXPECT_EQ(decodeImage8(bytes, name, 3), decodeImage8(plain.at(name), name, 3));
      EXPECT_TRUE(readImageShape(file).integer);
      EXPECT_EQ(readIntegers(file).width, expected.width);
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
}

TEST(IccProfile, CutOffAnywhereIsReadPastOrRefused) {
  const std::string whole = makeIccProfile("cprt", 144, 24, "text" + std::string(20, 'a'));
  for (std::size_t size = 0; size <= whole.size(); size += 7)
    for (const auto& [name, bytes] : makeProfiledImages(whole.substr(0, size)))
      EXPECT_GT(decodeImage8(bytes, name, 3).width, 0) << name << " " << size;
}

TEST(ImageFormat, IsToldByTheFirstBytes) {
  using enum ImageFormat;
  for (const auto& [name, bytes] : makeProfiledImages("")) {
    const std::map<std::string, ImageFormat> formats = {
        {"a.jpg", jpeg}, {"a.png", png}, {"a.tif", tiff}, {"a.webp", webp}};
    EXPECT_EQ(findImageFormat(bytes, ".x"), formats.at(name)) << name;
  }
  EXPECT_EQ(findImageFormat(profileBytes("P6\n1 1\n255\nabc"), ""), pnm);
  EXPECT_EQ(findImageFormat(profileBytes("P7 "), ""), std::nullopt);
  EXPECT_EQ(findImageFormat(profileBytes("PF\n1 1\n-1\n"), ""), pfm);
  std::string targaHeader(18, '\0');
  targaHeader[2] = 2, targaHeader[16] = 24;
  EXPECT_EQ(findImageFormat(profileBytes(targaHeader), ".TGA"), targa);
  EXPECT_EQ(findImageFormat(profileBytes(targaHeader), ".png"), std::nullopt) << "it has no mark";
  for (const std::string other : {"", "G", "GIF89a", "RIFF1234WAVE", "8BPS", "%PDF", "DDS ", "\0\0\0\x0cjP  "})
    EXPECT_EQ(findImageFormat(profileBytes(other), ".png"), std::nullopt) << other;
}

// Their readers take memory before the size is known, or read outside of their buffers.
TEST(ReadImage, GivesNoReaderWhatItCannotTrust) {
  const TempFolder folder;
  for (const std::string name : {"a.psd", "a.gif", "a.jp2", "a.ico"}) {
    writeText(folder / name, std::string("8BPS\0\1\0\0\0\0\0\0\0\3", 14) + std::string(100, '\0'));
    expectError([&] { readImage(folder / name); }, name, "is not one of PNG, JPEG, TIFF");
  }
}

// Opening a progressive JPEG, the library takes the memory of all coefficients, whatever the file holds of them.
TEST(ReadImage, RefusesAJpegByItsFrameHeader) {
  const TempFolder folder;
  std::vector<std::byte> bytes = makeProfiledImages("").at("a.jpg");
  const auto text = std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t frame = text.find("\xff\xc0");
  ASSERT_NE(frame, std::string_view::npos);
  bytes[frame + 1] = std::byte{0xc2};                          // progressive
  bytes[frame + 5] = bytes[frame + 7] = std::byte{16384 >> 8}; // 16392 high and wide, too large a side
  writeBytes(folder / "a.jpg", bytes);
  expectError([&] { readImageShape(folder / "a.jpg"); }, "a.jpg", "16392 x 16392 pixels: the largest allowed side");
  bytes[frame + 6] = bytes[frame + 8] = std::byte{0};
  writeBytes(folder / "a.jpg", bytes);
  EXPECT_EQ(readImageShape(folder / "a.jpg").width, 16384);
  const ImageLimits limits{.maxBytes = std::size_t{256} << 20};
  expectError([&] { readImage(folder / "a.jpg", limits); }, "a.jpg",
              "needs 513 MiB; the limit is 256 MiB (--max-memory)");
  expectError([&] { decodeImage8(bytes, "b", 4, limits); }, "b", "needs 513 MiB");
  bytes.resize(frame + 5);
  expectError([&] { decodeImage8(bytes, "b"); }, "b", "has no frame header");
}

// What reading takes is known from the header, in every format.
TEST(ReadImage, RefusesWhatTakesMoreThanTheLimit) {
  const TempFolder folder;
  for (const std::string name : {"a.png", "a.exr", "a.hdr", "a.pfm"}) {
    writeImage(folder / name, Image(64, 32, 3, 0.5f));
    EXPECT_NO_THROW(readImage(folder / name, {.maxSide = 64, .maxPixels = 2048, .maxBytes = 64 * 32 * 3 * 8})) << name;
    expectError([&] { readImage(folder / name, {.maxBytes = 64 * 32 * 3 * 4 - 1}); }, name, "--max-memory");
    expectError([&] { readImage(folder / name, {.maxSide = 63}); }, name, "63 (--max-image)");
    expectError([&] { readImage(folder / name, {.maxPixels = 2047}); }, name, "2047 (--max-image)");
    EXPECT_EQ(readImageShape(folder / name).height, 32) << name;
  }
}

// A PNG is checked by its content: one of another extension would reach libpng, which talks on stderr.
TEST(ReadImage, ChecksAPngOfAnyExtension) {
  const TempFolder folder;
  std::vector<std::byte> bytes = makePng({.width = 2, .height = 2}, std::vector<std::uint8_t>(12));
  bytes[bytes.size() - 1] ^= std::byte{1};
  writeBytes(folder / "a.jpg", bytes);
  testing::internal::CaptureStderr();
  expectError([&] { readImage(folder / "a.jpg"); }, "a.jpg", "a chunk IEND does not match its checksum");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace parity::base

// Plain Radiance HDR files are read as the image library reads them.
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/hdr_read.h"
#include "base/image/image_io.h"
#include "reader_match.h"
#include "support/shared_assets.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

constexpr const char* kHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 9\n";

// Lines of nine pixels: every exponent comes, in runs and as values.
std::string makeLines(int lines, int firstExponent = 180) {
  std::string text;
  for (int y = 0; y < lines; ++y) {
    text += std::string("\2\2\0\11", 4);
    for (int plane = 0; plane < 4; ++plane) {
      text += std::string("\x84", 1) +
              static_cast<char>(plane == 3 ? firstExponent + y : 60 * plane + y); // four of one value
      text += std::string("\5", 1);
      for (int i = 0; i < 5; ++i) text += static_cast<char>(50 * i + 7 * y + plane);
    }
  }
  return text;
}

TEST(HdrReader, ReadsPicturesOfEveryRange) {
  const TempFolder folder;
  std::mt19937 random(4);
  for (const int width : {8, 9, 127, 300})
    for (const bool isFlat : {false, true}) {
      Image image(width, 40, 3);
      for (float& v : image.pixels)
        v = isFlat ? 0.75f : std::ldexp(static_cast<float>(random() % 1000), static_cast<int>(random() % 150) - 90);
      const std::filesystem::path file = folder / "a.hdr";
      writeImage(file, image);
      SCOPED_TRACE(width);
      EXPECT_TRUE(expectAsLibrary(file, readFile(file)));
    }
}

TEST(HdrReader, ReadsEveryValueAndRun) {
  EXPECT_TRUE(expectAsLibrary("a.hdr", bytesOf(kHead + makeLines(3))));
  EXPECT_TRUE(expectAsLibrary(
      "a.hdr",
      bytesOf("#?RGBE\n# a comment\nGAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 9\n" +
              makeLines(3) + "what follows is not read")));
  EXPECT_TRUE(expectAsLibrary(
      "a.hdr", bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE= 1.00\n\n-Y 3 +X 9\n" + makeLines(3))));
  std::string all; // every mantissa with every exponent but those that are left to the library
  for (int e = 0; e < 256; ++e) {
    if (e == 40 || e == 223 || e == 226) continue;
    all += std::string("\2\2\1\0", 4);
    for (int plane = 0; plane < 4; ++plane)
      for (int half = 0; half < 2; ++half) {
        all += std::string("\x80", 1);
        for (int v = 0; v < 128; ++v) all += static_cast<char>(plane == 3 ? e : 128 * half + v);
      }
  }
  EXPECT_TRUE(expectAsLibrary("a.hdr", bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 253 +X 256\n" + all)));
}

TEST(HdrReader, LeavesWhatIsUnusualOrDamagedToTheLibrary) {
  const std::string lines = makeLines(3), format = "FORMAT=32-bit_rle_rgbe\n";
  const std::vector<std::string> files = {
      kHead + lines.substr(0, lines.size() - 1),             // ends early
      kHead + std::string("\2\2\0\10", 4) + lines.substr(4), // a line of another length
      kHead + std::string(108, '\1'),                        // pixels without runs
      kHead + lines.substr(0, 4) + '\0' + lines.substr(5),   // a run of none
      kHead + lines.substr(0, 4) + "\x8f" + lines.substr(5), // one beyond the line
      kHead + makeLines(3, 40),                              // an exponent that it reads otherwise
      "#?RADIANCE\n" + format + "\n+Y 3 +X 9\n" + lines,     // from the bottom
      "#?RADIANCE\n" + format + "\n-Y 3 +X 9 \n" + lines,    // more behind the size
      "#?RADIANCE\n" + format + "GAMMA=2.2\n\n-Y 3 +X 9\n" + lines,
      "#?RADIANCE\n" + format + "EXPOSURE=2\n\n-Y 3 +X 9\n" + lines,
      "#?RADIANCE\n" + format + "EXPOSURE=\n\n-Y 3 +X 9\n" + lines,
      "#?RADIANCE\n" + format + "EXPOSURE= 1 EV\n\n-Y 3 +X 9\n" + lines,
      "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 3 +X 9\n" + lines,
      "#?RADIANCE\n\n-Y 3 +X 9\n" + lines,
      "#?RADIANCE\n" + format + "\n-Y 3 +X 99999999999\n" + lines,
      "#?RADIANCE\n" + format,
  };
  for (const std::string& file : files) EXPECT_FALSE(readHdr(bytesOf(file), {}).has_value()) << file.substr(0, 80);
  EXPECT_FALSE(readHdr(bytesOf(kHead + lines), {.maxSide = 8}).has_value());
  EXPECT_FALSE(readHdr(bytesOf(kHead + lines), {.maxPixels = 26}).has_value());
  EXPECT_FALSE(readHdr(bytesOf(kHead + lines), {.maxBytes = 323}).has_value());
  EXPECT_TRUE(readHdr(bytesOf(kHead + lines), {.maxBytes = 324}).has_value());
}

TEST(HdrReader, ReadsTheEnvironmentsOfTheSharedAssets) {
  const std::filesystem::path assets = tests::sharedAssets();
  if (assets.empty()) GTEST_SKIP() << "no shared assets: set PARITY_SHARED";
  for (const auto& entry : std::filesystem::directory_iterator(assets / "env")) {
    if (entry.path().extension() != ".hdr") continue;
    EXPECT_TRUE(expectAsLibrary(entry.path(), readFile(entry.path())));
  }
}

} // namespace
} // namespace parity::base

// Plain OpenEXR files are read as the image library reads them.
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "exr_writer.h"
#include "reader_match.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

constexpr exr_compression_t kOurs[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE, EXR_COMPRESSION_ZIPS,
                                       EXR_COMPRESSION_ZIP, EXR_COMPRESSION_PIZ};

// Every half, and floats of any bits, among them every kind of NaN; then a ramp that compresses.
std::vector<std::uint32_t> makeBits(bool isNoise) {
  std::mt19937 random(5);
  std::vector<std::uint32_t> bits(65536);
  for (std::uint32_t i = 0; i < bits.size(); ++i)
    bits[i] = isNoise ? static_cast<std::uint32_t>(random()) << 16 | i : (i / 64 % 256) << 8 | 0x3c000000;
  return bits;
}

TEST(ExrReader, ReadsEveryCompressionTypeAndLayout) {
  const TempFolder folder;
  for (const exr_compression_t compression : kOurs)
    for (const bool isHalf : {true, false})
      for (const bool isNoise : {true, false})
        for (const int tile : {0, 16, 37})
          for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {130, 300}, {17, 33}}) {
            SCOPED_TRACE(std::to_string(compression) + (isHalf ? " half " : " float ") + std::to_string(tile) + " " +
                         std::to_string(width));
            const ExrKind kind{.compression = compression,
                               .width = width,
                               .height = height,
                               .x = -5,
                               .y = 7,
                               .tileWidth = tile,
                               .tileHeight = tile,
                               .halves = {isHalf}};
            expectAsLibrary(folder / "a.exr", makeExr(folder / "a.exr", kind, makeBits(isNoise)));
          }
}

TEST(ExrReader, HasTheChannelsInTheLibrarysOrder) {
  const TempFolder folder;
  const std::vector<std::vector<std::string>> lists = {
      {"Y"},
      {"R"},
      {"A", "Y"},
      {"A", "B", "G", "R"},
      {"A", "B", "G", "R", "Z"},
      {"B", "G", "R", "b", "g", "r"},
      {"Alpha", "Blue", "Green", "Red"},
      {"X", "Y", "Z"},
      {"X", "Y"},
      {"X", "W"},
      {"A", "R", "X", "Y", "Z"},
      {"A", "N.X", "N.Y", "N.Z", "diffuse.B", "diffuse.G", "diffuse.R", "id.Y"},
      {"AB", "AG", "AR", "BA", "GA", "RA", "Zback"},
      {"depth", "imag", "real", "u", "v"},
      {"a.b.R", "a.b.c.R", "a.c", "b"},
      {".", "..R", "A."}};
  for (const std::vector<std::string>& names : lists)
    for (const std::vector<bool>& halves : {std::vector<bool>{true}, {false}, {true, false}}) {
      SCOPED_TRACE(names.back());
      const ExrKind kind{.width = 40, .height = 20, .names = names, .halves = halves};
      expectAsLibrary(folder / "a.exr", makeExr(folder / "a.exr", kind, makeBits(true)));
    }
}

TEST(ExrReader, TellsColourSpaceChromaticitiesAndOrientation) {
  const TempFolder folder;
  for (const std::string space : {"Linear", "linear", "sRGB", "lin_rec709"}) {
    const ExrKind kind{.width = 3, .height = 2, .colorSpace = space};
    expectAsLibrary(folder / "a.exr", makeExr(folder / "a.exr", kind, makeBits(true)));
  }
  const ExrKind kind{.width = 3, .height = 2, .hasChromaticities = true, .orientation = 6};
  expectAsLibrary(folder / "a.exr", makeExr(folder / "a.exr", kind, makeBits(true)));
  EXPECT_EQ(readImageFile(folder / "a.exr").info.orientation, 6);
}

TEST(ExrReader, LeavesOtherKindsToTheLibrary) {
  const TempFolder folder;
  for (const exr_compression_t compression : {EXR_COMPRESSION_PXR24, EXR_COMPRESSION_B44, EXR_COMPRESSION_B44A}) {
    const ExrKind kind{.compression = compression, .width = 40, .height = 20};
    const auto file = makeExr(folder / "a.exr", kind, makeBits(false));
    EXPECT_FALSE(expectAsLibrary(folder / "a.exr", file, OwnReader::mayRefuse));
    EXPECT_EQ(readImage(folder / "a.exr").width, 40);
  }
  for (const std::vector<std::string>& names : {std::vector<std::string>{"BY", "RY", "Y"}, {"A", "BY", "RY", "Y"}})
    EXPECT_FALSE(expectAsLibrary(folder / "a.exr",
                                 makeExr(folder / "a.exr", {.width = 4, .height = 4, .names = names}, makeBits(false)),
                                 OwnReader::mayRefuse));
}

TEST(ExrReader, ReadsOfDamagedFilesNothingThatTheLibraryDoesNot) {
  const TempFolder folder;
  std::mt19937 random(13);
  int read = 0;
  for (int round = 0; round < 2000; ++round) {
    const int tile = random() % 3 == 0 ? 8 : 0;
    const ExrKind kind{.compression = kOurs[random() % std::size(kOurs)],
                       .width = 19,
                       .height = 37,
                       .tileWidth = tile,
                       .tileHeight = tile,
                       .halves = {random() % 2 == 0, random() % 2 == 0},
                       .hasChromaticities = random() % 2 == 0};
    auto file = makeExr(folder / "a.exr", kind, makeBits(random() % 2 == 0));
    // The header above all: of packed samples nearly all damage is found by their checksums.
    const std::size_t range = random() % 4 == 0 ? file.size() : std::min<std::size_t>(file.size(), 420);
    for (std::size_t flips = 1 + random() % 3; flips > 0; --flips)
      file[random() % range] ^= static_cast<std::byte>(1 << random() % 8);
    if (random() % 8 == 0) file.resize(random() % file.size());
    if (file.size() < 4 || file[0] != std::byte{0x76}) continue;
    SCOPED_TRACE(round);
    read += expectAsLibrary(folder / "a.exr", file, OwnReader::mayRefuse);
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(read, 100) << "the test has nothing to compare";
}

} // namespace
} // namespace parity::base

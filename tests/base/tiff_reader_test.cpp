// TIFF files of every plain kind are read as the image library reads them.
#include <array>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tiffio.h>

#include "base/file.h"
#include "base/image/tiff_read.h"
#include "reader_match.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

struct TiffKind {
  int width = 37, height = 29, bits = 8, channels = 3, photometric = PHOTOMETRIC_RGB;
  int extra = EXTRASAMPLE_UNASSALPHA; // what the last channel is, where there is one more than colours
  int compression = COMPRESSION_NONE, predictor = PREDICTOR_NONE;
  int rowsPerStrip = 8, tile = 0; // tile: its side; 0: strips
  bool isSeparate = false, isBigEndian = false, isBig = false;
  int orientation = 0; // 0: not said
  int pages = 1;
};

void setTags(TIFF* tiff, const TiffKind& kind) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kind.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kind.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, kind.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, kind.channels);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, kind.bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, kind.photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, kind.isSeparate ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, kind.compression);
  if (kind.predictor != PREDICTOR_NONE) TIFFSetField(tiff, TIFFTAG_PREDICTOR, kind.predictor);
  if (kind.orientation != 0) TIFFSetField(tiff, TIFFTAG_ORIENTATION, kind.orientation);
  if (kind.channels % 2 == 0 && kind.extra >= 0) {
    const auto extra = static_cast<std::uint16_t>(kind.extra);
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &extra);
  }
  if (kind.tile > 0) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kind.tile);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, kind.tile);
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kind.rowsPerStrip);
  }
}

// Smooth with some noise, so that every code of the compressions occurs.
void fill(std::vector<std::uint8_t>& part, int bits, std::mt19937& random) {
  for (std::size_t i = 0; i < part.size(); ++i)
    part[i] = static_cast<std::uint8_t>(i / 16 * 3 + (random() % 4 == 0 ? random() % 256 : 0));
  if (bits != 32) return;
  for (std::size_t i = 0; i + 4 <= part.size(); i += 4) {
    const float v = static_cast<float>(random() % 1000) / 16 - 20;
    std::memcpy(part.data() + i, &v, 4);
  }
}

std::vector<std::byte> writeTiff(const TiffKind& kind) {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "a.tif";
  const std::string mode = std::string("w") + (kind.isBigEndian ? "b" : "l") + (kind.isBig ? "8" : "");
  TIFF* tiff = TIFFOpen(file.c_str(), mode.c_str());
  std::mt19937 random(7);
  for (int page = 0; page < kind.pages; ++page) {
    setTags(tiff, kind);
    const std::uint32_t parts = kind.tile > 0 ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    for (std::uint32_t i = 0; i < parts; ++i) {
      const int strips = (kind.height + kind.rowsPerStrip - 1) / kind.rowsPerStrip;
      const int row = static_cast<int>(i) % strips * kind.rowsPerStrip;
      const auto lines = static_cast<std::uint32_t>(std::min(kind.rowsPerStrip, kind.height - row));
      std::vector<std::uint8_t> part(
          static_cast<std::size_t>(kind.tile > 0 ? TIFFTileSize(tiff) : TIFFVStripSize(tiff, lines)));
      fill(part, kind.bits, random);
      if (kind.tile > 0)
        TIFFWriteEncodedTile(tiff, i, part.data(), static_cast<tmsize_t>(part.size()));
      else
        TIFFWriteEncodedStrip(tiff, i, part.data(), static_cast<tmsize_t>(part.size()));
    }
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
  return readFile(file);
}

struct Packing {
  int compression, predictor;
};
constexpr std::array kPackings{Packing{COMPRESSION_NONE, PREDICTOR_NONE},
                               Packing{COMPRESSION_LZW, PREDICTOR_NONE},
                               Packing{COMPRESSION_LZW, PREDICTOR_HORIZONTAL},
                               Packing{COMPRESSION_LZW, PREDICTOR_FLOATINGPOINT},
                               Packing{COMPRESSION_ADOBE_DEFLATE, PREDICTOR_NONE},
                               Packing{COMPRESSION_ADOBE_DEFLATE, PREDICTOR_HORIZONTAL},
                               Packing{COMPRESSION_ADOBE_DEFLATE, PREDICTOR_FLOATINGPOINT},
                               Packing{COMPRESSION_DEFLATE, PREDICTOR_NONE},
                               Packing{COMPRESSION_DEFLATE, PREDICTOR_HORIZONTAL},
                               Packing{COMPRESSION_PACKBITS, PREDICTOR_NONE}};

// Calls body(kind) for every type of samples and every packing.
template <typename Body> void forKinds(const Body& body) {
  for (const int bits : {8, 16, 32})
    for (const int channels : {1, 2, 3, 4})
      for (const Packing& packing : kPackings) {
        if (packing.predictor == PREDICTOR_FLOATINGPOINT && bits != 32) continue;
        TiffKind kind{.bits = bits, .channels = channels};
        kind.photometric = channels > 2 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
        kind.compression = packing.compression, kind.predictor = packing.predictor;
        SCOPED_TRACE(std::to_string(bits) + " bits, " + std::to_string(channels) + " channels, compression " +
                     std::to_string(packing.compression) + ", predictor " + std::to_string(packing.predictor));
        body(kind);
      }
}

// Planes apart in packed strips are left to the library, which reads some of them.
OwnReader expectedOf(const TiffKind& kind) {
  return kind.isSeparate && kind.channels > 1 && kind.tile == 0 && kind.compression != COMPRESSION_NONE
             ? OwnReader::mayRefuse
             : OwnReader::reads;
}

TEST(TiffReader, ReadsEveryTypeAndCompressionInStripsAndTiles) {
  forKinds([](TiffKind kind) {
    for (const bool isSeparate : {false, true})
      for (const bool isBigEndian : {false, true})
        for (const int tile : {0, 16}) {
          SCOPED_TRACE(std::to_string(isSeparate) + std::to_string(isBigEndian) + " tile " + std::to_string(tile));
          kind.isSeparate = isSeparate, kind.isBigEndian = isBigEndian, kind.tile = tile;
          expectTiffAsLibrary(writeTiff(kind), expectedOf(kind));
        }
  });
}

TEST(TiffReader, ReadsStripsOfEveryHeight) {
  for (const Packing& packing : kPackings)
    for (const bool isSeparate : {false, true})
      for (const int height : {1, 29, 300, 600})
        for (const int rows : {1, 7, 100, 256, 600, 1000}) {
          if (packing.predictor == PREDICTOR_FLOATINGPOINT) continue;
          SCOPED_TRACE(std::to_string(packing.compression) + " " + std::to_string(height) + " lines, " +
                       std::to_string(rows) + " a strip");
          TiffKind kind{.width = 13, .height = height};
          kind.compression = packing.compression, kind.predictor = packing.predictor;
          kind.rowsPerStrip = rows, kind.isSeparate = isSeparate;
          expectTiffAsLibrary(writeTiff(kind), expectedOf(kind));
        }
}

TEST(TiffReader, DescribesAlphaOrientationAndBigFiles) {
  for (const int channels : {2, 4})
    for (const int extra : {-1, EXTRASAMPLE_UNSPECIFIED, EXTRASAMPLE_ASSOCALPHA, EXTRASAMPLE_UNASSALPHA})
      for (const int bits : {8, 32}) {
        SCOPED_TRACE(std::to_string(channels) + " channels, extra " + std::to_string(extra));
        TiffKind kind{.bits = bits, .channels = channels, .extra = extra};
        if (channels == 2) kind.photometric = PHOTOMETRIC_MINISBLACK;
        expectTiffAsLibrary(writeTiff(kind), extra > 0 ? OwnReader::reads : OwnReader::mayRefuse);
      }
  for (int orientation = 1; orientation <= 8; ++orientation)
    expectTiffAsLibrary(writeTiff({.orientation = orientation}));
  expectTiffAsLibrary(writeTiff({.bits = 16, .isBig = true}));
}

TEST(TiffReader, LeavesTheUnusualToTheLibrary) {
  const auto mayRead = [](const TiffKind& kind) { return expectTiffAsLibrary(writeTiff(kind), OwnReader::mayRefuse); };
  EXPECT_FALSE(mayRead({.channels = 1, .photometric = PHOTOMETRIC_MINISWHITE}));
  EXPECT_FALSE(mayRead({.channels = 4, .photometric = PHOTOMETRIC_SEPARATED, .extra = -1}));
  EXPECT_FALSE(mayRead({.pages = 2}));
}

TEST(TiffReader, KeepsTheLimits) {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "a.tif";
  writeBytes(file, writeTiff({}));
  EXPECT_TRUE(readTiff(file, {.maxSide = 37}, 4));
  EXPECT_FALSE(readTiff(file, {.maxSide = 36}, 4));
  EXPECT_FALSE(readTiffShape(file, {.maxPixels = 37 * 29 - 1}));
  EXPECT_TRUE(readTiff(file, {.maxBytes = 37 * 29 * 3 * 5}, 4));
  EXPECT_FALSE(readTiff(file, {.maxBytes = 37 * 29 * 3 * 5 - 1}, 4));
}

TEST(TiffReader, ReadsOfDamagedFilesNothingThatTheLibraryDoesNot) {
  std::mt19937 random(11);
  testing::internal::CaptureStderr();
  int read = 0;
  for (int round = 0; round < 1500; ++round) {
    const Packing packing = kPackings[random() % kPackings.size()];
    TiffKind kind{.width = 9, .height = 20, .bits = packing.predictor == PREDICTOR_FLOATINGPOINT ? 32 : 8};
    if (kind.bits == 8 && random() % 3 == 0) kind.bits = 16;
    kind.compression = packing.compression, kind.predictor = packing.predictor;
    kind.isSeparate = random() % 4 == 0, kind.isBigEndian = random() % 4 == 0, kind.tile = random() % 4 == 0 ? 16 : 0;
    auto file = writeTiff(kind);
    if (random() % 8 == 0) file.resize(random() % file.size());
    for (std::size_t flips = 1 + random() % 3; flips > 0 && !file.empty(); --flips)
      file[random() % file.size()] ^= static_cast<std::byte>(1 << random() % 8);
    SCOPED_TRACE(std::to_string(round) + " compression " + std::to_string(packing.compression));
    if (!file.empty()) read += expectTiffAsLibrary(file, OwnReader::mayRefuse);
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(read, 100) << "the test has nothing to compare";
}

} // namespace
} // namespace parity::base

// PNG files of every type are read as the image library reads them.
#include <array>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include "base/file.h"
#include "png_bytes.h"
#include "reader_match.h"
#include "temp_folder.h"

namespace parity::base {
namespace {

struct PngKind {
  int width = 37, height = 29, depth = 8, colorType = PNG_COLOR_TYPE_RGB;
  bool isInterlaced = false;
  int filters = PNG_ALL_FILTERS, level = 6, windowBits = 15;
  std::size_t chunkBytes = 8192; // of image data
};

constexpr std::array kTypes = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE,
                               PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA};

bool isLegal(int colorType, int depth) {
  if (colorType == PNG_COLOR_TYPE_PALETTE) return depth <= 8;
  return colorType == PNG_COLOR_TYPE_GRAY || depth >= 8;
}

// By libpng; smooth with some noise, so that every filter and match occurs.
std::vector<std::byte> writeByLibpng(const PngKind& kind) {
  std::vector<std::byte> file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp at, png_bytep data, std::size_t size) {
    auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(at));
    out.insert(out.end(), reinterpret_cast<std::byte*>(data), reinterpret_cast<std::byte*>(data) + size);
  };
  png_set_write_fn(png, &file, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(kind.width), static_cast<png_uint_32>(kind.height), kind.depth,
               kind.colorType, kind.isInterlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
               PNG_FILTER_TYPE_BASE);
  std::mt19937 random(7);
  std::array<png_color, 256> palette;
  for (png_color& color : palette)
    color = {static_cast<png_byte>(random()), static_cast<png_byte>(random()), static_cast<png_byte>(random())};
  if (kind.colorType == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 1 << kind.depth);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, kind.filters);
  png_set_compression_level(png, kind.level);
  png_set_compression_window_bits(png, kind.windowBits);
  png_set_compression_buffer_size(png, kind.chunkBytes);
  png_write_info(png, info);
  const std::size_t rowBytes = png_get_rowbytes(png, info);
  std::vector<std::vector<png_byte>> rows(static_cast<std::size_t>(kind.height), std::vector<png_byte>(rowBytes));
  std::vector<png_bytep> starts;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t x = 0; x < rowBytes; ++x)
      rows[y][x] = static_cast<png_byte>(x * 3 + y * 5 + (random() % 4 == 0 ? random() % 256 : 0));
    starts.push_back(rows[y].data());
  }
  png_write_image(png, starts.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

std::vector<std::byte> withChunks(std::vector<std::byte> file, const std::string& chunks, const std::string& before) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const std::size_t at = text.find(before) - 4;
  const auto* begin = reinterpret_cast<const std::byte*>(chunks.data());
  file.insert(file.begin() + static_cast<std::ptrdiff_t>(at), begin, begin + chunks.size());
  return file;
}

TEST(PngReader, ReadsEveryTypeDepthAndInterlacing) {
  for (const int type : kTypes)
    for (const int depth : {1, 2, 4, 8, 16})
      for (const bool isInterlaced : {false, true})
        for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {2, 3}, {37, 29}, {5, 200}}) {
          if (!isLegal(type, depth)) continue;
          SCOPED_TRACE(std::to_string(type) + " " + std::to_string(depth) + " " + std::to_string(width));
          expectAsLibrary("a.png", writeByLibpng({width, height, depth, type, isInterlaced}));
        }
}

TEST(PngReader, ReadsEveryFilterWindowAndSplitOfTheData) {
  for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA})
    for (const int depth : {8, 16})
      for (const int filters : {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG, PNG_FILTER_PAETH}) {
        SCOPED_TRACE(std::to_string(type) + " " + std::to_string(depth) + " " + std::to_string(filters));
        PngKind kind{.depth = depth, .colorType = type, .filters = filters};
        expectAsLibrary("a.png", writeByLibpng(kind));
        kind.chunkBytes = 100, kind.level = 0;
        expectAsLibrary("a.png", writeByLibpng(kind));
        kind.width = 300, kind.height = 300, kind.windowBits = 9, kind.level = 9; // libpng reads these rows
        expectAsLibrary("a.png", writeByLibpng(kind));
      }
}

TEST(PngReader, ReadsTransparentColoursAndPalettes) {
  const std::string zeros(256, '\0');
  for (const int depth : {1, 2, 4, 8, 16})
    for (const bool isInterlaced : {false, true})
      for (const int type : kTypes) {
        if (!isLegal(type, depth)) continue;
        SCOPED_TRACE(std::to_string(type) + " " + std::to_string(depth));
        const auto file = writeByLibpng({.depth = depth, .colorType = type, .isInterlaced = isInterlaced});
        const bool isPalette = type == PNG_COLOR_TYPE_PALETTE;
        for (const std::string& data : {zeros.substr(0, isPalette                     ? 2
                                                        : type == PNG_COLOR_TYPE_GRAY ? 2
                                                                                      : 6),
                                        zeros.substr(0, 1), std::string("\0\1\0\1\0\1", 6)})
          expectAsLibrary("a.png", withChunks(file, makePngChunk("tRNS", data), "IDAT"));
      }
}

TEST(PngReader, DescribesWhatTheChunksSay) {
  const auto file = writeByLibpng({});
  const auto number = [](std::uint32_t v) {
    return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
                       static_cast<char>(v)};
  };
  const auto text = [](const std::string& key, const std::string& value) {
    return makePngChunk("tEXt", key + '\0' + value);
  };
  std::vector<std::string> headers = {"",
                                      makePngChunk("sRGB", std::string(1, '\0')),
                                      makePngChunk("sRGB", std::string(1, '\0')) + makePngChunk("gAMA", number(100000)),
                                      makePngChunk("oFFs", number(7) + number(9) + std::string(1, '\0')),
                                      makePngChunk("oFFs", number(0xfffffff9) + number(9) + std::string(1, '\1')),
                                      makePngChunk("oFFs", number(0xfffffff9) + number(9) + std::string(1, '\0')),
                                      makePngChunk("pHYs", number(7) + number(9) + std::string(1, '\1')),
                                      makePngChunk("bKGD", std::string(6, '\1')),
                                      makePngChunk("sBIT", std::string(3, '\5')),
                                      makePngChunk("tIME", std::string(7, '\1')),
                                      makePngChunk("cICP", std::string("\1\x0d\0\1", 4)),
                                      makePngChunk("prVt", "abc"),
                                      text("Software", "x"),
                                      text("oiio:ColorSpace", "Linear"),
                                      text("OIIO:colorspace", "linear") + text("oiio:ColorSpace", "sRGB"),
                                      text("oiio:UnassociatedAlpha", "0"),
                                      text("ICCProfile", "x")};
  for (const std::uint32_t gamma : {1u, 45455u, 99499u, 99503u, 100000u, 100400u, 100600u, 250000u, 0u})
    headers.push_back(makePngChunk("gAMA", number(gamma)));
  for (const std::string& chunks : headers) {
    SCOPED_TRACE(chunks);
    expectAsLibrary("a.png", withChunks(file, chunks, "IDAT"));
  }
  // These the library describes.
  for (const std::string key : {"Orientation", "orientation", "XML:com.adobe.xmp", "Raw profile type exif",
                                "textureformat", "chromaticities", "oiio:BitsPerSample"})
    EXPECT_FALSE(expectAsLibrary("a.png", withChunks(file, text(key, "6"), "IDAT"), OwnReader::mayRefuse)) << key;
}

// The checksums are made right again: what is damaged reaches the reader.
TEST(PngReader, ReadsOfDamagedFilesNothingThatTheLibraryDoesNot) {
  std::mt19937 random(11);
  int read = 0;
  for (int round = 0; round < 2000; ++round) {
    const int type = kTypes[random() % kTypes.size()];
    int depth = 1 << random() % 5;
    if (!isLegal(type, depth)) depth = 8;
    auto file = writeByLibpng({.width = 9,
                               .height = 7,
                               .depth = depth,
                               .colorType = type,
                               .isInterlaced = random() % 4 == 0,
                               .level = static_cast<int>(random() % 3) * 3,
                               .chunkBytes = 50});
    for (std::size_t flips = 1 + random() % 3; flips > 0; --flips)
      file[8 + random() % (file.size() - 8)] ^= static_cast<std::byte>(1 << random() % 8);
    for (std::size_t at = 8; at + 12 <= file.size();) {
      const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(file[at + i]); };
      const std::size_t length = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
      if (length > file.size() - at - 12) break;
      const auto sum = crc32(0, reinterpret_cast<const Bytef*>(file.data() + at + 4), static_cast<uInt>(length + 4));
      for (std::size_t i = 0; i < 4; ++i) file[at + 8 + length + i] = static_cast<std::byte>(sum >> (24 - 8 * i));
      at += length + 12;
    }
    SCOPED_TRACE(round);
    read += expectAsLibrary("a.png", file, OwnReader::mayRefuse);
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(read, 100) << "the test has nothing to compare";
}

TEST(PngReader, ReadsThePicturesOfTheTests) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(PARITY_SOURCE_DIR) / "tests"))
    if (entry.path().extension() == ".png" || entry.path().extension() == ".exr") {
      SCOPED_TRACE(entry.path());
      const bool isSound = entry.path().string().find("corpus") == std::string::npos;
      expectAsLibrary(entry.path(), readFile(entry.path()), isSound ? OwnReader::reads : OwnReader::mayRefuse);
      ++count;
    }
  EXPECT_GT(count, 5);
}

} // namespace
} // namespace parity::base

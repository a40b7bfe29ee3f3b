// Which of the formats that are read a file has.
#include "base/image/image_format.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace parity::base {

namespace {

// Truevision TGA 2.0, table 1: a TGA file has no mark. Bytes: colour map 0 or 1; image type 1 to 3, or 9 to 11 packed;
// the map's entries; the depth of a pixel.
bool looksLikeTarga(std::string_view head) {
  constexpr std::size_t kHeaderBytes = 18, kMapType = 1, kImageType = 2, kDepth = 16;
  constexpr std::array kImageTypes{1, 2, 3, 9, 10, 11};
  constexpr std::array kDepths{8, 15, 16, 24, 32};
  if (head.size() < kHeaderBytes || static_cast<unsigned char>(head[kMapType]) > 1) return false;
  const auto isAmong = [&](const auto& values, std::size_t at) {
    return std::find(values.begin(), values.end(), static_cast<unsigned char>(head[at])) != values.end();
  };
  return isAmong(kImageTypes, kImageType) && isAmong(kDepths, kDepth);
}

} // namespace

std::optional<ImageFormat> findImageFormat(std::span<const std::byte> bytes, std::string_view extension) {
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 32));
  struct Mark {
    std::string_view bytes;
    ImageFormat format;
  };
  using enum ImageFormat;
  constexpr std::array kMarks{Mark{"\x89PNG\r\n\x1a\n", png},
                              Mark{"\xff\xd8\xff", jpeg},
                              Mark{{"II*\0", 4}, tiff},
                              Mark{{"MM\0*", 4}, tiff},
                              Mark{{"II+\0", 4}, tiff}, // BigTIFF
                              Mark{{"MM\0+", 4}, tiff},
                              Mark{"#?", hdr},
                              Mark{"\x76\x2f\x31\x01", exr},
                              Mark{"PF", pfm},
                              Mark{"Pf", pfm},
                              Mark{"BM", bmp}};
  for (const Mark& mark : kMarks)
    if (head.starts_with(mark.bytes)) return mark.format;
  if (head.starts_with("RIFF") && head.substr(std::min<std::size_t>(head.size(), 8)).starts_with("WEBP")) return webp;
  if (head.size() >= 3 && head[0] == 'P' && head[1] >= '1' && head[1] <= '6' &&
      (std::isspace(static_cast<unsigned char>(head[2])) || head[2] == '#'))
    return pnm;
  const auto isTarga = [&](std::string_view own) {
    return std::equal(extension.begin(), extension.end(), own.begin(), own.end(),
                      [](unsigned char a, char b) { return std::tolower(a) == b; });
  };
  if ((isTarga(".tga") || isTarga(".tpic")) && looksLikeTarga(head)) return targa;
  return std::nullopt;
}

const char* readerOf(ImageFormat format) {
  switch (format) {
  case ImageFormat::png:
    return "png";
  case ImageFormat::jpeg:
    return "jpeg";
  case ImageFormat::tiff:
    return "tiff";
  case ImageFormat::webp:
    return "webp";
  case ImageFormat::hdr:
    return "hdr";
  case ImageFormat::exr:
    return "openexr";
  case ImageFormat::bmp:
    return "bmp";
  case ImageFormat::targa:
    return "targa";
  case ImageFormat::pfm:
  case ImageFormat::pnm:
    return "pnm";
  }
  return "";
}

} // namespace parity::base

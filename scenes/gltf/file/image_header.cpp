// Size and wholeness of an image file by its header, before memory is taken.
#include "scenes/gltf/file/image_header.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace parity::scenes {
namespace {

using Bytes = std::span<const std::byte>;

bool startsWith(Bytes bytes, std::string_view text, std::size_t at = 0) {
  return bytes.size() >= at + text.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}

std::size_t readBig(Bytes bytes, std::size_t offset, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<std::size_t>(bytes[offset + i]);
  return value;
}

std::size_t readLittle(Bytes bytes, std::size_t offset, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<std::size_t>(bytes[offset + i]);
  return value;
}

// The frame header (T.81, B.2.2), and whether an end marker follows the first scan: decoders fill what a cut-off JPEG
// lacks with grey. Within a scan 0xff is always followed by 0 or a restart marker, so the end marker appears only where
// the image ends.
void readJpeg(Bytes bytes, ImageHeader& header) {
  header.isCutOff = true;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (readBig(bytes, at, 1) != 0xff) return;
    const std::size_t marker = readBig(bytes, at + 1, 1);
    if (marker == 0xff) { // fill byte
      ++at;
      continue;
    }
    const std::size_t length = readBig(bytes, at + 2, 2);
    const bool isFrame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (isFrame && at + 9 <= bytes.size()) {
      header.width = readBig(bytes, at + 7, 2);
      header.height = readBig(bytes, at + 5, 2);
    }
    if (marker == 0xda) {
      constexpr std::array kEnd = {std::byte{0xff}, std::byte{0xd9}};
      const auto scan = bytes.begin() + static_cast<std::ptrdiff_t>(at);
      header.isCutOff = std::search(scan, bytes.end(), kEnd.begin(), kEnd.end()) == bytes.end();
      return;
    }
    at += 2 + std::max<std::size_t>(length, 2);
  }
}

// RFC 9649: "RIFF", the size of what follows, "WEBP", then a chunk "VP8 " (lossy: 3 bytes of frame tag, a start code,
// 14 bits of width and height), "VP8L" (a signature, 14 bits less one each) or "VP8X" (24 bits less one each).
void readWebp(Bytes bytes, ImageHeader& header) {
  header.isCutOff = bytes.size() < 30 || readLittle(bytes, 4, 4) > bytes.size() - 8;
  if (bytes.size() < 30) return;
  if (startsWith(bytes, "VP8 ", 12)) {
    header.width = readLittle(bytes, 26, 2) & 0x3fff;
    header.height = readLittle(bytes, 28, 2) & 0x3fff;
  } else if (startsWith(bytes, "VP8L", 12)) {
    const std::size_t bits = readLittle(bytes, 21, 4);
    header.width = (bits & 0x3fff) + 1;
    header.height = (bits >> 14 & 0x3fff) + 1;
  } else if (startsWith(bytes, "VP8X", 12)) {
    header.width = readLittle(bytes, 24, 3) + 1;
    header.height = readLittle(bytes, 27, 3) + 1;
  }
}

} // namespace

ImageHeader readImageHeader(std::span<const std::byte> bytes) {
  ImageHeader header;
  if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) {
    header.format = ImageFormat::png;
    if (bytes.size() >= 24) {
      header.width = readBig(bytes, 16, 4);
      header.height = readBig(bytes, 20, 4);
    }
  } else if (startsWith(bytes, "\xff\xd8\xff")) {
    header.format = ImageFormat::jpeg;
    readJpeg(bytes, header);
  } else if (startsWith(bytes, "RIFF") && startsWith(bytes, "WEBP", 8)) {
    header.format = ImageFormat::webp;
    readWebp(bytes, header);
  } else if (startsWith(bytes, "\xabKTX 20\xbb\r\n\x1a\n")) {
    header.format = ImageFormat::ktx2;
  }
  return header;
}

} // namespace parity::scenes

// How large a JPEG is, before the library sees it.
#include "base/image/jpeg_header.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::base {

ImageShape readJpegShape(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  constexpr std::size_t kFrameBytes = 10; // marker, length, precision, height, width, components
  constexpr std::size_t kCoefficientBytes = 2;
  const auto byteAt = [&](std::size_t at) { return static_cast<int>(bytes[at]); };
  const auto wordAt = [&](std::size_t at) { return byteAt(at) << 8 | byteAt(at + 1); };
  // Segments of a marker and a length follow the start marker; what is none is skipped, as libjpeg does.
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    const int marker = byteAt(at + 1);
    if (byteAt(at) != 0xff || marker == 0 || marker == 0xff) {
      ++at;
      continue;
    }
    if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) { // they stand alone
      at += 2;
      continue;
    }
    if (marker == 0xd9 || marker == 0xda) break; // the end, or a scan without a frame
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) {
      if (at + kFrameBytes > bytes.size()) break;
      const int height = wordAt(at + 5), width = wordAt(at + 7), components = byteAt(at + 9);
      checkImageSize(name, width, height, components, limits);
      const std::size_t values =
          static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(components);
      checkImageBytes(name, fmt::format("an image of {} x {} pixels", width, height), kCoefficientBytes * values,
                      limits.maxBytes);
      return {width, height, components, true};
    }
    at += 2 + static_cast<std::size_t>(std::max(wordAt(at + 2), 2));
  }
  throw fileError(name, "damaged or truncated", "has no frame header");
}

} // namespace parity::base

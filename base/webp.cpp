// WebP by libwebp itself.
#include "base/webp.h"

#include <algorithm>
#include <cstring>

#include <webp/decode.h>

namespace parity::base {

bool isWebp(std::span<const std::byte> bytes) {
  return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

Image8 decodeWebp(std::span<const std::byte> bytes, const std::string& name, int channels) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  if (const VP8StatusCode status = WebPGetFeatures(data, bytes.size(), &features); status != VP8_STATUS_OK)
    throw fileError(name, "cannot be decoded",
                    status == VP8_STATUS_NOT_ENOUGH_DATA ? "truncated" : "not a WebP image, or a damaged one");
  if (features.has_animation) throw fileError(name, "cannot be decoded", "is an animation, expected a still image");
  checkImageSize(name, features.width, features.height, 4);
  Image8 rgba(features.width, features.height, 4);
  if (!WebPDecodeRGBAInto(data, bytes.size(), rgba.pixels.data(), rgba.pixels.size(), 4 * features.width))
    throw fileError(name, "cannot be decoded", "the WebP image is truncated or damaged");
  if (channels == 4) return rgba;
  Image8 image(rgba.width, rgba.height, channels);
  for (std::size_t p = 0; p < rgba.pixelCount(); ++p) {
    const std::uint8_t* from = rgba.pixels.data() + 4 * p;
    std::uint8_t* to = image.pixels.data() + static_cast<std::size_t>(channels) * p;
    to[0] = from[0];
    if (channels == 2) to[1] = from[3];
    if (channels == 3) std::copy(from + 1, from + 3, to + 1);
  }
  return image;
}

} // namespace parity::base

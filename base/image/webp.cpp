// WebP by libwebp itself.
#include "base/image/webp.h"

#include <algorithm>

#include <fmt/format.h>
#include <webp/decode.h>

namespace parity::base {

ImageShape readWebpShape(std::span<const std::byte> head, const std::string& name, const ImageLimits& limits) {
  WebPBitstreamFeatures features;
  const auto* data = reinterpret_cast<const std::uint8_t*>(head.data());
  if (const VP8StatusCode status = WebPGetFeatures(data, head.size(), &features); status != VP8_STATUS_OK)
    throw fileError(name, "cannot be decoded",
                    status == VP8_STATUS_NOT_ENOUGH_DATA ? "truncated" : "not a WebP image, or a damaged one");
  if (features.has_animation) throw fileError(name, "cannot be decoded", "is an animation, expected a still image");
  checkImageSize(name, features.width, features.height, 4, limits);
  return {features.width, features.height, features.has_alpha ? 4 : 3, true};
}

Image8 decodeWebp(std::span<const std::byte> bytes, const std::string& name, int channels, const ImageLimits& limits) {
  const ImageShape features = readWebpShape(bytes, name, limits);
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  // RGBA of the decoder and of the result, and the channels wanted of it.
  checkImageBytes(name, fmt::format("an image of {} x {} pixels", features.width, features.height),
                  static_cast<std::size_t>(features.width) * static_cast<std::size_t>(features.height) *
                      static_cast<std::size_t>(8 + channels),
                  limits.maxBytes);
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

ImageFile readWebp(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  ImageFile result;
  const int channels = readWebpShape(bytes, name, limits).channels;
  const Image8 stored = decodeWebp(bytes, name, channels, limits);
  result.pixels = Image(stored.width, stored.height, channels);
  std::transform(stored.pixels.begin(), stored.pixels.end(), result.pixels.pixels.begin(),
                 [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
  result.info.integer = true;
  result.info.bits = 8;
  result.info.fullWidth = stored.width;
  result.info.fullHeight = stored.height;
  result.info.channelNames = {"R", "G", "B"};
  if (channels == 4) {
    result.info.channelNames.emplace_back("A");
    result.info.alphaChannel = 3;
  }
  return result;
}

} // namespace parity::base

// Whether a PNG file is whole: the chunk structure and its checksums.
#include "base/image/png_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <string_view>

#include <fmt/format.h>
#include <libdeflate.h>

#include "base/error.h"

namespace parity::base {

namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kLengthBytes = 4, kTypeBytes = 4, kChecksumBytes = 4;

std::uint32_t bigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

} // namespace

ImageShape readPngShape(std::span<const std::byte> head, const std::string& name, const ImageLimits& limits) {
  std::string_view rest(reinterpret_cast<const char*>(head.data()), head.size());
  rest.remove_prefix(std::min(rest.size(), kSignature.size()));
  constexpr std::size_t kColorType = 17; // behind width, height and the depth of a sample
  if (rest.size() <= kColorType) throw fileError(name, "damaged or truncated", "the file ends inside its header");
  if (rest.substr(kLengthBytes, kTypeBytes) != "IHDR")
    throw fileError(name, "damaged or truncated", "does not begin with an IHDR chunk");
  const long long width = bigEndian(rest.substr(8)), height = bigEndian(rest.substr(12));
  constexpr int kChannels[] = {1, 0, 3, 4, 2, 0, 4}; // by colour type: grey, RGB, palette, with alpha
  const auto colorType = static_cast<unsigned char>(rest[kColorType]);
  const int channels = colorType < std::size(kChannels) ? kChannels[colorType] : 0;
  if (channels == 0) throw fileError(name, "IHDR", fmt::format("the colour type {} does not exist", colorType));
  checkImageSize(name, width, height, channels, limits);
  return {static_cast<int>(width), static_cast<int>(height), channels, true};
}

void checkPng(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!rest.starts_with(kSignature)) return;
  readPngShape(bytes, name, limits);
  rest.remove_prefix(kSignature.size());
  for (;;) {
    if (rest.size() < kLengthBytes + kTypeBytes)
      throw fileError(name, "damaged or truncated", "the file ends without an IEND chunk");
    const std::size_t length = bigEndian(rest);
    const std::string_view type = rest.substr(kLengthBytes, kTypeBytes);
    if (!std::all_of(type.begin(), type.end(), [](unsigned char c) { return std::isalpha(c); }))
      throw fileError(name, "damaged or truncated", "a chunk has no valid name");
    if (rest.size() - kLengthBytes - kTypeBytes < length + kChecksumBytes)
      throw fileError(name, "damaged or truncated", fmt::format("the file ends inside a chunk {}", type));
    const std::string_view checked = rest.substr(kLengthBytes, kTypeBytes + length);
    const std::uint32_t checksum = bigEndian(rest.substr(kLengthBytes + kTypeBytes + length));
    if (libdeflate_crc32(0, checked.data(), checked.size()) != checksum)
      throw fileError(name, "damaged or truncated", fmt::format("a chunk {} does not match its checksum", type));
    if (type == "IEND") return; // whatever follows is no part of the image
    rest.remove_prefix(kLengthBytes + kTypeBytes + length + kChecksumBytes);
  }
}

} // namespace parity::base

// Whether a PNG file is whole: the chunk structure and its checksums.
#include "base/png_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "base/error.h"
#include "base/image.h"

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

void checkPng(std::span<const std::byte> bytes, const std::string& name) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!rest.starts_with(kSignature)) return;
  rest.remove_prefix(kSignature.size());
  // IHDR, always the first, begins with width and height.
  if (rest.size() >= 16 && rest.substr(kLengthBytes, kTypeBytes) == "IHDR")
    checkImageSize(name, bigEndian(rest.substr(8)), bigEndian(rest.substr(12)), 1);
  for (;;) {
    if (rest.size() < kLengthBytes + kTypeBytes)
      throw fileError(name, "damaged or truncated", "ends without an IEND chunk");
    const std::size_t length = bigEndian(rest);
    const std::string_view type = rest.substr(kLengthBytes, kTypeBytes);
    if (!std::all_of(type.begin(), type.end(), [](unsigned char c) { return std::isalpha(c); }))
      throw fileError(name, "damaged or truncated", "a chunk has no proper name");
    if (rest.size() - kLengthBytes - kTypeBytes < length + kChecksumBytes)
      throw fileError(name, "damaged or truncated", fmt::format("ends within a chunk {}", type));
    const std::string_view checked = rest.substr(kLengthBytes, kTypeBytes + length);
    const std::uint32_t checksum = bigEndian(rest.substr(kLengthBytes + kTypeBytes + length));
    if (crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()) != checksum)
      throw fileError(name, "damaged or truncated", fmt::format("a chunk {} does not match its checksum", type));
    if (type == "IEND") return; // whatever follows is no part of the image
    rest.remove_prefix(kLengthBytes + kTypeBytes + length + kChecksumBytes);
  }
}

} // namespace parity::base

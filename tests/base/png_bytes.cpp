// PNG files made by hand (ISO/IEC 15948).
#include "png_bytes.h"

#include <stdexcept>

#include <zlib.h>

namespace parity::base {

namespace {

std::string bigEndian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

} // namespace

std::string makePngChunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return bigEndian(static_cast<std::uint32_t>(data.size())) + checked + bigEndian(static_cast<std::uint32_t>(crc));
}

std::vector<std::byte> makePng(const PngHeader& header, std::span<const std::uint8_t> samples,
                               const std::string& extra) {
  std::string rows;
  const std::size_t rowBytes = header.height ? samples.size() / header.height : 0;
  for (std::size_t y = 0; y < header.height; ++y) {
    rows += '\0'; // filter: none
    rows.append(reinterpret_cast<const char*>(samples.data()) + y * rowBytes, rowBytes);
  }
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
               rows.size()) != Z_OK)
    throw std::runtime_error("zlib refused");
  packed.resize(size);
  const std::string file =
      "\x89PNG\r\n\x1a\n" +
      makePngChunk("IHDR", bigEndian(header.width) + bigEndian(header.height) + static_cast<char>(header.bitDepth) +
                               static_cast<char>(header.colorType) + std::string(3, '\0')) +
      extra + makePngChunk("IDAT", packed) + makePngChunk("IEND", "");
  const auto* begin = reinterpret_cast<const std::byte*>(file.data());
  return {begin, begin + file.size()};
}

} // namespace parity::base

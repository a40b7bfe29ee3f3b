// PNG (ISO/IEC 15948): four chunks, of which one holds the picture as libdeflate packs it.
#include "base/image/png_write.h"

#include <array>
#include <memory>
#include <new>
#include <string_view>

#include <libdeflate.h>

#include "base/image/png_filter.h"

namespace parity::base {

namespace {

void append(std::vector<std::byte>& bytes, std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  bytes.insert(bytes.end(), begin, begin + text.size());
}

void append32(std::vector<std::byte>& bytes, std::size_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(value >> shift));
}

// Writes a chunk, whose content is what add() appends.
template <typename Add> void appendChunk(std::vector<std::byte>& file, std::string_view type, const Add& add) {
  const std::size_t begin = file.size();
  append32(file, 0);
  append(file, type);
  add();
  const std::size_t length = file.size() - begin - 8;
  for (std::size_t i = 0; i < 4; ++i) file[begin + i] = static_cast<std::byte>(length >> (24 - 8 * i));
  append32(file, libdeflate_crc32(0, file.data() + begin + 4, length + 4));
}

// Every row behind the number of its filter.
std::vector<std::uint8_t> filterRows(const Image8& image) {
  const std::size_t stride = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  std::vector<std::uint8_t> rows;
  rows.reserve((1 + stride) * static_cast<std::size_t>(image.height));
  const std::vector<std::uint8_t> zeros(stride);
  const std::uint8_t* above = zeros.data();
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(y) * stride;
    rows.push_back(static_cast<std::uint8_t>(PngFilter::paeth));
    rows.resize(rows.size() + stride);
    filterByPaeth(row, above, stride, image.channels, rows.data() + rows.size() - stride);
    above = row;
  }
  return rows;
}

void appendZlib(std::vector<std::byte>& file, const std::vector<std::uint8_t>& rows, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const std::size_t before = file.size();
  file.resize(before + libdeflate_zlib_compress_bound(compressor.get(), rows.size()));
  file.resize(before + libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), file.data() + before,
                                                file.size() - before));
}

} // namespace

std::vector<std::byte> encodePng(const Image8& image, int compression) {
  const std::vector<std::uint8_t> rows = filterRows(image);
  std::vector<std::byte> file;
  file.reserve(rows.size() / 4);
  append(file, "\x89PNG\r\n\x1a\n");
  appendChunk(file, "IHDR", [&] {
    append32(file, static_cast<std::size_t>(image.width));
    append32(file, static_cast<std::size_t>(image.height));
    constexpr std::array<char, 4> kColorTypes{0, 4, 2, 6}; // grey, grey and alpha, RGB, RGBA
    const char tail[] = {8, kColorTypes[static_cast<std::size_t>(image.channels - 1)], 0, 0, 0};
    append(file, {tail, sizeof(tail)});
  });
  appendChunk(file, "IDAT", [&] { appendZlib(file, rows, compression); });
  appendChunk(file, "IEND", [] {});
  return file;
}

} // namespace parity::base

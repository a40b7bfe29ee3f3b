// Planes of 16-bit values: the pixels that differ from the one before, bytes apart, DEFLATE by libdeflate, base64.
#include "report/pixel_chunk.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <libdeflate.h>

#include "base/raw_vector.h"
#include "report/base64.h"
#include "report/pixel_row.h"

namespace parity::report {
namespace {

constexpr std::string_view kHead = "parityChunk({\"file\":\"", kEnd = "});\n";
constexpr int kLevel = 1; // 4 ns a byte; 6 takes 2.6 times as long for 5 % fewer bytes

const char* nameOf(PlaneKind kind) {
  constexpr const char* kNames[] = {"rgb16f", "unorm16", "uint16"};
  return kNames[static_cast<std::size_t>(kind)];
}

// The pixels that differ from the one before.
struct Changes {
  std::vector<std::byte> where;               // a bit a pixel, from the lowest of each byte on
  base::RawVector<std::uint16_t> differences; // `channels` of each, modulo 65536
  std::size_t count = 0;                      // pixels that differ; the differences behind theirs mean nothing
};

template <std::size_t channels> Changes findChanges(const base::Image& image, PlaneKind kind) {
  const auto width = static_cast<std::size_t>(image.width), pixels = image.pixelCount();
  Changes changes{std::vector<std::byte>((pixels + 7) / 8), base::RawVector<std::uint16_t>(channels * pixels), 0};
  std::vector<std::uint16_t> row(width * channels);
  std::array<std::uint16_t, channels> before{};
  for (std::size_t pixel = 0; pixel < pixels;) {
    packRow({image.pixels.data() + pixel * channels, row.size()}, kind, row);
    for (std::size_t x = 0; x < width; ++x, ++pixel) {
      std::uint16_t* to = changes.differences.data() + channels * changes.count; // kept only if the pixel differs
      bool differs = false;
      for (std::size_t c = 0; c < channels; ++c) {
        const std::uint16_t value = row[x * channels + c];
        to[c] = static_cast<std::uint16_t>(value - before[c]);
        differs |= to[c] != 0;
        before[c] = value;
      }
      changes.where[pixel / 8] |= static_cast<std::byte>(differs << pixel % 8);
      changes.count += differs;
    }
  }
  return changes;
}

// The bits, then channel by channel the low and the high bytes of the differences.
template <std::size_t channels> std::vector<std::byte> packChanges(const base::Image& image, PlaneKind kind) {
  Changes changes = findChanges<channels>(image, kind);
  std::vector<std::byte> bytes = std::move(changes.where);
  const std::size_t begin = bytes.size();
  bytes.resize(begin + 2 * channels * changes.count);
  for (std::size_t c = 0; c < channels; ++c) {
    std::byte *low = bytes.data() + begin + 2 * c * changes.count, *high = low + changes.count;
    for (std::size_t i = 0; i < changes.count; ++i) {
      const std::uint16_t difference = changes.differences[i * channels + c];
      low[i] = static_cast<std::byte>(difference & 255);
      high[i] = static_cast<std::byte>(difference >> 8);
    }
  }
  return bytes;
}

std::vector<std::byte> deflate(const std::vector<std::byte>& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> out(libdeflate_deflate_compress_bound(compressor.get(), bytes.size()));
  out.resize(libdeflate_deflate_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  assert(!out.empty()); // the bound is enough
  return out;
}

std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace

EncodedPlane encodePlane(const PixelPlane& plane) {
  const base::Image& image = *plane.values;
  const bool isColor = plane.kind == PlaneKind::rgb16f;
  assert(image.channels == (isColor ? 3 : 1));
  return {plane.name, plane.kind,
          toBase64(deflate(isColor ? packChanges<3>(image, plane.kind) : packChanges<1>(image, plane.kind)))};
}

std::vector<std::byte> makeChunk(std::string_view file, int width, int height, std::span<const EncodedPlane> planes,
                                 std::span<const std::pair<std::string_view, int>> members) {
  const std::string head =
      fmt::format("{}{}\",\"format\":2,\"width\":{},\"height\":{},\"planes\":[", kHead, file, width, height);
  std::vector<std::byte> bytes;
  const auto append = [&](std::string_view text) {
    const auto more = std::as_bytes(std::span(text));
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  std::size_t size = 1000;
  for (const EncodedPlane& plane : planes) size += plane.data.size() + 100;
  bytes.reserve(size);
  append(head);
  for (const EncodedPlane& plane : planes) {
    append(fmt::format("{}{{\"name\":\"{}\",\"kind\":\"{}\",\"data\":\"", &plane == planes.data() ? "" : ",",
                       plane.name, nameOf(plane.kind)));
    append(plane.data);
    append("\"}");
  }
  append("]");
  for (const auto& [name, value] : members) append(fmt::format(",\"{}\":{}", name, value));
  append(kEnd);
  return bytes;
}

void renameChunk(std::vector<std::byte>& chunk, std::string_view file) {
  const std::string_view text = textOf(chunk);
  assert(text.starts_with(kHead));
  const auto from = chunk.begin() + static_cast<std::ptrdiff_t>(kHead.size());
  const auto name = std::as_bytes(std::span(file));
  const auto to = chunk.begin() + static_cast<std::ptrdiff_t>(text.find('"', kHead.size()));
  chunk.insert(chunk.erase(from, to), name.begin(), name.end());
}

std::string_view chunkObject(std::span<const std::byte> chunk) {
  const std::string_view text = textOf(chunk);
  const std::size_t from = text.find('{');
  return text.substr(from, text.size() - (kEnd.size() - 1) - from);
}

} // namespace parity::report

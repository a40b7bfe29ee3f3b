// Planes of 16-bit values: differences, bytes apart, DEFLATE by libdeflate, base64.
#include "compare/pixel_chunk.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>

#include <fmt/format.h>
#include <libdeflate.h>

#include "compare/base64.h"
#include "shading/half.h"

namespace parity::compare {
namespace {

constexpr std::string_view kHead = "parityChunk({\"file\":\"", kEnd = "});\n";
constexpr int kLevel = 1;

const char* nameOf(PlaneKind kind) {
  constexpr const char* kNames[] = {"rgb16f", "unorm16", "uint16"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::uint16_t toHalf(float value) {
  if (std::isnan(value)) return 0x7e00; // whatever its sign and payload
  if (std::isfinite(value)) value = std::clamp(value, -65504.f, 65504.f);
  return shading::Half(value).bits();
}

std::uint16_t toWhole(float value) { // rounds; a NaN is the largest
  return value < 65535.f ? static_cast<std::uint16_t>(std::max(value, 0.f) + 0.5f) : std::uint16_t{65535};
}

std::uint16_t store(float value, PlaneKind kind) {
  switch (kind) {
  case PlaneKind::rgb16f:
    return toHalf(value);
  case PlaneKind::unorm16:
    return toWhole(value * 65535.f);
  case PlaneKind::uint16:
    break;
  }
  return toWhole(value);
}

// Low bytes and high bytes of one channel's differences, behind what `out` points to.
void splitChannel(const base::Image& image, int channel, PlaneKind kind, std::byte* out) {
  const std::size_t count = image.pixelCount();
  const float* value = image.pixels.data() + channel;
  std::byte *low = out, *high = out + count;
  std::uint16_t above = 0;
  for (int y = 0; y < image.height; ++y) {
    std::uint16_t left = above;
    for (int x = 0; x < image.width; ++x, value += image.channels) {
      const std::uint16_t here = store(*value, kind);
      const auto difference = static_cast<std::uint16_t>(here - left);
      *low++ = static_cast<std::byte>(difference & 255);
      *high++ = static_cast<std::byte>(difference >> 8);
      left = here;
      if (x == 0) above = here;
    }
  }
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
  assert(image.channels == (plane.kind == PlaneKind::rgb16f ? 3 : 1));
  std::vector<std::byte> bytes(2 * image.pixels.size());
  for (int c = 0; c < image.channels; ++c)
    splitChannel(image, c, plane.kind, bytes.data() + 2 * image.pixelCount() * static_cast<std::size_t>(c));
  return {plane.name, plane.kind, toBase64(deflate(bytes))};
}

std::vector<std::byte> makeChunk(std::string_view file, int width, int height, std::span<const EncodedPlane> planes,
                                 std::span<const std::pair<std::string_view, int>> members) {
  std::string text =
      fmt::format("{}{}\",\"format\":1,\"width\":{},\"height\":{},\"planes\":[", kHead, file, width, height);
  for (const EncodedPlane& plane : planes)
    text += fmt::format("{}{{\"name\":\"{}\",\"kind\":\"{}\",\"data\":\"{}\"}}", &plane == planes.data() ? "" : ",",
                        plane.name, nameOf(plane.kind), plane.data);
  text += ']';
  for (const auto& [name, value] : members) text += fmt::format(",\"{}\":{}", name, value);
  text += kEnd;
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
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

} // namespace parity::compare

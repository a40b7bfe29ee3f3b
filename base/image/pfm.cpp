// Portable float maps (PFM, after P. Debevec's description): a text header, then rows of floats from the bottom up.
#include "base/image/pfm.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <locale>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"

namespace parity::base {

namespace {

static_assert(std::endian::native == std::endian::little);

struct PfmHeader {
  int width = 0, height = 0, channels = 0;
  bool bigEndian = false;
  std::size_t bytes = 0; // of the header itself
};

// "PF|Pf <width> <height> <scale>" and one white space. The sign of the scale gives the byte order (negative: little);
// its size is a unit that no program agrees on, so it is not applied.
PfmHeader parseHeader(const std::string& name, std::span<const std::byte> bytes) {
  constexpr std::size_t kMaxHeaderBytes = 256;
  std::istringstream text(std::string(reinterpret_cast<const char*>(bytes.data()), //
                                      std::min(bytes.size(), kMaxHeaderBytes)));
  text.imbue(std::locale::classic());
  std::string magic;
  PfmHeader header;
  double scale = 0;
  text >> magic;
  if (magic != "PF" && magic != "Pf") throw fileError(name, "", "is not a PFM image: it must begin with PF or Pf");
  text >> header.width >> header.height >> scale;
  if (!text || text.peek() == std::istringstream::traits_type::eof() || !std::isfinite(scale) || scale == 0)
    throw fileError(name, "header", "has no width, height and scale");
  text.get();
  header.channels = magic == "PF" ? 3 : 1;
  header.bigEndian = scale > 0;
  header.bytes = static_cast<std::size_t>(text.tellg());
  return header;
}

std::uint32_t swapBytes(std::uint32_t v) { return v << 24 | (v << 8 & 0xff0000) | (v >> 8 & 0xff00) | v >> 24; }

} // namespace

Image readPfm(const std::filesystem::path& file, const ImageLimits& limits) {
  return decodePfm(readFile(file), file.string(), limits);
}

Image decodePfm(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits) {
  const PfmHeader header = parseHeader(name, bytes);
  checkImageSize(name, header.width, header.height, header.channels, limits);
  const std::size_t rowValues = static_cast<std::size_t>(header.width) * header.channels;
  checkImageBytes(name, fmt::format("an image of {} x {} pixels", header.width, header.height),
                  rowValues * header.height * sizeof(float), limits.maxBytes);
  const std::size_t expected = header.bytes + rowValues * header.height * sizeof(float);
  if (bytes.size() != expected)
    throw fileError(name, "",
                    fmt::format("has {} bytes, but {} x {} pixels need {}{}", bytes.size(), header.width, header.height,
                                expected, bytes.size() < expected ? " (truncated)" : ""));

  Image image(header.width, header.height, header.channels);
  const std::byte* source = bytes.data() + header.bytes;
  for (int y = header.height - 1; y >= 0; --y, source += rowValues * sizeof(float))
    std::memcpy(image.at(0, y), source, rowValues * sizeof(float));
  if (header.bigEndian)
    for (float& value : image.pixels) value = std::bit_cast<float>(swapBytes(std::bit_cast<std::uint32_t>(value)));
  return image;
}

ImageShape readPfmShape(std::span<const std::byte> head, const std::string& name, const ImageLimits& limits) {
  const PfmHeader header = parseHeader(name, head);
  checkImageSize(name, header.width, header.height, header.channels, limits);
  return {header.width, header.height, header.channels, false};
}

void writePfm(const std::filesystem::path& file, const Image& image) {
  const std::string name = file.string();
  checkImageSize(name, image.width, image.height, image.channels);
  if (image.channels != 1 && image.channels != 3)
    throw fileError(name, "", fmt::format("PFM holds 1 or 3 channels, not {}", image.channels));
  const std::string header =
      fmt::format("{}\n{} {}\n-1.0\n", image.channels == 3 ? "PF" : "Pf", image.width, image.height);
  const std::size_t rowBytes = static_cast<std::size_t>(image.width) * image.channels * sizeof(float);
  std::vector<std::byte> bytes(header.size() + rowBytes * image.height);
  std::memcpy(bytes.data(), header.data(), header.size());
  std::byte* target = bytes.data() + header.size();
  for (int y = image.height - 1; y >= 0; --y, target += rowBytes) std::memcpy(target, image.at(0, y), rowBytes);
  writeBytes(file, bytes);
}

} // namespace parity::base

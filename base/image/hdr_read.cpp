#include "base/image/hdr_read.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace parity::base {

namespace {

// The rest of a file, from the front.
class Text {
public:
  explicit Text(std::span<const std::byte> bytes) : m_rest(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  // Nothing where none ends.
  std::optional<std::string_view> line() {
    const std::size_t end = m_rest.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view found = m_rest.substr(0, end);
    m_rest.remove_prefix(end + 1);
    return found;
  }
  std::string_view rest() const { return m_rest; }

private:
  std::string_view m_rest;
};

// "EXPOSURE=          1.0000000000000", as stb writes it.
bool isExposureOfOne(std::string_view line) {
  constexpr std::string_view kName = "EXPOSURE=";
  if (!line.starts_with(kName)) return false;
  line.remove_prefix(std::min(line.find_first_not_of(' ', kName.size()), line.size()));
  double exposure = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), exposure);
  return error == std::errc() && end == line.data() + line.size() && exposure == 1;
}

// Whether a variable of the header leaves the values as they are, and is none that the image library describes.
bool isPlain(std::string_view line) {
  return line.starts_with('#') || line == "GAMMA=1" || line.starts_with("PRIMARIES=") ||
         line.starts_with("SOFTWARE=") || isExposureOfOne(line);
}

bool readVariables(Text& text) {
  const std::optional<std::string_view> first = text.line();
  if (!first || (*first != "#?RADIANCE" && *first != "#?RGBE")) return false;
  bool hasFormat = false;
  while (const std::optional<std::string_view> line = text.line()) {
    if (line->empty()) return hasFormat;
    const bool isFormat = *line == "FORMAT=32-bit_rle_rgbe";
    if (!isFormat && !isPlain(*line)) return false;
    hasFormat |= isFormat;
  }
  return false;
}

struct Size {
  int width = 0, height = 0;
};

// "-Y 512 +X 1024".
std::optional<Size> readSize(std::string_view line) {
  Size size;
  const auto take = [&](std::string_view name, int& value) {
    if (!line.starts_with(name)) return false;
    line.remove_prefix(name.size());
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc() || value < 1) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return true;
  };
  if (!take("-Y ", size.height) || !take(" +X ", size.width) || !line.empty()) return std::nullopt;
  return size;
}

// One of the four planes of a scanline: runs of one value, and values as they are. False where it is damaged.
bool unpack(std::string_view& rest, std::span<std::uint8_t> plane) {
  for (std::size_t at = 0; at < plane.size();) {
    if (rest.empty()) return false;
    const auto head = static_cast<std::uint8_t>(rest[0]);
    const bool isRun = head > 128;
    const std::size_t count = isRun ? head - 128u : head, bytes = isRun ? 1 : count;
    if (count == 0 || count > plane.size() - at || rest.size() < 1 + bytes) return false;
    for (std::size_t i = 0; i < count; ++i) plane[at + i] = static_cast<std::uint8_t>(rest[isRun ? 1 : 1 + i]);
    at += count;
    rest.remove_prefix(1 + bytes);
  }
  return true;
}

// A scanline's values, red, green and blue; planes: of its length, four of them.
bool readLine(std::string_view& rest, int width, std::vector<std::uint8_t>& planes, float* to) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(rest[i]); };
  if (rest.size() < 4 || byte(0) != 2 || byte(1) != 2 || (byte(2) << 8 | byte(3)) != width) return false;
  rest.remove_prefix(4);
  const auto n = static_cast<std::size_t>(width);
  for (std::size_t plane = 0; plane < 4; ++plane)
    if (!unpack(rest, std::span(planes).subspan(plane * n, n))) return false;
  static const auto kScales = [] {
    std::array<float, 256> scales{}; // an exponent of 0 is black
    for (int e = 1; e < 256; ++e) scales[static_cast<std::size_t>(e)] = static_cast<float>(std::ldexp(1.0, e - 136));
    return scales;
  }();
  for (std::size_t x = 0; x < n; ++x) {
    const std::uint8_t exponent = planes[3 * n + x];
    // The image library (2.4) has three powers of two less their last bit; pixels of a picture hardly have them.
    if (exponent == 40 || exponent == 223 || exponent == 226) return false;
    const float scale = kScales[exponent];
    for (std::size_t c = 0; c < 3; ++c) to[3 * x + c] = static_cast<float>(planes[c * n + x]) * scale;
  }
  return true;
}

} // namespace

std::optional<ImageFile> readHdr(std::span<const std::byte> bytes, const ImageLimits& limits) {
  constexpr int kLeastWidth = 8, kMostWidth = 32767; // of scanlines in runs
  Text text(bytes);
  if (!readVariables(text)) return std::nullopt;
  const std::optional<std::string_view> line = text.line();
  const std::optional<Size> size = line ? readSize(*line) : std::nullopt;
  if (!size || size->width < kLeastWidth || size->width > kMostWidth) return std::nullopt;
  const auto width = static_cast<std::size_t>(size->width), height = static_cast<std::size_t>(size->height);
  if (width > limits.maxSide || height > limits.maxSide || width * height > limits.maxPixels ||
      width * height > kMaxImagePixels || width * height * 3 * sizeof(float) > limits.maxBytes)
    return std::nullopt;

  ImageFile file;
  Image& image = file.pixels;
  image.width = size->width, image.height = size->height, image.channels = 3;
  image.pixels.reserve(3 * width * height);
  std::vector<std::uint8_t> planes(4 * width);
  std::string_view rest = text.rest();
  for (std::size_t y = 0; y < height; ++y) { // a file that ends early has memory touched for no more than it holds
    image.pixels.resize(3 * width * (y + 1));
    if (!readLine(rest, size->width, planes, image.pixels.data() + 3 * width * y)) return std::nullopt;
  }
  file.info.bits = 32;
  file.info.channelNames = {"R", "G", "B"};
  file.info.declaredLinear = true;
  file.info.fullWidth = size->width;
  file.info.fullHeight = size->height;
  return file;
}

} // namespace parity::base

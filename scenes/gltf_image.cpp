// Images of a glTF file: read, checked against the limits by their headers, decoded in parallel.
#include "scenes/gltf_image.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "base/file.h"
#include "base/image_io.h"
#include "base/parallel.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxImageBytes = std::size_t{512} << 20;
constexpr std::array<unsigned char, 8> kPngStart = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::size_t readBig(std::span<const std::byte> bytes, std::size_t offset, int count) {
  std::size_t value = 0;
  for (int i = 0; i < count; ++i)
    value = value << 8 | static_cast<std::size_t>(bytes[offset + static_cast<std::size_t>(i)]);
  return value;
}

bool isPng(std::span<const std::byte> bytes) {
  return bytes.size() >= kPngStart.size() && std::memcmp(bytes.data(), kPngStart.data(), kPngStart.size()) == 0;
}

bool isJpeg(std::span<const std::byte> bytes) { return bytes.size() >= 3 && readBig(bytes, 0, 3) == 0xffd8ff; }

// The frame header of a JPEG (ITU-T T.81, B.2.2), and where its first scan begins.
struct JpegLayout {
  ImageSize size;
  std::size_t scan = 0; // 0: none
};

JpegLayout layoutOfJpeg(std::span<const std::byte> bytes) {
  JpegLayout layout;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (readBig(bytes, at, 1) != 0xff) return layout;
    const std::size_t marker = readBig(bytes, at + 1, 1);
    if (marker == 0xff) { // fill byte
      ++at;
      continue;
    }
    const std::size_t length = readBig(bytes, at + 2, 2);
    const bool isFrame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (isFrame && at + 9 <= bytes.size()) layout.size = {readBig(bytes, at + 7, 2), readBig(bytes, at + 5, 2)};
    if (marker == 0xda) {
      layout.scan = at;
      return layout;
    }
    at += 2 + std::max<std::size_t>(length, 2);
  }
  return layout;
}

// Decoders fill what a cut-off JPEG lacks with grey. Within a scan 0xff is always followed by 0 or a restart marker, so
// the end marker appears only where the image ends.
bool endsEarly(std::span<const std::byte> bytes) {
  const std::size_t scan = layoutOfJpeg(bytes).scan;
  if (scan == 0) return true;
  const std::array end = {std::byte{0xff}, std::byte{0xd9}};
  const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(scan);
  return std::search(from, bytes.end(), end.begin(), end.end()) == bytes.end();
}

} // namespace

ImageSize sniffImageSize(std::span<const std::byte> bytes) {
  if (isPng(bytes) && bytes.size() >= 24) return {readBig(bytes, 16, 4), readBig(bytes, 20, 4)};
  if (isJpeg(bytes)) return layoutOfJpeg(bytes).size;
  return {};
}

DecodedImages decodeImages(const GltfDocument& document, const std::vector<int>& used) {
  std::vector<std::vector<std::byte>> files(used.size());
  std::vector<std::span<const std::byte>> encoded(used.size());
  std::vector<std::string> places(used.size());
  DecodedImages decoded;
  std::size_t texels = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const GltfImageSource& source = document.images[static_cast<std::size_t>(used[i])];
    places[i] = fmt::format("images[{}] '{}'", used[i], source.name);
    if (source.bufferView >= 0)
      encoded[i] = document.bufferView(source.bufferView);
    else if (!source.file.empty()) {
      try {
        files[i] = base::readFile(source.file, kMaxImageBytes);
      } catch (const base::Error& error) {
        throw document.error(places[i], error.reason());
      }
      encoded[i] = files[i];
      decoded.sources.push_back(sourceFile(source.named, files[i]));
    } else
      encoded[i] = source.embedded;

    if (encoded[i].empty()) throw document.error(places[i], "the image is empty");
    if (!isPng(encoded[i]) && !isJpeg(encoded[i])) throw document.error(places[i], "neither a PNG nor a JPEG image");
    const ImageSize size = sniffImageSize(encoded[i]);
    if (size.width == 0 || size.height == 0)
      throw document.error(places[i], "a width or height of 0, or a truncated header");
    if (size.width > base::kMaxImageSide || size.height > base::kMaxImageSide)
      throw document.error(
          places[i], fmt::format("{}x{} pixels are more than {} a side", size.width, size.height, base::kMaxImageSide));
    texels += size.width * size.height;
    if (texels > kMaxTexels)
      throw document.error(places[i], fmt::format("the images of a scene may have {} texels together", kMaxTexels));
    if (isJpeg(encoded[i]) && endsEarly(encoded[i])) throw document.error(places[i], "truncated: no end marker");
  }

  std::vector<TextureImage>& images = decoded.images;
  images.resize(used.size());
  base::parallelFor(used.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      images[i].name = document.images[static_cast<std::size_t>(used[i])].name;
      try {
        images[i].pixels = base::decodeImage8(encoded[i], images[i].name, 4);
      } catch (const base::Error& error) {
        throw document.error(places[i], error.reason());
      }
    }
  });
  return decoded;
}

} // namespace parity::scenes

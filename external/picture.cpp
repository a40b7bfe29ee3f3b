#include "external/picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image/image_io.h"
#include "base/parallel.h"

namespace parity::external {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw base::Error(base::ExitCode::notComparable, file.string(), "", reason);
}

// Rec.709 with its white, as files say it.
bool isRec709(const std::array<float, 8>& given) {
  constexpr std::array<float, 8> kRec709 = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  return std::ranges::equal(given, kRec709, [](float a, float b) { return std::abs(a - b) < 0.002f; });
}

// A whole upright picture in colour.
void requireWhole(const std::filesystem::path& file, const base::ImageFile& read) {
  const base::ImageInfo& info = read.info;
  if (info.images > 1) refuse(file, "holds several pictures; one is needed");
  if (info.isCubeMap) refuse(file, "is a cube map");
  if (info.orientation != 1) refuse(file, "is turned by its EXIF orientation; write it upright");
  if (info.fullWidth > 0 && (info.x != info.fullX || info.y != info.fullY || info.fullWidth != read.pixels.width ||
                             info.fullHeight != read.pixels.height))
    refuse(file, "holds a part of a picture only (its data window is not its display window)");
  if (read.pixels.channels < 3) refuse(file, "is grey; a picture in colour is needed");
}

} // namespace

base::Image toLight(const base::Image& rgb, const Encoding& encoding) {
  base::Image light = rgb;
  if (encoding.isLinear()) return light;
  base::parallelFor(rgb.pixelCount(), 4096, [&](std::size_t begin, std::size_t end) {
    const float* last = nullptr; // neighbours are often alike
    for (std::size_t i = begin; i < end; ++i) {
      const float* from = &rgb.pixels[3 * i];
      float* to = &light.pixels[3 * i];
      if (last && std::equal(from, from + 3, last)) {
        std::copy_n(to - 3, 3, to);
      } else {
        const Rgb decoded = encoding.decode({from[0], from[1], from[2]});
        for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(decoded[c]);
      }
      last = from;
    }
  });
  return light;
}

base::Image readValues(const std::filesystem::path& file) {
  const base::ImageFile read = base::readImageFile(file);
  requireWhole(file, read);
  base::Image values(read.pixels.width, read.pixels.height, 3);
  for (std::size_t i = 0; i < values.pixelCount(); ++i)
    std::copy_n(&read.pixels.pixels[static_cast<std::size_t>(read.pixels.channels) * i], 3, &values.pixels[3 * i]);
  if (!std::ranges::all_of(values.pixels, [](float v) { return std::isfinite(v); }))
    refuse(file, "has values that are not finite");
  return values;
}

Picture readPicture(const std::filesystem::path& file, int width, int height, const Encoding& encoding) {
  const base::ImageFile read = base::readImageFile(file);
  const base::ImageInfo& info = read.info;
  if (read.pixels.width != width || read.pixels.height != height)
    refuse(file,
           fmt::format("is {} x {} pixels; the view is {} x {}", read.pixels.width, read.pixels.height, width, height));
  requireWhole(file, read);
  if (!info.integer && !encoding.isLinear())
    refuse(file, fmt::format("holds floats, which are linear light; its transfer is '{}'", encoding.name()));
  if (info.declaredLinear && info.integer && !encoding.isLinear())
    refuse(file, fmt::format("says that its values are linear; its transfer is '{}'", encoding.name()));
  if (info.chromaticities && !isRec709(*info.chromaticities)) refuse(file, "has other primaries than Rec.709");

  Picture picture;
  base::Image rgb(width, height, 3);
  const bool hasAlpha = info.alphaChannel >= 0;
  if (hasAlpha) picture.alpha = base::Image(width, height, 1);
  picture.clipped.resize(rgb.pixelCount());
  const auto channels = static_cast<std::size_t>(read.pixels.channels);
  for (std::size_t i = 0; i < rgb.pixelCount(); ++i) {
    const float* from = &read.pixels.pixels[channels * i];
    std::copy_n(from, 3, &rgb.pixels[3 * i]);
    if (hasAlpha) picture.alpha.pixels[i] = from[info.alphaChannel];
    picture.clipped[i] = encoding.isClipped({from[0], from[1], from[2]});
  }
  picture.light = toLight(rgb, encoding);
  return picture;
}

} // namespace parity::external

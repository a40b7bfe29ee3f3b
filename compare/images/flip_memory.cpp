// How much memory comparing a pair of pictures takes, by their headers.
#include "compare/images/flip_memory.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image/image_limits.h"

namespace parity::compare {

namespace {

constexpr std::size_t kRgbBytes = 3 * sizeof(float), kPlaneBytes = sizeof(float);
constexpr std::size_t kFixedBytes = std::size_t{256} << 20; // of the program and its libraries

// Of a pixel, while a picture is read: its values as stored, what the decoder holds of them (at most 16 bit of an
// integer, and nothing of floats in lines), and where they are not the three of a colour, the colour and alpha.
std::size_t readingBytes(const base::ImageShape& shape) {
  const auto channels = static_cast<std::size_t>(shape.channels);
  return channels * (sizeof(float) + (shape.integer ? 2 : 0)) + (channels == 3 ? 0 : kRgbBytes + kPlaneBytes);
}

// Of a pixel, while it is measured: both colours (18 bytes more than two of 8 bits take); of floats also what is
// displayed; alpha; the list of the region's pixels, the map that is kept, and five at work (no metric but
// the SSIMs takes more).
std::size_t measuringBytes(const base::ImageShape& reference, const base::ImageShape& test,
                           const FlipRequest& request) {
  std::size_t bytes = 7 * kPlaneBytes;
  for (const base::ImageShape* shape : {&reference, &test})
    bytes += kRgbBytes * (shape->integer ? 1 : 2) + (shape->channels == 2 || shape->channels == 4 ? kPlaneBytes : 0);
  const bool isHdr = request.range == DynamicRange::hdr || !(reference.integer || test.integer);
  if (isHdr) bytes += 2 * kPlaneBytes; // the exposure map, and exposures at work
  if (request.range == DynamicRange::hdr) bytes += 2 * kRgbBytes;
  const auto asks = [&](const std::string& metric) {
    return std::any_of(request.metrics.begin(), request.metrics.end(),
                       [&](const std::string& name) { return name == metric; });
  };
  if (asks("ssim") || asks("msssim")) bytes += 6 * kPlaneBytes; // lumas, and their blurred moments
  if (request.image.alpha == AlphaMode::channel) bytes += 2 * kRgbBytes;
  if (!request.mask.file.empty()) bytes += 2 * kPlaneBytes;
  return bytes;
}

} // namespace

std::size_t estimateFlipBytes(const base::ImageShape& reference, const base::ImageShape& test,
                              const FlipRequest& request) {
  const auto pixels = [](const base::ImageShape& shape) {
    return static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height);
  };
  const std::size_t reading = pixels(reference) * readingBytes(reference) + pixels(test) * readingBytes(test);
  const std::size_t measuring = std::max(pixels(reference), pixels(test)) * measuringBytes(reference, test, request);
  return kFixedBytes + std::max(reading, measuring);
}

void requireFlipMemory(const FlipRequest& request, const FilePair& files) {
  const base::ImageLimits& limits = request.image.limits;
  const base::ImageShape reference = base::readImageShape(files.reference, limits);
  const base::ImageShape test = base::readImageShape(files.test, limits);
  base::checkImageBytes(
      files.test.string(),
      fmt::format("comparing {}x{} pixels with {}x{}", test.width, test.height, reference.width, reference.height),
      estimateFlipBytes(reference, test, request), limits.maxBytes);
}

} // namespace parity::compare

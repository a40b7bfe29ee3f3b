#include "compare/metrics/metric_input.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace parity::compare {
namespace {

constexpr std::size_t kGrainRows = 64;

std::string shapeOf(const PixelView& view) {
  return std::to_string(view.width) + " x " + std::to_string(view.height) + " x " + std::to_string(view.channels);
}

base::Error unlike(const std::string& reason) {
  return base::Error(base::ExitCode::notComparable, "images", "", reason);
}

void requireShape(const PixelView& view, const PixelView& like, const char* name) {
  if (view.empty()) throw base::Error(base::ExitCode::notComparable, name, "", "the image has no pixels");
  if (view.width != like.width || view.height != like.height || view.channels != like.channels)
    throw unlike("the reference is " + shapeOf(like) + " (channels last), the " + name + " " + shapeOf(view));
  if (view.channels != 3) throw unlike("3 channels are needed, not " + std::to_string(view.channels));
}

const float* rowOf(const PixelView& view, int y) { return view.floats + static_cast<std::ptrdiff_t>(y) * view.stride; }

bool isFinite(const float* pixel, int channels) {
  return std::all_of(pixel, pixel + channels, [](float v) { return std::isfinite(v); });
}

// Appends the pixels of float images that hold NaN or infinity. Returns whether there are any.
bool findNonFinite(const PixelView& view, std::vector<std::uint32_t>& found) {
  if (!view.floats) return false;
  std::vector<std::uint8_t> dirty(static_cast<std::size_t>(view.height), 0);
  base::parallelFor(dirty.size(), kGrainRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      // x * 0 is 0 unless x is not finite: eight sums per row say whether any is.
      const float* row = rowOf(view, static_cast<int>(y));
      const int values = view.width * view.channels;
      float sums[8] = {};
      int i = 0;
      for (; i + 8 <= values; i += 8)
        for (int k = 0; k < 8; ++k) sums[k] += row[i + k] * 0.f;
      for (; i < values; ++i) sums[0] += row[i] * 0.f;
      dirty[y] = std::any_of(sums, sums + 8, [](float sum) { return sum != 0.f; });
    }
  });
  const std::size_t before = found.size();
  for (std::size_t y = 0; y < dirty.size(); ++y) {
    if (!dirty[y]) continue;
    const float* row = rowOf(view, static_cast<int>(y));
    for (int x = 0; x < view.width; ++x)
      if (!isFinite(row + x * view.channels, view.channels))
        found.push_back(static_cast<std::uint32_t>(y * static_cast<std::size_t>(view.width)) +
                        static_cast<std::uint32_t>(x));
  }
  return found.size() > before;
}

base::Image finiteCopy(const PixelView& view) {
  base::Image copy(view.width, view.height, view.channels);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const float* pixel = rowOf(view, y) + x * view.channels;
      if (isFinite(pixel, view.channels)) std::copy_n(pixel, view.channels, copy.at(x, y));
    }
  return copy;
}

} // namespace

MetricInput::MetricInput(const ImagePair& pair)
    : reference(pair.reference), test(pair.test), referenceLinear(pair.referenceLinear), testLinear(pair.testLinear),
      nonFinite(pair.invalid.begin(), pair.invalid.end()) {
  requireShape(reference, reference, "reference");
  requireShape(test, reference, "test");
  if (!referenceLinear != !testLinear) throw unlike("only one of them has a linear image");
  if (referenceLinear) {
    requireShape(*referenceLinear, reference, "linear reference");
    requireShape(*testLinear, reference, "linear test");
  }
  for (const std::uint32_t pixel : nonFinite)
    if (pixel >= pixelCount())
      throw base::Error(base::ExitCode::failed, "images", "pixel " + std::to_string(pixel), "is outside the image");

  for (int i = 0; i < 2; ++i) {
    PixelView& view = i == 0 ? reference : test;
    if (findNonFinite(view, nonFinite)) view = m_copies[i] = finiteCopy(view);
    const base::Image*& linear = i == 0 ? referenceLinear : testLinear;
    if (linear && findNonFinite(*linear, nonFinite)) {
      m_copies[2 + i] = finiteCopy(*linear);
      linear = &m_copies[2 + i];
    }
  }
  std::sort(nonFinite.begin(), nonFinite.end());
  nonFinite.erase(std::unique(nonFinite.begin(), nonFinite.end()), nonFinite.end());
}

void setPixels(base::Image& map, std::span<const std::uint32_t> pixels, float value) {
  for (const std::uint32_t pixel : pixels) map.pixels[pixel] = value;
}

} // namespace parity::compare

#include "job/view/displayed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/raw_vector.h"

namespace parity::job {

namespace {

constexpr std::size_t kGrainPixels = 16384;

bool isFinite(const float* rgb) { return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]); }

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255 + 0.5f); }

} // namespace

Displayed displayImage(const base::Image& color, const base::DisplayTransform& display, float exposureEv) {
  if (color.channels != 3 || color.empty())
    throw base::Error(base::ExitCode::failed, "display", "",
                      fmt::format("needs an RGB image, not one of {} channels", color.channels));
  Displayed out{base::Image8(color.width, color.height, 3), {}};
  std::vector<std::vector<std::uint32_t>> nonFinite(color.pixelCount() / kGrainPixels + 1);
  base::parallelFor(color.pixelCount(), kGrainPixels, [&](std::size_t begin, std::size_t end) {
    base::RawVector<float> encoded(3 * (end - begin));
    display.encode(std::span(color.pixels).subspan(3 * begin, encoded.size()), exposureEv, encoded);
    for (std::size_t p = begin; p < end; ++p) {
      const float* shown = &encoded[3 * (p - begin)];
      // The frame decides, not the encoded value: an infinite radiance would be displayed as plain white.
      if (isFinite(&color.pixels[3 * p]) && isFinite(shown))
        std::transform(shown, shown + 3, &out.pixels.pixels[3 * p], toByte);
      else
        nonFinite[begin / kGrainPixels].push_back(static_cast<std::uint32_t>(p));
    }
  });
  for (const auto& part : nonFinite) out.nonFinite.insert(out.nonFinite.end(), part.begin(), part.end());
  return out;
}

base::Image expose(const base::Image& color, float exposureEv) {
  base::Image out = color;
  const float gain = std::exp2(exposureEv);
  for (float& v : out.pixels) v *= gain;
  return out;
}

} // namespace parity::job

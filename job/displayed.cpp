#include "job/displayed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace parity::job {

namespace {

constexpr std::size_t kGrain = 16384;

bool isFinite(const float* rgb) { return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]); }

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255 + 0.5f); }

} // namespace

Displayed displayImage(const base::Image& color, const base::DisplayTransform& display, float exposureEv) {
  const base::Image encoded = display.apply(color, exposureEv);
  Displayed out{base::Image8(color.width, color.height, 3), base::Image(color.width, color.height, 3),
                base::Image(color.width, color.height, 3)};
  base::parallelFor(color.pixelCount(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      // The frame decides, not the encoded value: an infinite radiance would be displayed as plain white.
      const bool finite = isFinite(&color.pixels[3 * p]) && isFinite(&encoded.pixels[3 * p]);
      for (std::size_t k = 3 * p; k < 3 * p + 3; ++k) {
        out.pixels.pixels[k] = finite ? toByte(encoded.pixels[k]) : std::uint8_t{0};
        out.finite.pixels[k] = static_cast<float>(out.pixels.pixels[k]) / 255;
        out.measured.pixels[k] = finite ? out.finite.pixels[k] : std::numeric_limits<float>::quiet_NaN();
      }
    }
  });
  return out;
}

void markNonFinite(base::Image& map, const base::Image& measured) {
  for (std::size_t p = 0; p < map.pixels.size(); ++p)
    if (!isFinite(&measured.pixels[3 * p])) map.pixels[p] = 1;
}

base::Image8 quantize(const base::Image& display) {
  base::Image8 out(display.width, display.height, display.channels);
  std::transform(display.pixels.begin(), display.pixels.end(), out.pixels.begin(), toByte);
  return out;
}

} // namespace parity::job

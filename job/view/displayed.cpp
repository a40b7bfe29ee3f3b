#include "job/view/displayed.h"

#include <cmath>
#include <cstddef>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"

namespace parity::job {

namespace {

constexpr std::size_t kGrainPixels = 16384;

} // namespace

Displayed displayImage(const base::Image& color, const base::DisplayTransform& display, float exposureEv) {
  if (color.channels != 3 || color.empty())
    throw base::Error(base::ExitCode::failed, "display", "",
                      fmt::format("needs an RGB image, not one of {} channels", color.channels));
  Displayed out{base::Image8(color.width, color.height, 3), {}};
  std::vector<std::vector<std::uint32_t>> nonFinite(color.pixelCount() / kGrainPixels + 1);
  base::parallelFor(color.pixelCount(), kGrainPixels, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& found = nonFinite[begin / kGrainPixels];
    display.encodeBytes(std::span(color.pixels).subspan(3 * begin, 3 * (end - begin)), exposureEv,
                        std::span(out.pixels.pixels).subspan(3 * begin, 3 * (end - begin)), found);
    for (std::uint32_t& pixel : found) pixel += static_cast<std::uint32_t>(begin);
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

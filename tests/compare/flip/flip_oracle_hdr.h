// A deliberately plain HDR-FLIP in double precision, over the plain LDR-FLIP.
#pragma once

#include "compare/flip/flip_hdr.h"
#include "flip_oracle.h"

namespace parity::oracle {

// docs/flip-metric.md 6b: (k0 x^2 + k1 x + k2)/(k3 x^2 + k4 x + k5), or RGB/(1 + luminance).
inline Pixel tonemap(compare::Tonemapper tonemapper, const Pixel& c) {
  if (tonemapper == compare::Tonemapper::reinhard) {
    const double scale = 1 + 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    return {c[0] / scale, c[1] / scale, c[2] / scale};
  }
  const bool hable = tonemapper == compare::Tonemapper::hable;
  const auto curve = [&](double x) {
    return hable ? (0.231683 * x * x + 0.013791 * x) / (0.18 * x * x + 0.3 * x + 0.018)
                 : (0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14);
  };
  return {curve(c[0]), curve(c[1]), curve(c[2])};
}

inline Linear expose(const base::Image& image, compare::Tonemapper tonemapper, double ev) {
  Linear out{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const auto value = [&](std::size_t c) { return std::exp2(ev) * static_cast<double>(image.pixels[3 * i + c]); };
    Pixel shown = tonemap(tonemapper, {value(0), value(1), value(2)});
    for (double& v : shown) v = std::clamp(v, 0., 1.);
    out.pixels.push_back(shown);
  }
  return out;
}

struct HdrFlip {
  std::vector<double> flip, exposure;
};

inline HdrFlip flipHdr(const base::Image& reference, const base::Image& test, double ppd,
                       compare::Tonemapper tonemapper, const compare::ExposureRange& range) {
  HdrFlip out{std::vector<double>(reference.pixelCount(), 0), std::vector<double>(reference.pixelCount(), 0)};
  for (int i = 0; i < range.count; ++i) {
    const double share = static_cast<double>(i) / (range.count - 1), start = static_cast<double>(range.start);
    const double ev = start + share * (static_cast<double>(range.stop) - start);
    const Flip ldr = flip(expose(reference, tonemapper, ev), expose(test, tonemapper, ev), ppd);
    for (std::size_t p = 0; p < out.flip.size(); ++p)
      if (ldr.flip[p] > out.flip[p]) out.flip[p] = ldr.flip[p], out.exposure[p] = share;
  }
  return out;
}

} // namespace parity::oracle

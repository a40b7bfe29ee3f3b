// Colour: the display transform, which turns scene-referred colour into what a screen shows, for both paths alike; and
// from what files hold to scene-referred colour.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// A view of linear Rec.709 scene colour, by OpenColorIO from a config made in code.
class DisplayTransform {
public:
  // name: one of names(). Throws Error (usage) naming the known ones otherwise.
  explicit DisplayTransform(const std::string& name);
  ~DisplayTransform();
  DisplayTransform(DisplayTransform&&) noexcept;
  DisplayTransform& operator=(DisplayTransform&&) noexcept;

  // "sRGB": clamp to [0,1] and the sRGB transfer function. "ACES SDR": ACES 1.0 output transform for a 100-nit sRGB
  // screen. "raw": clamped only.
  static const std::vector<std::string>& names();
  const std::string& name() const { return m_name; }

  // linear: RGB, Rec.709 primaries, scene-referred. Multiplied by 2^exposureEv first. Returns display-encoded RGB in
  // [0,1]. Non-finite input comes out as it is, so that the comparison can refuse it.
  Image apply(const Image& linear, float exposureEv = 0) const;
  // The same of pixels one after another, as bytes: the nearest 255ths. bytes: as many values. A pixel with a value
  // that is not finite, in the frame or once exposed, is black; its place among the pixels is appended to nonFinite.
  void encodeBytes(std::span<const float> linear, float exposureEv, std::span<std::uint8_t> bytes,
                   std::vector<std::uint32_t>& nonFinite) const;

private:
  // As apply, of pixels one after another. encoded: as many values.
  void encode(std::span<const float> linear, float exposureEv, std::span<float> encoded) const;

  struct Impl;
  std::string m_name;
  std::unique_ptr<Impl> m_impl;
};

// Colour spaces of files: "linear" (Rec.709 primaries), "srgb" (the same, by the sRGB transfer function), "acescg",
// "aces2065-1" (both linear, ACES white adapted by Bradford).
const std::vector<std::string>& colorSpaceNames();

// rgb: 3 channels in that space. Returns linear Rec.709, unbounded on either side; non-finite pixels come out with all
// three channels NaN. Throws Error: usage for an unknown space, failed for other than 3 channels.
Image toLinearRec709(const Image& rgb, const std::string& colorSpace);

} // namespace parity::base

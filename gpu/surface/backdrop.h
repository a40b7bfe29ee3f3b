// What lies behind surfaces that light passes through: the picture of a scene's opaque surfaces, as one path shades
// them.
#pragma once

#include <cstdint>

#include "base/image/image.h"
#include "gpu/device/image.h"
#include "gpu/surface/shaded_plane.h"
#include "gpu/surface/surface.h"

namespace parity::gpu {

inline constexpr vk::Format kBackdropFormat = vk::Format::eR32G32B32A32Sfloat;
inline constexpr std::uint32_t kBackdropLayers = 2;

// An array of two layers with all mips, each texel the mean of those below it. Layer 0: radiance times coverage, linear
// Rec.709; coverage in [0, 1]. Layer 1: depth along the camera's axis times coverage, metres; 0, 0, 0.
class Backdrop {
public:
  const DeviceImage& image() const { return m_image; }

private:
  friend class BackdropBuilder;
  explicit Backdrop(DeviceImage image) : m_image(std::move(image)) {}
  DeviceImage m_image;
};

// Gathers it, surface by surface: the opaque surfaces of each tile and sample of a picture.
class BackdropBuilder {
public:
  BackdropBuilder(std::uint32_t width, std::uint32_t height, int samples);
  // color: radiance of the surface's entries, in its order. What is not finite counts as black.
  void lay(const Surface& surface, const scenes::Camera& camera, const ShadedPlane& color);
  Backdrop take(const Device& device);

private:
  float m_weight;               // of a sample
  base::Image m_color, m_depth; // 4 channels, 1 channel
};

} // namespace parity::gpu

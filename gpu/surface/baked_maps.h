// Baked light on the device: pages of the lightmap and of the sun's shadow, captures, the scales of objects.
#pragma once

#include <cstdint>
#include <span>

#include "gpu/device/image.h"
#include "gpu/shaders/interface.h"

namespace parity::gpu {

// Pages of one size, page after page, rows top-down and tight. count 0: there are none.
struct BakedPages {
  vk::Format format = vk::Format::eUndefined;
  std::uint32_t width = 0, height = 0, count = 0;
  std::span<const std::byte> texels = {};
};

// As it comes from the host; what is spanned is read by makeBakedMaps only.
struct BakedContent {
  // Each page two halves of equal height, one above the other; linear Rec.709. High end (RGBA16F): above RGB irradiance
  // over pi at the baked normal, below r of shading/lightmap.glsl. Mobile (RGBA8): above LogRGB, below SH, in the
  // object's scales.
  BakedPages lightmap = {};
  // R8, of any size: for the high-end path the share of the sun that is seen, for the mobile one a distance field.
  BakedPages sunShadow = {};
  float transitionScale = 1; // T of that field
  // One an instance of the scene; the high-end path reads none.
  std::span<const GpuLightmapScales> scales = {};
  // In the order of their cubes in the path's EnvironmentMaps.
  std::span<const GpuCapture> captures = {};
};

struct BakedMaps {
  std::uint32_t parts = 0; // kBaked... bits: what is there
  DeviceImage lightmap, sunShadow;
  Buffer captures, scales; // path.glsl
  std::size_t scaleCount = 0;
  float transitionScale = 1;
};

// Throws Error (exit 4) where the device cannot filter a format or takes fewer pages.
BakedMaps makeBakedMaps(const Device& device, const BakedContent& content);

} // namespace parity::gpu

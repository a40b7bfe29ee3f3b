// The surface pass: rasterises ids, bins them, and resolves the attributes of every listed pixel.
#pragma once

#include <memory>

#include "gpu/pipeline.h"
#include "gpu/surface.h"

namespace parity::gpu {

// Code and textures that a bin's pixels need.
struct BinKind {
  MaterialClass materialClass;
  std::uint32_t textureSet = 0;
  auto operator<=>(const BinKind&) const = default;
};

class SurfacePass {
public:
  // The pass for pictures of this size; all tiles share its attachments.
  SurfacePass(const Device& device, const SceneBuffers& scene, std::uint32_t width, std::uint32_t height);
  ~SurfacePass();

  // What the bin keys of its surfaces mean.
  const std::vector<BinKind>& binKinds() const;
  bool hasBlended() const;

  // Opaque must come first for each (tile, sample): the blended layer is tested against its depth.
  Surface render(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample, Layer layer) const;

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

// The rays of a camera in a picture of this size, and what the scene says about its light (interface.h, without sh).
GpuView makeView(const scenes::Scene& scene, const scenes::Camera& camera, std::uint32_t width, std::uint32_t height);

// World to clip space (Vulkan: depth 0..1; +Y up in clip space, for a viewport of negative height).
glm::mat4 makeWorldToClip(const scenes::Camera& camera, float aspect);

} // namespace parity::gpu

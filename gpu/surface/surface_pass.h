// The surface pass: rasterises ids layer by layer, bins them, and resolves the attributes of every listed pixel.
#pragma once

#include <memory>

#include "gpu/device/pipeline.h"
#include "gpu/surface/surface.h"

namespace parity::gpu {

// Code and textures that a bin's pixels need.
struct BinKind {
  MaterialClass materialClass;
  std::uint32_t textureSet = 0;
  auto operator<=>(const BinKind&) const = default;
};

// Blended surfaces behind one another that a sample shows at most, the nearest ones: a bound on time and memory.
inline constexpr std::uint32_t kMaxBlendedLayers = 16;

// What is seen through the pixels of a tile in one place of each, layer by layer, before it is resolved.
struct VisibleLayers {
  struct Layer {
    bool blended = false;
    std::vector<Bin> bins;
    std::vector<glm::uvec4> entries; // in bin order: x | y << 16, instance, triangle, 0
  };
  glm::vec2 sample{0.5f};
  // From the back to the front: the opaque one, which may be empty, then the blended ones, none of which is.
  std::vector<Layer> layers;
  // Pixels (y*width+x in the whole picture) with more than kMaxBlendedLayers: what lies behind those is left out.
  std::vector<std::uint32_t> cutPixels;
  std::size_t size() const; // entries of all layers
};

class SurfacePass {
public:
  // The pass for pictures of this size; all tiles share its attachments.
  SurfacePass(const Device& device, const SceneBuffers& scene, std::uint32_t width, std::uint32_t height);
  ~SurfacePass();

  // What the bin keys of its surfaces mean.
  const std::vector<BinKind>& binKinds() const;

  // Blended surfaces are peeled from the front to the back, so that what a limit cuts off is what shows least.
  VisibleLayers rasterise(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample) const;
  // The opaque layer alone, as if surfaces that light passes through were not there.
  VisibleLayers rasteriseBehind(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample) const;
  // One of the layers that this pass found with this camera.
  Surface resolve(const VisibleLayers& visible, std::size_t layer, const scenes::Camera& camera) const;
  // All layers at once, from the back to the front.
  std::vector<Surface> render(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample) const;

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace parity::gpu

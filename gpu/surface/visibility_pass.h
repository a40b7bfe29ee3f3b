// Which triangle is seen through each pixel: the nearest opaque one, and the blended ones in front of it, layer by
// layer (depth peeling; Everitt 2001, "Interactive Order-Independent Transparency").
#pragma once

#include <memory>
#include <vector>

#include "gpu/surface/scene_buffers.h"
#include "gpu/surface/view.h"

namespace parity::gpu {

class VisibilityPass {
public:
  // The pass for pictures of this size; all tiles share its attachments. Those of peeling are made where something
  // placed is blended.
  VisibilityPass(const Device& device, const SceneBuffers& scene, std::uint32_t width, std::uint32_t height);
  ~VisibilityPass();

  bool hasBlended() const;

  // What is looked at: a tile of a camera's picture, through this place in its pixels.
  struct Part {
    const scenes::Camera& camera;
    Tile tile;
    glm::vec2 sample;
  };
  // A picture of the tile, rows tight: (instance + 1, triangle); 0: nothing there.
  using Ids = std::vector<glm::uvec2>;
  // The nearest opaque or alpha-masked surfaces; withoutTransmissive: of materials that light does not pass through
  // (scenes::Material::hasTransmission).
  Ids renderOpaque(const Part& part, bool withoutTransmissive = false) const;
  // The nearest blended surfaces of those that earlier calls for the same part have not shown: layer 0, 1, 2... after
  // renderOpaque, whose depth hides them; where it is equal they lie on top. Of blended surfaces at the very same
  // depth the later one in the scene is in front, as if they were drawn in its order. No pixel shows a layer that did
  // not show the one before.
  Ids peel(const Part& part, std::uint32_t layer) const;

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace parity::gpu

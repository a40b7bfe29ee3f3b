// All surfaces of one view, rasterised once, to be shaded by many renderers: for studies.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "gpu/surface/coverage_builder.h"
#include "gpu/surface/frame_builder.h"
#include "gpu/surface/material_swap.h"
#include "job/scene/scene_on_device.h"

namespace parity::job {

class ViewSurfaces {
public:
  // settings: of size, samples and background. All must outlive it.
  ViewSurfaces(const gpu::Device& device, const SceneOnDevice& scene, const Settings& settings,
               const scenes::Camera& camera);

  std::uint64_t size() const; // entries of all surfaces: what one round shades

  // One entry a part: the layers of a tile and sample, from the back to the front.
  struct Part {
    gpu::Tile tile;
    std::vector<gpu::Surface> layers;
  };
  const std::vector<Part>& parts() const { return m_parts; }
  const scenes::Camera& camera() const { return m_camera; }

  // All parts anew, for nothing but the time that it takes.
  void rasteriseAgain() const;

  // A part's layers. What lies behind surfaces that light passes through is shaded first, where the renderer reads it.
  using Shaded = std::vector<gpu::ShadedSurface>;
  std::vector<Shaded> shade(paths::Renderer& renderer) const;

  // The picture, linear and scene-referred, through a target where there is one.
  base::Image compose(const std::vector<Shaded>& shaded, const std::optional<gpu::TargetCodec>& target) const;
  // A list a material; `shaded` gives the opacity of what is blended, and is the same by any path.
  std::vector<base::PixelList> coverage(const std::vector<Shaded>& shaded) const;

  // Of each coverage list the first picture with the second's colours on that material alone (gpu::SwapBuilder), as it
  // is stored in the target. picture: the second, composed by that target.
  std::vector<gpu::SwappedPixels> swap(const std::vector<Shaded>& first, const std::vector<Shaded>& second,
                                       const std::optional<gpu::TargetCodec>& target, const base::Image& picture,
                                       const std::vector<base::PixelList>& coverage) const;

private:
  void lay(std::size_t part, const Shaded& shaded, auto& builder) const;
  gpu::Backdrop backdropOf(const paths::Renderer& renderer) const;

  const gpu::Device& m_device;
  const SceneOnDevice& m_scene;
  const Settings& m_settings;
  scenes::Camera m_camera;
  std::vector<Part> m_parts;
  mutable std::vector<gpu::Surface> m_behind; // a part each; made when a renderer first reads it
};

} // namespace parity::job

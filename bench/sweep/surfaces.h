// A scene on the device and all surfaces of one view, rasterised once for every setting.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "gpu/coverage_builder.h"
#include "gpu/frame_builder.h"
#include "job/context.h"
#include "job/prepared_scene.h"

namespace parity::sweep {

class Surfaces {
public:
  // `prepared` must outlive it. Makes the request's first view.
  Surfaces(job::Context& context, const job::PreparedScene& prepared, const scenes::ViewRequest& view);

  const gpu::SceneBuffers& buffers() const { return m_buffers; }
  const std::vector<gpu::BinKind>& binKinds() const { return m_pass.binKinds(); }
  const scenes::Camera& camera() const { return m_camera; }
  std::uint64_t size() const; // entries of all surfaces: what one round shades

  // One entry a part: the layers of a tile and sample, from the back to the front.
  struct Part {
    gpu::Tile tile;
    std::vector<gpu::Surface> layers;
  };
  const std::vector<Part>& parts() const { return m_parts; }

  // All parts anew, for nothing but the time that it takes.
  void rasteriseAgain() const;

  // A part's layers.
  using Shaded = std::vector<gpu::ShadedSurface>;
  // Shades every part by something with shade(surface, camera), a renderer of either path.
  template <typename Renderer> std::vector<Shaded> shade(const Renderer& renderer) const {
    std::vector<Shaded> all;
    for (const Part& part : m_parts) {
      Shaded& shaded = all.emplace_back();
      for (const gpu::Surface& layer : part.layers) shaded.push_back(renderer.shade(layer, m_camera));
    }
    return all;
  }

  // The picture, linear and scene-referred, through a target where there is one.
  base::Image compose(const std::vector<Shaded>& shaded, const std::optional<gpu::TargetCodec>& target) const;
  // A list a material; `shaded` gives the opacity of what is blended, and is the same by any path.
  std::vector<base::PixelList> coverage(const std::vector<Shaded>& shaded) const;

private:
  void lay(std::size_t part, const Shaded& shaded, auto& builder) const;

  const job::Settings& m_settings;
  gpu::SceneBuffers m_buffers;
  gpu::SurfacePass m_pass;
  scenes::Camera m_camera;
  std::vector<Part> m_parts;
};

} // namespace parity::sweep

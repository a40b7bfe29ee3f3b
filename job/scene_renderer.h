// Renders views of a prepared scene by both paths over the very same surfaces.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frame.h"
#include "gpu/frame_builder.h"
#include "job/prepared_scene.h"

namespace parity::job {

// Which paths to shade.
struct Paths {
  bool highend = true, mobile = true;
};

struct ViewFrames {
  base::Frame highend, mobile;           // empty where not asked for
  std::vector<base::PixelList> coverage; // a list per material; empty unless both paths are asked for
};

class SceneRenderer {
public:
  // views: how many will be rendered, for the choice of permutations. `prepared` must outlive the renderer.
  SceneRenderer(Context& context, const PreparedScene& prepared, const Paths& paths, std::size_t views);

  ViewFrames render(const scenes::Camera& camera);

  // What the mobile path leaves out, and what this scene did not need.
  std::vector<std::string> notes() const;
  std::vector<std::string> skipped() const;

private:
  Context& m_context;
  const PreparedScene& m_prepared;
  gpu::SceneBuffers m_buffers;
  gpu::SurfacePass m_surfacePass;
  std::optional<gpu::EnvironmentMaps> m_environment;
  std::optional<highend::Renderer> m_highend;
  std::optional<mobile::Renderer> m_mobile;
};

} // namespace parity::job

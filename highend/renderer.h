// The high-end path as a renderer of surfaces.
#pragma once

#include <memory>
#include <vector>

#include "gpu/shading_pass.h"
#include "highend/env_brdf_lut.h"

namespace parity::highend {

struct Options {
  GeometryTerm geometryTerm = GeometryTerm::heightCorrelated;
  bool compensate = true; // energy compensation for multiple scattering (Turquin 2019)
};

// What the renderer is given besides the scene; all of it shared with the other paths.
struct Inputs {
  const gpu::EnvironmentMaps* environment = nullptr; // null: none
  const base::Image* lut =
      nullptr; // makeEnvBrdfLut of the same term; needed unless without environment and compensation
  std::vector<scenes::Light> lights = {}; // all of the scene's, and the sun
  bool terms = false;
  std::uint64_t expectedPixels = 0; // that the run will shade
};

class Renderer {
public:
  Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
           const Inputs& inputs, const Options& options);
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const {
    return m_pass->shade(surface, camera);
  }

  // Whether the table is read at all with these inputs.
  static bool needsLut(const Inputs& inputs, const Options& options) {
    return inputs.environment != nullptr || options.compensate;
  }

private:
  gpu::DeviceImage m_lut;
  std::unique_ptr<gpu::ShadingPass> m_pass;
};

} // namespace parity::highend

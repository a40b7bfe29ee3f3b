// The mobile path as a renderer of surfaces, by named presets.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpu/shading_pass.h"

namespace parity::mobile {

// Named sets of formulas (DESIGN 6).
enum class Preset {
  karis2014, // the article: EnvBRDFApprox, D_Approx sun, no local lights (baked), no roughness floor
  ue4_2020,  // UE4's base pass: AB.y * saturate(50 g), CalcSpecular, up to 4 local lights, roughness >= 0.015625
};
const std::vector<std::string>& presetNames(); // "karis2014", "ue4-2020"
// Throws Error (usage) naming the known presets.
Preset presetByName(const std::string& name);

struct Inputs {
  const gpu::EnvironmentMaps* environment = nullptr; // null: none
  std::vector<scenes::Light> lights = {};            // all of the scene's, and the sun; the path takes what it can
  bool terms = false;
  std::uint64_t expectedPixels = 0;
};

class Renderer {
public:
  Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
           const Inputs& inputs, Preset preset);
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const {
    return m_pass->shade(surface, camera);
  }
  const gpu::ShadingPass& pass() const { return *m_pass; }

  // What the path leaves out, in words for the report ("2 of 6 local lights: ..."); empty where it leaves out nothing.
  const std::vector<std::string>& notes() const { return m_notes; }

private:
  std::vector<std::string> m_notes;
  std::unique_ptr<gpu::ShadingPass> m_pass;
};

} // namespace parity::mobile

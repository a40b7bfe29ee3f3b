// The high-end path as a renderer of surfaces.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gpu/surface/shading_pass.h"
#include "highend/light_culling.h"
#include "highend/options.h"
#include "highend/views.h"
#include "paths/path.h"

namespace parity::highend {

// What the renderer is given besides the scene; all of it shared with the other paths.
struct Inputs {
  const gpu::EnvironmentMaps* environment = nullptr; // null: none
  const base::Image* lut = nullptr; // makeEnvBrdfLut of the same term and curve; null only where needsLut says so
  const base::Image* sheenTable = nullptr; // makeSheenTable of the lut's size; where the scene has coat or sheen
  bool transmits = false;                  // the scene has transmission
  std::vector<scenes::Light> lights = {};  // all of the scene's, and the sun
  gpu::ShadowMaps* shadows = nullptr;      // of these lights, fitted to what is shaded; null: nothing casts
  // Read where the scene's buffers know of a lightmap, in the encodings of this path. Its sun shadow is that of the
  // first directional light, where `shadows` is null. Its captures are those of `environment`.
  const gpu::BakedMaps* baked = nullptr;
  bool cullLights = true; // false: every pixel asks every light, with the same result
  bool terms = false;
  // Not 0: at most so many pictures that lack a light each (leaveOut), in place of the terms; up to gpu::kMaxLeftOut.
  std::size_t leftOut = 0;
  // These pictures hold the light of lights alone: gpu/surface/other_terms.h makes them whole. Not for scenes with fog,
  // nor for scenes with lobes, some of whose terms are of lights and of the environment.
  bool lightsAlone = false;
  std::uint32_t hiddenFeatures = 0; // of gpu::kFeatureLobes: lobes that it leaves out
  std::uint32_t view = kViewLit;    // what the colour shows (highend/views.h)
  gpu::Compilation compilation = {};
  std::uint64_t expectedPixels = 0; // that the run will shade
};

class Renderer : public paths::Renderer {
public:
  Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
           const Inputs& inputs, const Options& options);
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const override {
    if (m_shadows) m_shadows->fitTo(surface);
    return m_pass->shade(surface, camera);
  }
  void leaveOut(std::span<const std::size_t> lights) override;
  const gpu::ShadingPass& pass() const override { return *m_pass; }
  void setBackdrop(const gpu::Backdrop* backdrop) override { m_pass->setBackdrop(backdrop); }
  bool readsBackdrop() const override { return m_readsBackdrop; }
  // The environment's and the table's are among them.
  std::size_t countSamplers(const gpu::Permutation& permutation) const override;
  // Lists: one for each group of pixels so far; 0 where all lights are asked for every pixel.
  paths::RendererWork work() const override;
  const gpu::ShadowMaps* shadowMaps() const override { return m_shadows; }
  // Of shadow maps that are smaller than asked for.
  std::vector<std::string> warnings() const override;

  // Whether the table is read at all with these inputs.
  static bool needsLut(const Inputs& inputs, const Options& options) {
    return inputs.environment != nullptr || inputs.sheenTable != nullptr || inputs.transmits ||
           inputs.view != kViewLit ||
           ((!inputs.lights.empty() || inputs.baked) &&
            (options.compensation != Compensation::none || options.model.diffuse == DiffuseLobe::balanced));
  }

private:
  std::vector<std::size_t> m_places; // in the pass's list, of the inputs' lights
  std::size_t m_ownSamplers = 0;     // besides the materials'
  gpu::ShadowMaps* m_shadows = nullptr;
  bool m_hasLut = false, m_readsBackdrop = false;
  gpu::DeviceImage m_lut;
  std::unique_ptr<LightCulling> m_culling; // where there are lights enough
  std::unique_ptr<gpu::ShadingPass> m_pass;
};

} // namespace parity::highend

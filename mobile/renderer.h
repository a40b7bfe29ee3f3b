// The mobile path as a renderer of surfaces, by named presets.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/surface/shading_pass.h"
#include "mobile/options.h"
#include "mobile/sampler_rule.h"
#include "mobile/views.h"
#include "paths/path.h"

namespace parity::mobile {

struct Inputs {
  const gpu::EnvironmentMaps* environment = nullptr; // the capture, in the options' encoding; null: none
  std::vector<scenes::Light> lights = {};            // all of the scene's, and the sun; the path takes what it can
  gpu::ShadowMaps* shadows = nullptr;      // with those of needsShadowMaps, fitted to what is shaded; null: none
  const gpu::Textures* textures = nullptr; // as the path stores them; null: the scene's as they are
  // Read where the scene's buffers know of a lightmap, in the options' encoding. Its sun shadow is that of the one
  // sun. Its captures are those of `environment`: each object has its own.
  const gpu::BakedMaps* baked = nullptr;
  bool terms = false;
  // The program asks for the knobs at run time: slower, but any number of sets of them takes one compilation.
  bool wide = false;
  std::uint32_t view = kViewLit; // what the colour shows (mobile/views.h)
  gpu::Compilation compilation = {};
  std::uint64_t expectedPixels = 0;
};

// What the device computes in: fp32 where it has no shaderFloat16, whatever the options ask for.
Precision precisionOn(const gpu::DeviceReport& device, const Options& options);

class Renderer : public paths::Renderer {
public:
  Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
           const Inputs& inputs, const Options& options);
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const override {
    if (m_shadows) m_shadows->fitTo(surface);
    return m_pass->shade(surface, camera);
  }
  const gpu::ShadingPass& pass() const override { return *m_pass; }
  void setBackdrop(const gpu::Backdrop* backdrop) override { m_pass->setBackdrop(backdrop); }
  bool readsBackdrop() const override { return m_readsBackdrop; }
  // What the optimizer finds to be unused is not taken off.
  std::size_t countSamplers(const gpu::Permutation& permutation) const override {
    return mobile::countSamplers(permutation, m_samplers);
  }
  std::string describeExcess(const scenes::Material& material) const override {
    return mobile::describeExcess(material, m_samplers);
  }
  paths::RendererWork work() const override {
    return {.localLights = m_uncappedLights, .lightChoices = m_lightChoices};
  }
  const gpu::ShadowMaps* shadowMaps() const override { return m_shadows; }

  // The lights whose shadow maps it reads with these inputs: the sun, the brightest spot light, both or none.
  static std::vector<scenes::Light> needsShadowMaps(const std::vector<scenes::Light>& lights, const Options& options);

  std::vector<std::string> notes() const override { return m_notes; }

private:
  gpu::ShadowMaps* m_shadows = nullptr; // none where no light has one
  SamplerInputs m_samplers;
  bool m_readsBackdrop = false;
  std::size_t m_lightChoices = 0;
  std::size_t m_uncappedLights = 0; // that every pixel takes
  std::vector<std::string> m_notes;
  std::unique_ptr<gpu::ShadingPass> m_pass;
};

} // namespace parity::mobile

// The high-end path as a renderer of surfaces.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpu/shading_pass.h"
#include "highend/env_brdf_lut.h"

namespace parity::highend {

using shading::Compensation;
using shading::DiffuseLobe;

// How the prefiltered environment is read where the view is not along the normal (shading/off_specular.glsl).
enum class OffSpecular {
  none,      // in the mirror direction: N = V = R (Karis 2013)
  dominant,  // in the lobe's dominant direction (Lagarde and de Rousiers 2014)
  stretched, // twice, along the plane of incidence
  twoTaps,   // twice, by two lobes fitted to the true one
  threeTaps, // three times, so too
};

struct Options {
  GeometryTerm geometryTerm = GeometryTerm::heightCorrelated;
  FresnelCurve fresnel = FresnelCurve::schlick;
  DiffuseLobe diffuse = DiffuseLobe::balanced;
  Compensation compensation = Compensation::kullaConty;
  OffSpecular offSpecular = OffSpecular::threeTaps;
};

// Names as the command line and reports have them, in the order of the enumerators.
const std::vector<std::string>& geometryTermNames(); // "height-correlated", "schlick-smith"
const std::vector<std::string>& fresnelNames();      // "schlick", "spherical-gaussian", "dielectric"
const std::vector<std::string>& diffuseNames();      // "balanced", "lambert"
const std::vector<std::string>& compensationNames(); // "none", "turquin", "fdez-aguera", "kulla-conty"
const std::vector<std::string>& offSpecularNames();  // "none", "dominant", "stretched", "two-taps", "three-taps"

// What the renderer is given besides the scene; all of it shared with the other paths.
struct Inputs {
  const gpu::EnvironmentMaps* environment = nullptr; // null: none
  const base::Image* lut = nullptr;       // makeEnvBrdfLut of the same term and curve; null only where needsLut says so
  std::vector<scenes::Light> lights = {}; // all of the scene's, and the sun
  bool terms = false;
  gpu::Compilation compilation = {};
  std::uint64_t expectedPixels = 0; // that the run will shade
};

class Renderer {
public:
  Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
           const Inputs& inputs, const Options& options);
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const {
    return m_pass->shade(surface, camera);
  }
  const gpu::ShadingPass& pass() const { return *m_pass; }
  // Samplers that a permutation binds, the environment's and the table's among them.
  std::size_t countSamplers(const gpu::Permutation& permutation) const;

  // Whether the table is read at all with these inputs.
  static bool needsLut(const Inputs& inputs, const Options& options) {
    return inputs.environment != nullptr || (!inputs.lights.empty() && (options.compensation != Compensation::none ||
                                                                        options.diffuse == DiffuseLobe::balanced));
  }

private:
  std::size_t m_ownSamplers = 0; // besides the materials'
  gpu::DeviceImage m_lut;
  std::unique_ptr<gpu::ShadingPass> m_pass;
};

} // namespace parity::highend

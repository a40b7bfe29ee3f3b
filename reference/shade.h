// The reference path: every term of every point, in double, with the error that was achieved.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/direct_light.h"
#include "reference/environment_integral.h"
#include "reference/interreflection.h"
#include "reference/sheen_albedo.h"
#include "shading/terms.h"

namespace parity::reference {

struct Inputs {
  const EnvironmentSampler* environment = nullptr;  // null: none
  const DirectionalAlbedo* albedo = nullptr;        // of the model's term and curve, where it or a coat needs one
  std::vector<scenes::Light> lights = {};           // all of the scene's, and the sun
  const lighting::Visibility* visibility = nullptr; // null: nothing casts shadows
  // Of the visibility's scene, whose images have their pixels: where light bounces between surfaces, or passes through.
  const lighting::SurfaceLight* surfaces = nullptr;
  const lighting::Emitters* emitters = nullptr;
  const SheenAlbedo* sheenAlbedo = nullptr; // where a sample has a sheen
  // What is seen through surfaces: of Contents::behind, and there without shadows, too. null: nothing.
  const lighting::Visibility* behind = nullptr;
  const lighting::Visibility* bodies = nullptr; // of Contents::bodies, where a sample has a volume
};

struct Options {
  Model model;
  IntegralOptions integral;
  int bounces = 0; // of light between the scene's surfaces, 0: none; above 0 all members of Inputs for it are set
};

// One point. The terms are those of shading/terms.h; their sum is the colour.
struct ShadedSample {
  std::array<glm::vec3, shading::kTermCount> terms{};
  float standardError = 0; // of the colour, absolute: the worst channel
  float relativeError = 0; // that over the brightest channel of the colour; 0 where all is exact
  std::uint32_t samples = 0;
};

// Told the share that is done, 0..1; called by any thread, one at a time.
using Progress = std::function<void(double done)>;

// Occlusion multiplies what comes from the environment, diffuse and specular alike, as in the high-end path, and
// nothing else; it does so with shadows, too: a material's occlusion is of details that its mesh does not have. Light
// that comes by way of other surfaces, emissive ones included, counts to the terms of the sky, occlusion as well. All
// light of a clear coat is in coatSpecular, all of a sheen in sheen, and all that passes through in transmission
// (reference/layers.h); surfaces that light comes by way of show their base alone, without anisotropy and film.
// Through a thin wall or a body one sees the environment and the opaque surfaces behind, lit as by one bounce at least,
// with or without shadows. Analytic lights shine through thin walls, but not through bodies
// (reference/body_light.h). Diffuse light from behind is that of the environment and the lights, with shadows less what
// hides them, and with the light of what does; a body does not hide the light behind it from itself.
// Deterministic: the result for a point depends on the point, the inputs and the options alone, not on the number of
// threads or on the other points.
std::vector<ShadedSample> shade(std::span<const SurfaceSample> samples, const Inputs& inputs, const Options& options,
                                const Progress& progress = {});

} // namespace parity::reference

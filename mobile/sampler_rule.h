// The article's limit on samplers: at most 8 a material (Karis 2014).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gpu/surface/permutations.h"
#include "scenes/scene.h"

namespace parity::mobile {

// "8 samplers total": 16 is what OpenGL ES 3 grants, the article's engine leaves half of them to the material.
inline constexpr std::size_t kMaxSamplers = 8;

struct SamplerInputs {
  bool environment = false;                 // there is one to be fetched
  bool shadowMap = false;                   // a spot light or the sun has one: all lie in one image
  bool lightmap = false, sunShadow = false; // baked, for some object
  bool coat = false, sheen = false, anisotropy = false, iridescence = false; // the preset reads their textures
  bool transmission = false, thickness = false, diffuseTransmission = false;
  bool backdrop = false;       // materials with transmission read the picture behind
  bool coatNormal = false;     // and the coat's normal map, for its direction or its spread
  bool normalVariance = false; // normal maps carry the spread of their normals (gpu/surface/normal_variance.h)
};

// Pairs of an image and a sampler that the path reads for a material, the environment's included: unlit and fully rough
// materials do without that, unlit ones without baked light; fully rough ones read no texture of further lobes. The
// seven slots of the base and one environment are 8: with a lightmap and the sun's shadow a material may have five
// textures of its own.
std::size_t countSamplers(const scenes::Material& material, const SamplerInputs& inputs);

// The same of a permutation of the shader.
std::size_t countSamplers(const gpu::Permutation& permutation, const SamplerInputs& inputs);

// "needs 9 samplers on mobile, of at most 8"; empty where it does not.
std::string describeExcess(const scenes::Material& material, const SamplerInputs& inputs,
                           std::size_t limit = kMaxSamplers);

} // namespace parity::mobile

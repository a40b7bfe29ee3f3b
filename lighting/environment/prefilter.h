// GGX prefiltering of a cube map for N = V = R.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/bright_texels.h"
#include "lighting/environment/cube_sampler.h"
#include "lighting/environment/environment_light.h"
#include "lighting/environment/lamp_tree.h"

namespace parity::lighting {

// How the samples of a lobe are spread: Hammersley's sequence, or a spiral that turns by the golden angle from one to
// the next (Vogel 1979, "A Better Way to Construct the Sunflower Head"), which leaves no gaps between footprints and
// errs half as much; their number is then free.
enum class Spread { hammersley, spiral };

// `count` samples of the lobe around N = V = +Z: half vectors by D_GGX at alpha = roughness^2 (Walter et al. 2007,
// eq. 35), weights NoL (Karis 2013, "PrefilterEnvMap") that sum to 1. Each reads a footprint
// of the solid angle that it stands for, 1 / (count pdf) (Krivanek and Colbert 2008, "Real-time Shading with Filtered
// Importance Sampling", eq. 10), 2^footprintLog2 times as wide so that neighbours overlap. count: in
// Hammersley's sequence a power of two; faceSize: of the cube that is read.
std::vector<WeightedRead> makeLobeSamples(double roughness, int count, int faceSize, double footprintLog2,
                                          Spread spread = Spread::hammersley);

// How many samples mip `mip` takes: sampleCount times 1, 4, 8, 16, 64 from mip 1 on. The mips shrink to a quarter each
// while their lobes widen, so the rough ones can have more and yet cost no more. Of the fine levels: times 1/4, 1, 2,
// 4, 8, 32 from mip 0 on, at least 1.
int samplesOfMip(int mip, const PrefilterOptions& options);

// What is filtered: a cube, sampled, and what was taken out of it to be summed.
struct FilterSource {
  const CubeSampler* cube = nullptr;
  BrightTexels bright;
  const LampTree* lamps = nullptr; // null: none
};

// Of each layer of a mip from firstLayer to before endLayer six faces of (faceSize >> mip)^2 texels, filtered for N = V
// = R around their middles; A = 1.
std::vector<std::vector<glm::vec4>> prefilter(const FilterSource& source, int mip, int firstLayer, int endLayer,
                                              const PrefilterOptions& options);

// Texels for bilinear reading: where the radiance curves, interpolation between its values at the texels' middles is
// off to one side everywhere between, by h^2/12 of the second derivative on average. Each texel is moved as far to the
// other side (the projection onto linear splines, to second order), but not below its half: T - (sum of 4 neighbours -
// 4 T)/12.
std::vector<glm::vec4> fitBilinear(const std::vector<glm::vec4>& mip, int size);

} // namespace parity::lighting

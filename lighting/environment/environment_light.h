// What a path reads of an environment: the prefiltered cube ("preconvolution", Karis 2014), the irradiance, the lamps.
// Each path has levels of its own.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/lamp_tree.h"
#include "scenes/scene.h"

namespace parity::lighting {

// A cube map array with mips, RGBA float (A = 1), linear Rec.709 radiance. Vulkan's face order and orientation: +X -X
// +Y -Y +Z -Z; mips[m] holds layer after layer 6 faces of (faceSize >> m)^2 texels, face after face, rows top-down.
struct CubeMap {
  int faceSize = 0;
  std::vector<std::vector<glm::vec4>> mips;
};

// Six mips need faces of at least 32 texels.
inline constexpr int kMinFaceSize = 32, kMaxFaceSize = 1024;
inline constexpr int kMaxSampleCount = 4096;

// Which levels a prefiltered cube has.
enum class PrefilterLevels {
  first,    // layer 0 of each mip: what the mobile path reads
  captures, // all layers of the mips between the first and the last
  fine,     // and of the first
};

struct PrefilterOptions {
  int faceSize = 256; // a power of two, kMinFaceSize..kMaxFaceSize
  // GGX importance samples per texel of mip 1 (a power of two, to kMaxSampleCount); the other mips take another number
  // (lighting/environment/prefilter.h).
  int sampleCount = 64;
  double footprintLog2 = 0.3; // samples read footprints 2^this as wide as they stand apart
  PrefilterLevels levels = PrefilterLevels::captures;
  bool operator==(const PrefilterOptions&) const = default;
};

inline constexpr std::size_t kMaxWideLampLeaves = 512;

// The high-end path's (docs/environments.md).
inline constexpr PrefilterOptions kFinePrefilter{
    .sampleCount = 32, .footprintLog2 = 0, .levels = PrefilterLevels::fine};

inline bool hasIrradianceCube(PrefilterLevels levels) { return levels != PrefilterLevels::first; }

// Cubes that mip m of the prefiltered array has: shading's kPrefilterLayers or one.
int layersOfMip(int mip, PrefilterLevels levels);
// The same of a cube that is there.
int layersOf(const CubeMap& cube, int mip);

// World space: the environment's rotation is applied already.
struct EnvironmentLight {
  // Layer j of mip m holds the GGX-prefiltered radiance (N = V = R) of roughness shading::roughnessFromMip(m + j /
  // kPrefilterLayers), layersOfMip(m) of them. Layer 0 of mip 0 is unfiltered; the last mip is shading's
  // kPrefilterRoughestMip (roughness 1).
  CubeMap prefiltered;
  // Irradiance coefficients, order 2, as shading/sh.glsl evaluates them (cosine kernel applied: irradiance, not
  // radiance): the mobile path's.
  std::array<glm::vec3, 9> irradianceSh{};
  // Irradiance over pi at every normal (lighting/environment/irradiance_cube.h): the high-end path's. Empty where
  // hasIrradianceCube() is false.
  std::vector<glm::vec4> irradianceCube;
  // Of a panorama with fine levels, for the high-end path: the levels hold the wide ones, too, at most
  // kMaxWideLampLeaves leaves of them; they lack the compact ones.
  Lamps lamps;
};

// Deterministic, bit-identical for any number of threads. GGX importance sampling with mips chosen by the pdf (Krivanek
// and Colbert 2008; Karis 2013), sums in fp32 or better; result finite for any finite input.
EnvironmentLight makeEnvironmentLight(const scenes::Environment& environment, const PrefilterOptions& options);
// The same of a cube's base texels as they are: six faces of options.faceSize^2, A = 1. Throws base::Error (exit 4)
// where a radiance is negative or not finite.
EnvironmentLight makeEnvironmentLight(std::vector<glm::vec4> texels, const PrefilterOptions& options);

// For the cache: a byte image of the whole, and back. fromBytes throws Error (exit 4) on anything malformed.
std::vector<std::byte> toBytes(const EnvironmentLight& light);
EnvironmentLight environmentLightFromBytes(std::span<const std::byte> bytes);

} // namespace parity::lighting

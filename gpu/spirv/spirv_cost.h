// What a shader costs once its specialization constants are known: operations, fetches and samplers, counted from
// SPIR-V after spirv-opt.
//
// A scalar operation is one arithmetic operation on one number: + - * / negation, a comparison, a selection, or one
// instruction of GLSL.std.450, a component each. A vec3 addition counts 3; dot of n components 2n-1; a matrix of r rows
// and c columns by a vector r (2c-1). Of GLSL.std.450, n being the components: fma, exp, log and clamp 2n; mix and pow
// 3n; smoothstep 9n; length 2n, distance 3n, normalize 3n (a dot, a root, n multiplications); cross 9; reflect 4n,
// refract 5n+7; faceforward 3n; all others n, sqrt, exp2 and sin too, whatever a device makes of them.
//
// Counted is the whole shader, as if every branch went both ways, and each loop as often as it runs at most: what the
// slowest lane of a group pays. Conversions, memory, moves of components and branches are counted apart.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device/pipeline.h"

namespace parity::gpu {

struct ShaderCost {
  std::uint64_t fp32 = 0, fp16 = 0; // scalar operations on reals
  std::uint64_t integer = 0;        // on integers and booleans
  std::uint64_t conversions = 0;    // between types, packed ones too; a component each
  std::uint64_t memory = 0;         // loads and stores as instructions, queries of images too
  std::uint64_t moves = 0;          // instructions that put components together or take them apart
  std::uint64_t branches = 0;       // conditional ones and switches

  // Texture reads. A loop's count as often as it runs.
  struct Image {
    std::uint32_t set = 0, binding = 0;
    std::uint64_t fetches = 0;
  };
  std::vector<Image> images; // that are fetched from, by set and binding

  std::uint64_t openLoops = 0; // loops whose number of turns is not known: their bodies are counted once

  std::uint64_t operations() const { return fp32 + fp16; }
  std::uint64_t fetches() const;
  std::uint64_t samplers() const { return images.size(); } // bindings of an image with its sampler
};

// Loops of at most this many turns are unrolled before the count, as compilers do; longer ones, and those with a
// `break`, are multiplied.
inline constexpr std::uint64_t kUnrolledTurns = 16;

// constants: values of the specialization constants 0, 1, 2, ..., as for makeComputePipeline. Deterministic; some 0.1
// s. Throws Error (failed) for SPIR-V that the optimizer refuses and for instructions that the count does not know.
ShaderCost costOf(Spirv spirv, std::span<const std::uint32_t> constants);

} // namespace parity::gpu

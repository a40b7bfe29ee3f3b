// The shaders that a scene's paths ran, and what they cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parity::report {

// For one pixel, at most (gpu/spirv/spirv_cost.h says what counts).
struct PermutationCost {
  std::uint64_t fp32 = 0, fp16 = 0; // scalar operations on reals
  std::uint64_t integer = 0;        // and on integers and booleans
  std::uint64_t fetches = 0;
  std::uint64_t openLoops = 0; // loops whose number of turns is not known: their bodies count once
  std::uint64_t operations() const { return fp32 + fp16; }
};

// A path's shader, specialised.
struct PermutationResult {
  std::string path;                    // paths::Path::name()
  std::string textures, features;      // what it reads and what it is made for, in words
  std::uint64_t pixels = 0;            // surface samples that it shaded, over all views
  std::uint64_t samplers = 0;          // that it binds: its materials' textures, and what else the path reads
  std::optional<PermutationCost> cost; // only of a run that was asked for it
};

// A path's mean over the pixels that it shaded.
struct PathCost {
  std::string path;
  std::uint64_t pixels = 0;
  double operations = 0, fp16 = 0, fetches = 0; // fp16: of the operations
  std::uint64_t samplers = 0;                   // most of any permutation
};

// In order of the paths' first permutation; those without costs, or without pixels, are left out.
std::vector<PathCost> costsByPath(const std::vector<PermutationResult>& permutations);

// "a pixel costs 900 scalar operations and 11.0 texture fetches by high-end, 375 and 4.5 by mobile: 0.42 of the
// operations, 0.41 of the fetches": every path held against the first. Empty where fewer than two are known.
std::string describeCosts(const std::vector<PermutationResult>& permutations);

} // namespace parity::report

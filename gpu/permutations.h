// Which bins get a shader of their own: specialised where pixels x saving outweighs the compilation (DESIGN 7).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/scene_buffers.h"

namespace parity::gpu {

// Specialization constants 0..2: exact for one class of materials, or wide enough for several.
struct Permutation {
  std::uint32_t textures = 0, mayFeatures = 0, mustFeatures = 0;
  auto operator<=>(const Permutation&) const = default;
};

struct ClassPixels {
  MaterialClass materialClass;
  std::uint64_t pixels = 0; // expected in this run
};

inline constexpr std::size_t kMaxPermutations = 8;          // a path and run
inline constexpr double kPermutationCostMs = 100;           // compiling one more
inline constexpr double kPermutationSavingNsPerPixel = 100; // exact against wide

// The permutation of each class, in the order given: those whose saving outweighs the cost get an exact one (the
// largest first, kMaxPermutations - 1 at most), the others share the union of what they need. One class alone is always
// exact.
std::vector<Permutation> planPermutations(std::span<const ClassPixels> classes);

// How many textures these bits name (kNormalVariance is none of its own).
std::size_t countTextures(std::uint32_t textures);
// "base colour, normal": the texture slots that it reads; "none".
std::string describeTextures(std::uint32_t textures);
// "nonmetal, some unlit": what all of its materials have, and what some of them may; "none".
std::string describeFeatures(const Permutation& permutation);

} // namespace parity::gpu

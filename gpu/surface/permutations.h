// Which bins get a shader of their own: specialised where pixels x saving outweighs the compilation (docs/design.md
// 7b).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gpu/surface/material_class.h"

namespace parity::gpu {

// Specialization constants 0..2: exact for one class of materials, or wide enough for several: with kTexturesVary where
// their textures differ, and with the kTextureReads of all.
struct Permutation {
  std::uint32_t textures = 0, mayFeatures = 0, mustFeatures = 0;
  bool everyScene = false; // it asks at run time for lights, environment and vertex data, too: any scene's materials
  auto operator<=>(const Permutation&) const = default;
};
// Does everything but lobes: at most this many textures' bits (SceneBuffers::textureBits).
Permutation everyScenePermutation(std::uint32_t textures);

struct ClassPixels {
  MaterialClass materialClass;
  std::uint64_t pixels = 0; // expected in this run
};

// As build/bench_skip finds them on lavapipe, where nothing is cached; docs/benchmarks.md.
inline constexpr std::size_t kMaxPermutations = 8;          // a path and run
inline constexpr double kPermutationCostMs = 500;           // compiling one more
inline constexpr double kPermutationSavingNsPerPixel = 150; // exact against wide
// The high-end path under many lights (builtin:lamps, builtin:lights), on two cores of lavapipe.
inline constexpr double kShadingNsPerSample = 1000;

// What of its run's permutations a scene may have.
struct PermutationBudget {
  std::size_t own = kMaxPermutations; // made for its materials
  bool shares = false; // materials without one of their own take that of every scene, which counts once a run
  bool operator==(const PermutationBudget&) const = default;

  // Of a scene that is shaded with lobes (PARITY_LOBES of path.glsl). It shares none: a shader with every lobe of every
  // scene takes longer to compile than those that the scene needs (docs/benchmarks.md: nine assets).
  PermutationBudget withLobes() const;
};
// Of the scene at this place among so many: all are dealt out evenly; among more scenes than there are permutations one
// is every scene's. It depends on nothing that the scenes hold, so no scene's picture depends on another scene.
PermutationBudget shareOf(std::size_t scene, std::size_t sceneCount);

// Which permutation serves each class of a scene's materials, decided when the class is first seen.
class PermutationPlan {
public:
  // textures: all bits that any scene of the run may need. classes: of the scene, each once.
  PermutationPlan(const PermutationBudget& budget, std::uint32_t textures, std::vector<MaterialClass> classes);

  // Plans for classes that have pixels: those whose saving outweighs the cost get an exact one, the largest first,
  // while more than one is left; of the others those that an earlier one serves take that; the rest shares the union of
  // what it needs, or what every scene shares. The last permutation that is left serves the unseen classes of the
  // scene, too. One class alone is always exact, unless the scene shares.
  void add(std::vector<ClassPixels> seen);

  bool has(const MaterialClass& materialClass) const { return m_planned.contains(materialClass); }
  // Of a class that was added.
  const Permutation& of(const MaterialClass& materialClass) const { return m_planned.at(materialClass); }

private:
  bool isLast() const { return m_own.size() + 1 >= m_budget.own; }
  // Widens the permutation for each class that is not planned yet and that it has the code for: a later add() may give
  // it to that class.
  void widenForOthers(Permutation& own);

  PermutationBudget m_budget;
  std::uint32_t m_textures;
  std::vector<MaterialClass> m_classes;
  std::vector<Permutation> m_own; // made so far
  std::map<MaterialClass, Permutation> m_planned;
};

// How many textures these bits name (kNormalVariance and the bits above it are none of their own).
std::size_t countTextures(std::uint32_t textures);
// "base colour, normal": the texture slots that it reads; "none".
std::string describeTextures(std::uint32_t textures);
// "nonmetal, some unlit": what all of its materials have, and what some of them may; "none".
std::string describeFeatures(const Permutation& permutation);

} // namespace parity::gpu

#include "gpu/permutations.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parity::gpu {

namespace {

// Bits of a texture mask and of features, from the lowest.
constexpr std::array<const char*, kSlotCount + 1> kTextureNames = {"base colour",     "metallic-roughness", "normal",
                                                                   "occlusion",       "emissive",           "specular",
                                                                   "specular colour", "spread of normals"};
constexpr std::array<const char*, 4> kFeatureNames = {"unlit", "nonmetal", "fully rough", "blended"};
static_assert(kNormalVariance == 1u << (kTextureNames.size() - 1) && kFeatureBlend == 1u << (kFeatureNames.size() - 1));

std::string join(const std::vector<std::string>& words) {
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

} // namespace

std::vector<Permutation> planPermutations(std::span<const ClassPixels> classes) {
  std::vector<std::size_t> order(classes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return classes[a].pixels > classes[b].pixels; });

  std::vector<Permutation> plan(classes.size());
  std::vector<std::size_t> shared;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const ClassPixels& c = classes[order[rank]];
    const double savingMs = static_cast<double>(c.pixels) * kPermutationSavingNsPerPixel * 1e-6;
    if (rank + 1 < kMaxPermutations && savingMs > kPermutationCostMs)
      plan[order[rank]] = {c.materialClass.textures, c.materialClass.features, c.materialClass.features};
    else
      shared.push_back(order[rank]);
  }
  Permutation wide{0, 0, ~0u};
  for (const std::size_t i : shared) {
    wide.textures |= classes[i].materialClass.textures;
    wide.mayFeatures |= classes[i].materialClass.features;
    wide.mustFeatures &= classes[i].materialClass.features;
  }
  for (const std::size_t i : shared) plan[i] = wide;
  return plan;
}

std::size_t countTextures(std::uint32_t textures) {
  return static_cast<std::size_t>(std::popcount(textures & ((1u << kSlotCount) - 1)));
}

std::string describeTextures(std::uint32_t textures) {
  std::vector<std::string> words;
  for (std::size_t bit = 0; bit < kTextureNames.size(); ++bit)
    if ((textures >> bit & 1u) != 0) words.emplace_back(kTextureNames[bit]);
  return join(words);
}

std::string describeFeatures(const Permutation& permutation) {
  std::vector<std::string> words;
  for (std::size_t bit = 0; bit < kFeatureNames.size(); ++bit)
    if ((permutation.mustFeatures >> bit & 1u) != 0)
      words.emplace_back(kFeatureNames[bit]);
    else if ((permutation.mayFeatures >> bit & 1u) != 0)
      words.push_back(std::string("some ") + kFeatureNames[bit]);
  return join(words);
}

} // namespace parity::gpu

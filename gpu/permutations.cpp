#include "gpu/permutations.h"

#include <algorithm>
#include <numeric>

namespace parity::gpu {

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

} // namespace parity::gpu

#include "compare/pooling/region_runs.h"

#include <algorithm>
#include <cstddef>

#include "compare/pooling/region_list.h"

namespace parity::compare {
namespace {

void addRun(RegionRuns& region, const Run& run) {
  region.runs.push_back(run);
  region.pixels += run.count;
  const float* weights = region.weightsOf(run);
  if (!weights)
    region.weight += run.count;
  else
    for (std::uint32_t i = 0; i < run.count; ++i) region.weight += static_cast<double>(weights[i]);
}

} // namespace

RegionRuns runsOf(const base::PixelList& list, int width, int height) {
  requireWellFormed(list, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  RegionRuns region;
  region.weights = list.weights;
  const auto w = static_cast<std::uint32_t>(width);
  const auto isMember = [&](std::size_t i) { return list.weights.empty() || list.weights[i] > 0; };
  for (std::size_t i = 0; i < list.pixels.size();) {
    const std::size_t start = i++;
    if (!isMember(start)) continue;
    const std::uint32_t first = list.pixels[start];
    const std::uint64_t rowEnd = (std::uint64_t{first} / w + 1) * w;
    while (i < list.pixels.size() && list.pixels[i] == first + (i - start) && list.pixels[i] < rowEnd && isMember(i))
      ++i;
    addRun(region, {first, static_cast<std::uint32_t>(i - start), static_cast<std::uint32_t>(start)});
  }
  return region;
}

} // namespace parity::compare

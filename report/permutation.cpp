#include "report/permutation.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/wording.h"

namespace parity::report {

std::vector<PathCost> costsByPath(const std::vector<PermutationResult>& permutations) {
  std::vector<PathCost> paths;
  for (const PermutationResult& each : permutations) {
    if (!each.cost || each.pixels == 0) continue;
    auto path = std::ranges::find(paths, each.path, &PathCost::path);
    if (path == paths.end()) path = paths.insert(paths.end(), {.path = each.path});
    const auto pixels = static_cast<double>(each.pixels);
    path->pixels += each.pixels;
    path->operations += pixels * static_cast<double>(each.cost->operations());
    path->fp16 += pixels * static_cast<double>(each.cost->fp16);
    path->fetches += pixels * static_cast<double>(each.cost->fetches);
    path->samplers = std::max(path->samplers, each.samplers);
  }
  for (PathCost& path : paths)
    for (double* sum : {&path.operations, &path.fp16, &path.fetches}) *sum /= static_cast<double>(path.pixels);
  return paths;
}

std::string describeCosts(const std::vector<PermutationResult>& permutations) {
  const std::vector<PathCost> paths = costsByPath(permutations);
  if (paths.size() < 2) return {};
  const PathCost& first = paths.front();
  std::string text = fmt::format("cost of a pixel: {2} {0:.0f} scalar operations and {1:.1f} texture fetches",
                                 first.operations, first.fetches, titleOf(first.path));
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const PathCost& path = paths[i];
    text += fmt::format("{0} {3} {1:.0f} and {2:.1f}", i == 1 ? "," : ";", path.operations, path.fetches,
                        titleOf(path.path));
    if (first.operations > 0) text += fmt::format(": {:.2f} of the operations", path.operations / first.operations);
    if (first.operations > 0 && first.fetches > 0)
      text += fmt::format(", {:.2f} of the fetches", path.fetches / first.fetches);
  }
  return text;
}

} // namespace parity::report

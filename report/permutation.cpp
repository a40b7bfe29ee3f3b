#include "report/permutation.h"

#include <algorithm>

#include <fmt/format.h>

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
  const auto highend = std::ranges::find(paths, "highend", &PathCost::path),
             mobile = std::ranges::find(paths, "mobile", &PathCost::path);
  if (highend == paths.end() || mobile == paths.end()) return {};
  std::string text =
      fmt::format("a pixel costs {:.0f} scalar operations and {:.1f} texture fetches by high-end, {:.0f} and {:.1f} by "
                  "mobile",
                  highend->operations, highend->fetches, mobile->operations, mobile->fetches);
  if (highend->operations > 0)
    text += fmt::format(": {:.2f} of the operations", mobile->operations / highend->operations);
  if (highend->operations > 0 && highend->fetches > 0)
    text += fmt::format(", {:.2f} of the fetches", mobile->fetches / highend->fetches);
  return text;
}

} // namespace parity::report

#include "job/view/material_swaps.h"

#include <algorithm>

#include "base/gathered.h"

namespace parity::job {

compare::SwapReference referenceOf(const Displayed& displayed, const base::Image& exposedLinear) {
  return {displayed.pixels, &exposedLinear, displayed.nonFinite};
}

compare::Swap displaySwap(Context& context, const base::PixelList& list, const base::Image& colors, float exposureEv) {
  compare::Swap swap;
  swap.list = &list;
  if (list.pixels.empty()) return swap;
  Displayed shown = displayImage(colors, context.display(), exposureEv);
  swap.displayed = std::move(shown.pixels);
  swap.nonFinite = std::move(shown.nonFinite);
  swap.linear = exposureEv != 0 ? expose(colors, exposureEv) : colors;
  return swap;
}

compare::Swap displaySwap(Context& context, const base::PixelList& list, const gpu::SwappedPixels& swapped,
                          std::size_t plane, float exposureEv, const Displayed* finished) {
  if (list.pixels.empty()) return {.list = &list, .displayed = {}, .linear = {}, .nonFinite = {}};
  const base::Image& colors = swapped.planes[plane];
  if (!finished || swapped.whole.empty()) return displaySwap(context, list, colors, exposureEv);

  // What the finished picture shows is displayed already; the rest is gathered once more.
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = 0, next = 0; i < list.pixels.size(); ++i)
    if (next < swapped.whole.size() && swapped.whole[next] == i)
      ++next;
    else
      rest.push_back(i);
  compare::Swap swap;
  swap.list = &list;
  swap.linear = exposureEv != 0 ? expose(colors, exposureEv) : colors;
  swap.displayed = base::makeGathered<std::uint8_t>(list.pixels.size(), 3);
  for (const std::uint32_t place : swapped.whole) {
    std::copy_n(&finished->pixels.pixels[3 * std::size_t{list.pixels[place]}], 3,
                &swap.displayed.pixels[3 * std::size_t{place}]);
    if (std::ranges::binary_search(finished->nonFinite, list.pixels[place])) swap.nonFinite.push_back(place);
  }
  if (rest.empty()) return swap;
  base::Image gathered = base::makeGathered<float>(rest.size(), 3);
  for (std::size_t i = 0; i < rest.size(); ++i)
    std::copy_n(&colors.pixels[3 * std::size_t{rest[i]}], 3, &gathered.pixels[3 * i]);
  const Displayed shown = displayImage(gathered, context.display(), exposureEv);
  for (std::size_t i = 0; i < rest.size(); ++i)
    std::copy_n(&shown.pixels.pixels[3 * i], 3, &swap.displayed.pixels[3 * std::size_t{rest[i]}]);
  for (const std::uint32_t i : shown.nonFinite) swap.nonFinite.push_back(rest[i]);
  std::ranges::sort(swap.nonFinite);
  return swap;
}

gpu::SwappedPixels mixByCoverage(const base::PixelList& list, const base::Image& before, const base::Image& after) {
  gpu::SwappedPixels swapped;
  base::Image& mixed = swapped.planes.emplace_back(base::makeGathered<float>(list.pixels.size(), 3));
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    const float *a = &before.pixels[3 * std::size_t{list.pixels[i]}],
                *b = &after.pixels[3 * std::size_t{list.pixels[i]}];
    const float weight = list.weights.empty() ? 1.f : list.weights[i];
    for (std::size_t c = 0; c < 3; ++c) mixed.pixels[3 * i + c] = weight == 1 ? b[c] : a[c] + weight * (b[c] - a[c]);
    if (weight == 1) swapped.whole.push_back(static_cast<std::uint32_t>(i));
  }
  return swapped;
}

} // namespace parity::job

#include "job/scene/swap_effects.h"

#include <algorithm>

#include "compare/metrics/measure_swaps.h"

namespace parity::job {

std::map<std::size_t, double> swapEffects(Context& context, const std::set<std::size_t>& materials,
                                          const ViewFrames& frames, const Displayed& reference,
                                          const base::Image& without, float exposureEv) {
  const Displayed shown = displayImage(without, context.display(), exposureEv);
  std::vector<compare::Swap> swaps;
  for (const std::size_t m : materials) {
    const base::PixelList& list = frames.coverage[m];
    compare::Swap& swap = swaps.emplace_back(
        displaySwap(context, list, mixByCoverage(list, frames.first().frame.color, without), 0, exposureEv, &shown));
    swap.linear = {};
    // What is no number in both was no number before: black in both.
    std::erase_if(swap.nonFinite, [&](std::uint32_t place) {
      return std::ranges::binary_search(reference.nonFinite, list.pixels[place]);
    });
  }
  compare::MeasureRequest request;
  request.statistics = {"flip.mean"};
  const std::vector<compare::Figures> measured =
      compare::measureSwaps({.displayed = reference.pixels}, swaps, request).figures;
  std::map<std::size_t, double> effects;
  for (auto m = materials.begin(); const compare::Figures& figures : measured) {
    const std::size_t material = *m++;
    if (const std::optional<double> flip = figures.find("flip.mean"); flip && figures.pixels > 0)
      effects.emplace(material, *flip);
  }
  return effects;
}

} // namespace parity::job

#include "job/view/path_stage.h"

#include "base/parallel.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/measure_swaps.h"
#include "job/view/material_swaps.h"

namespace parity::job {

std::vector<compare::Figures> measureStage(Context& context, const StageRequest& request) {
  const base::Stopwatch watch(&context.timings(), "compare path stages");
  // A shader that computes in halves loses nothing in a target of halves.
  const bool isSame = request.before.pixels == request.after.pixels; // never where a pixel is NaN
  Displayed shown;
  if (!isSame) shown = displayImage(request.before, context.display(), request.exposureEv);
  const Displayed& before = isSame ? request.afterDisplayed : shown;

  // Bias is of displayed light, too: light above white, which 8 bits do not hold, is shown by no target.
  std::vector<std::uint32_t> invalid = before.nonFinite;
  invalid.insert(invalid.end(), request.afterDisplayed.nonFinite.begin(), request.afterDisplayed.nonFinite.end());
  compare::MeasureRequest measure{.metrics = {"bias"}, .statistics = {"flip.mean", "flip.p95", "flip.max"}};
  measure.options.box = request.box;
  std::vector<compare::Figures> figures =
      compare::measureRegions({before.pixels, request.afterDisplayed.pixels, nullptr, nullptr, invalid},
                              {request.whole}, measure)
          .regions;
  std::vector<compare::Swap> swaps(request.materials.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t i, std::size_t) {
    const base::PixelList& list = *request.materials[i];
    swaps[i] = displaySwap(context, list, mixByCoverage(list, request.before, request.after), 0, request.exposureEv,
                           &request.afterDisplayed);
    swaps[i].linear = {};
  });
  for (compare::Figures& each :
       compare::measureSwaps({before.pixels, nullptr, before.nonFinite}, swaps, measure).figures)
    figures.push_back(std::move(each));
  return figures;
}

} // namespace parity::job

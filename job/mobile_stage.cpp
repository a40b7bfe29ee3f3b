#include "job/mobile_stage.h"

#include "compare/measure.h"

namespace parity::job {

std::vector<compare::RegionFigures> measureStage(Context& context, const StageRequest& request) {
  const base::Stopwatch watch(&context.timings(), "stages of mobile");
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
  compare::Measurement measured = compare::measureRegions(
      {before.pixels, request.afterDisplayed.pixels, nullptr, nullptr, invalid}, request.lists, measure);
  return std::move(measured.regions);
}

} // namespace parity::job

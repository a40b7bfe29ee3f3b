#include "job/encoding_stage.h"

#include "compare/measure.h"

namespace parity::job {

std::vector<compare::Encoding> measureEncoding(Context& context, const EncodingRequest& request) {
  const base::Stopwatch watch(&context.timings(), "encoding stage");
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

  const auto target = static_cast<std::size_t>(context.settings().mobileTarget);
  std::vector<compare::Encoding> stages;
  for (compare::RegionFigures& region : measured.regions)
    stages.push_back({gpu::outputTargetNames()[target], std::move(region)});
  return stages;
}

} // namespace parity::job

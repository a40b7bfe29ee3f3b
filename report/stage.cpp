#include "report/stage.h"

#include <algorithm>

#include <fmt/format.h>

#include "report/wording.h"

namespace parity::report {
namespace {

constexpr double kNotable = 0.0005; // what three digits show

} // namespace

const StageResult* findStage(const std::vector<StageResult>& stages, std::string_view stage) {
  const auto found = std::ranges::find(stages, stage, &StageResult::stage);
  return found == stages.end() ? nullptr : &*found;
}

bool isShown(const StageResult& stage) {
  if (stage.stage != kEncodingStage) return true;
  const std::optional<double> mean = stage.figures.find("flip.mean");
  return mean && !(*mean < kNotable);
}

StageWords describe(const StageResult& stage, const std::string& path) {
  if (stage.stage == kEncodingStage)
    return {"target",
            fmt::format("mean FLIP caused only by storing the colour of {} in {}", titleOf(path), stage.through)};
  if (stage.stage == kTexturesStage)
    return {"textures",
            fmt::format("mean FLIP caused only by compressing the textures of {} as {}", titleOf(path), stage.through)};
  return {stage.stage, fmt::format("mean FLIP caused only by {}", stage.through)};
}

} // namespace parity::report

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
            fmt::format("mean FLIP that storing {}'s colour in {} makes by itself", titleOf(path), stage.through)};
  if (stage.stage == kTexturesStage)
    return {"textures",
            fmt::format("mean FLIP that {}'s textures in {} make by themselves", titleOf(path), stage.through)};
  return {stage.stage, fmt::format("mean FLIP that {} makes by itself", stage.through)};
}

} // namespace parity::report

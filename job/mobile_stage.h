// Measures what a stage of the mobile path makes by itself: its picture after the stage against the one before it.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "compare/figures.h"
#include "compare/pixel_view.h"
#include "job/context.h"
#include "job/displayed.h"

namespace parity::job {

struct StageRequest {
  const base::Image &before, &after; // linear, scene-referred
  const Displayed& afterDisplayed;
  const std::vector<base::PixelList>& lists;
  const std::optional<compare::Rect>& box; // as compare::MetricOptions::box
  float exposureEv = 0;
};

// As many as lists, in their order; those without pixels have no figures.
std::vector<compare::RegionFigures> measureStage(Context& context, const StageRequest& request);

} // namespace parity::job

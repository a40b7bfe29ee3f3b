// Measures what a stage of a path makes by itself: its picture after the stage against the one before it.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "compare/pooling/figures.h"
#include "compare/pooling/pixel_view.h"
#include "job/context.h"
#include "job/view/displayed.h"

namespace parity::job {

struct StageRequest {
  const base::Image &before, &after; // linear, scene-referred
  const Displayed& afterDisplayed;
  const base::PixelList& whole;
  const std::vector<const base::PixelList*>& materials;
  const std::optional<compare::Rect>& box; // as compare::MetricOptions::box, of the whole
  float exposureEv = 0;
};

// Of the whole, then of the materials in their order; those without pixels have no figures. A material is measured in
// the picture before the stage that it alone has passed, by its coverage of each pixel.
std::vector<compare::Figures> measureStage(Context& context, const StageRequest& request);

} // namespace parity::job

// Measures the stage `encoding`: the mobile picture after its render target against the one before it.
#pragma once

#include <optional>
#include <vector>

#include "base/frame.h"
#include "compare/encoding.h"
#include "compare/pixel_view.h"
#include "job/context.h"
#include "job/displayed.h"

namespace parity::job {

struct EncodingRequest {
  const base::Image &before, &after; // linear, scene-referred
  const Displayed& afterDisplayed;
  const std::vector<base::PixelList>& lists;
  const std::optional<compare::Rect>& box; // as compare::MetricOptions::box
  float exposureEv = 0;
};

// As many as lists, in their order; those without pixels have no figures.
std::vector<compare::Encoding> measureEncoding(Context& context, const EncodingRequest& request);

} // namespace parity::job

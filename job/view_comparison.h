// One view compared: displayed images, FLIP map, figures per material, pictures written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/budget.h"
#include "compare/report.h"
#include "job/scene_renderer.h"
#include "mobile/sampler_rule.h"

namespace parity::job {

struct ViewComparisonRequest {
  std::string sceneName, viewName;
  float exposureEv = 0;
  std::filesystem::path reportFolder; // where images/ lies; empty: no pictures are written
  std::string imagePrefix;            // unique to scene and view, safe in file names
  mobile::SamplerInputs samplers;     // what the mobile path fetches besides the material's textures
};

// frames: both paths' and the coverage. The displayed images are compared as 8-bit pictures: `parity flip` on the
// written PNGs gives the same map. Throws Error (exit 4) where a picture cannot be written.
compare::ViewResult compareView(Context& context, const scenes::Scene& scene, const ViewFrames& frames,
                                const compare::Budgets& budgets, const ViewComparisonRequest& request);

} // namespace parity::job

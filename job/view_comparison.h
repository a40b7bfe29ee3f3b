// One view compared: displayed images, FLIP map, figures per material, pictures.
#pragma once

#include <string>
#include <vector>

#include "compare/report.h"
#include "job/displayed.h"
#include "job/scene_renderer.h"
#include "job/view_pictures.h"
#include "mobile/sampler_rule.h"

namespace parity::job {

struct ViewComparisonRequest {
  std::string viewName;
  float exposureEv = 0;
  std::vector<std::string> statistics; // wanted by budgets, besides the settings' metrics
  bool pictures = false;
  bool pixelData = false;         // also the values behind the pictures
  std::string imagePrefix;        // unique to scene and view, safe in file names
  mobile::SamplerInputs samplers; // what the mobile path fetches besides the material's textures
};

struct ComparedView {
  compare::ViewResult view; // not judged
  std::vector<EncodedPicture> pictures;
  std::vector<std::size_t> materials; // of the view's materials their places in the scene
  Displayed highend, mobile;          // what was compared
};

// frames: both paths' and the coverage. The displayed images are compared as 8-bit pictures: `parity flip` on the
// written PNGs gives the same map. Throws Error (exit 4) where a picture cannot be made.
ComparedView compareView(Context& context, const scenes::Scene& scene, const ViewFrames& frames,
                         const ViewComparisonRequest& request);

// Mean scene-referred luminance of each term over the region; empty where the frames have no terms or it no pixels.
std::vector<compare::TermFigures> termFigures(const ViewFrames& frames, const base::PixelList& list);

} // namespace parity::job

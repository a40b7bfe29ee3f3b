// One view compared: displayed images, FLIP map, figures per material, pictures.
#pragma once

#include <string>
#include <vector>

#include "job/scene/scene_renderer.h"
#include "job/scene/view_rows.h"
#include "job/view/displayed.h"
#include "job/view/view_pictures.h"
#include "report/report.h"

namespace parity::job {

struct ViewComparisonRequest {
  std::string viewName;
  const Settings& settings; // of the scene
  const PathChoice& paths;
  // Columns of the view (job/scene/view_rows.h), and what is compared with what.
  const std::vector<Column>& columns;
  std::size_t reference = 0, test = 1;
  const paths::Renderer* renderer = nullptr; // of the test path; null: it is a picture of another engine
  // Whether one of the two is such a picture, or the reference is not the first path.
  bool isMixed() const { return !renderer || reference != 0; }
  std::vector<std::string> statistics{}; // wanted by budgets, besides the settings' metrics
  bool pictures = false;
  bool pixelData = false;    // also the values behind the pictures
  std::string imagePrefix{}; // unique to scene and view, safe in file names
};

// The materials that the report is about, of the first `count`: their places in the scene. globs: of names; none: all.
std::vector<std::size_t> chooseMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs,
                                         std::size_t count);

struct ComparedView {
  report::ViewResult view; // not judged
  std::vector<EncodedPicture> pictures;
  std::vector<std::size_t> materials; // of the view's materials their places in the scene
  std::size_t test = 1;               // place of the path
  Displayed reference, tested;        // what was compared: the first path's picture, and that one's
};

// frames: of the paths, and the coverage. The displayed images are compared as 8-bit pictures: `parity flip` on the
// written PNGs gives the same map. Throws Error (exit 4) where a picture cannot be made.
ComparedView compareView(Context& context, const scenes::Scene& scene, const ViewFrames& frames,
                         const ViewComparisonRequest& request);

// Mean scene-referred luminance of each term over the region; empty where the frames have no terms or it no pixels.
std::vector<report::TermFigures> termFigures(const ViewFrames& frames, std::size_t test, const base::PixelList& list);

} // namespace parity::job

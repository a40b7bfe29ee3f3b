// Which pictures of a scene a report keeps.
#pragma once

#include "job/report_end.h"
#include "job/report_run.h"
#include "job/scene/scene_comparison.h"

namespace parity::job {

// Takes the pictures and pixel files out of each view without a row that the run would show as no pass, where only such
// are wanted; the small pictures of textures stay if any view does. baseline: that the run is held against; null: none.
void dropPictures(ComparedScene& scene, Pictures wanted, const report::Report* baseline, const RunFacts& facts);

} // namespace parity::job

// The values behind a view's pictures, as planes of a pixel file.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "job/scene/view_rows.h"
#include "job/view/view_frames.h"
#include "report/pixel_chunk.h"

namespace parity::job {

struct ViewPlanes {
  std::vector<report::PixelPlane> color, terms; // of frames and maps that must outlive them, and of those below
  std::deque<base::Image> made;
};

// Of two columns of a view (job/scene/view_rows.h). materialFlip: of each chosen material the FLIP of its pixels, by
// the material swap. color: the two by name, truth where there is one (linear, before exposure), flip (of the whole
// images), materialFlip (of the material that covers most of a pixel; by the material swap), material: 1 + the place in
// `chosen` of the one that covers most of the pixel, 0 where none does. terms: as below. chosen: materials by their
// places in the coverage.
ViewPlanes planesOf(const ViewFrames& frames, const std::vector<Column>& columns, std::size_t reference,
                    std::size_t test, const base::Image& flip, const std::vector<std::vector<float>>& materialFlip,
                    const std::vector<std::size_t>& chosen);

// NAME.TERM by the first path and the one at `test` of each term that is not black in both; empty where the frames have
// no terms.
std::vector<report::PixelPlane> termPlanesOf(const ViewFrames& frames, const std::vector<Column>& columns,
                                             std::size_t test);

} // namespace parity::job

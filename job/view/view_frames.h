// The frames of one view, by every path, and what they make together.
#pragma once

#include <cstddef>
#include <vector>

#include "base/frame.h"
#include "gpu/surface/material_swap.h"

namespace parity::job {

struct PathFrames {
  base::Frame frame; // an empty image of a term: 0 everywhere
  // Of paths that are compared with the first, else empty.
  base::Image beforeTarget; // the colour as if nothing were stored
  base::Image ofOriginals;  // with the textures as they are; empty where the path has them, too
  // The material swap, one for each coverage list: the first path's picture in which the material alone carries this
  // one's colours. And before the target, where that is displayed: nothing is cut off.
  std::vector<gpu::SwappedPixels> swap, swapLight;
  // `swap` as it was computed, before the target, then by the first path's terms at these places (TermVariants); of the
  // materials that are attributed. A term without a plane changes nothing.
  std::vector<gpu::SwappedPixels> termVariants;
  std::vector<std::size_t> variantTerms;
  // With the truth, of every path: the truth's picture with this one's colours; its terms as planes in the order of
  // shading::Term.
  std::vector<gpu::SwappedPixels> truthSwap, truthTermSwap;
};

struct ViewFrames {
  std::vector<PathFrames> paths;         // in the order of the choice
  std::vector<PathFrames> whatIfs;       // of each preset in settings.whatIfs what swaps of materials are made of
  base::Frame truth;                     // empty where not asked for, as the next three
  base::Image truthError;                // relative standard error of each pixel (job/scene/reference_path.h)
  base::Image truthTaken;                // samples of each pixel, of the environment, for each way of sampling
  double truthSamples = 0;               // taken of the environment, a point and way of sampling
  std::vector<base::PixelList> coverage; // a list per material; where paths are compared, or with settings.coverage

  const PathFrames& first() const { return paths.front(); }
};

} // namespace parity::job

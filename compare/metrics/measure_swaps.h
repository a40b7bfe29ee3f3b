// Measuring materials by the material swap (docs/metrics.md): each against the reference picture, in a picture that is
// the reference but where the material carries its own other colours.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/frame.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/metric_input.h"
#include "compare/pooling/figures.h"

namespace parity::compare {

// The picture that all swaps differ from.
struct SwapReference {
  PixelView displayed;                           // display-encoded sRGB, 3 channels, bytes or floats
  const base::Image* linear = nullptr;           // linear Rec.709 light as exposed, 3 channels; null: there is none
  std::span<const std::uint32_t> nonFinite = {}; // pixels (y*width+x) that cannot be used, ascending
};

// A material's swapped picture, at the pixels of its list; everywhere else it is the reference.
struct Swap {
  const base::PixelList* list = nullptr;
  base::Image8 displayed;               // gathered (base/gathered.h), 3 channels, as SwapReference::displayed in bytes
  base::Image linear;                   // gathered, 3 channels; empty where the reference has none
  std::vector<std::uint32_t> nonFinite; // places in the list that cannot be used, ascending
};

struct SwapMeasurement {
  std::vector<Figures> figures; // as many as swaps, in their order
  // FLIP of each swap's pixels, in the order of its list, where keepMaps of the request holds "flip".
  std::vector<std::vector<float>> flip;
};

// Figures of each swap's own pixels, weighted by their coverage. A metric of single pixels is measured on the list's
// pixels alone; FLIP and HDR-FLIP by flipSwaps, the reference's filtered values shared by all; SSIM in the box of the
// list and its window's reach; MS-SSIM on whole pictures, as its coarse scales see them all. A swap without pixels
// gives pixels = 0 and no values. Exposures of HDR-FLIP are those of the reference. Pixels that are not finite enter as
// by measureRegions. options.box is not used. Throws Error as measureRegions does.
SwapMeasurement measureSwaps(const SwapReference& reference, std::span<const Swap> swaps,
                             const MeasureRequest& request);

} // namespace parity::compare

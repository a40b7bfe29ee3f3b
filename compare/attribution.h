// Which term makes mobile look different: each swapped for the high-end path's, displayed and compared again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/frame.h"
#include "compare/pixel_view.h"
#include "compare/report.h"

namespace parity::compare {

// Both paths' pictures of a view; all of one size. What is referred to must outlive the call.
struct AttributionInput {
  const base::Image8 &reference, &test; // high-end and mobile as displayed: what the report's figures are of
  std::span<const std::uint32_t> referenceNonFinite, testNonFinite; // their pixels (y*width+x) that are not finite
  const base::Image& testColor; // mobile's, linear scene-referred RGB: the sum of its terms
  const std::vector<base::Image>&referenceTerms, &testTerms; // as base::Frame::terms
};

// A linear picture as the screen shows it.
struct ShownPicture {
  base::Image8 pixels;                  // RGB; black where not finite
  std::vector<std::uint32_t> nonFinite; // y*width+x
};
// Called from several threads with the part of the view's picture that `box` says: each pixel must be shown by itself.
using ShowFunction = std::function<ShownPicture(const base::Image& linear, const Rect& box)>;

// For each material (its pixels, as measured) what mean FLIP against high-end is, and what it becomes by each term that
// is not the same in both paths at some of its pixels: mobile's colour less its own term, plus the high-end path's;
// where mobile's colour is not finite the sum of its other terms, plus the high-end path's (the background's share is
// left out there), so that a term that is NaN is found. Nothing is clamped before `show`. Means are over the interior
// (all pixels where there is none), exactly the figures that measureRegions gives for "flip.mean" of such a picture;
// pixels that are not finite count 1, as there. A term is swapped in the whole picture, one picture serving all
// materials: over interiors that is a swap in the material alone, over `all` the neighbours' swapped terms reach in at
// the rim. Nothing for a material without pixels. The result does not depend on the number of threads. Throws Error:
// notComparable for sizes that differ and for frames without terms; failed for a malformed list.
std::vector<std::optional<Attribution>> attributeTerms(const AttributionInput& input,
                                                       std::span<const base::PixelList* const> materials,
                                                       const ShowFunction& show);

} // namespace parity::compare

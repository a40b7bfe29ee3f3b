// What LDR- and HDR-FLIP have in common: checks of the input, and the tiles of a region.
#pragma once

#include <functional>
#include <optional>

#include "compare/flip/flip_filters.h"
#include "compare/flip/flip_tile.h"

namespace parity::compare {

// Throws Error (usage) for a ppd outside its range.
void requireUsablePpd(float ppd);

// Throws Error (notComparable) as flipMap() says.
void requireComparableViews(const PixelView& reference, const PixelView& test);

// The region asked for, or the whole image. Throws Error (usage) where it is empty or leaves the image.
Rect regionOf(const PixelView& image, const std::optional<Rect>& region);

// Runs `work` for every tile of the region, on all cores, each with a workspace of its own. The sum of what it returns.
std::uint64_t forEachTile(const Rect& region, const FlipFilters& filters,
                          const std::function<std::uint64_t(TileWorkspace&, const Rect&)>& work);

// The region and the filters' margin around it, as far as the image goes.
Rect withMargin(const Rect& region, int radius, const PixelView& image);

} // namespace parity::compare

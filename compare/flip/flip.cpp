#include "compare/flip/flip.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "compare/flip/flip_run.h"

namespace parity::compare {
namespace {

// Fills those of the images that are not null.
std::uint64_t run(const PixelView& reference, const PixelView& test, const FlipOptions& options, base::Image* flip,
                  base::Image* color, base::Image* feature) {
  requireUsablePpd(options.ppd);
  requireComparableViews(reference, test);
  const Rect region = regionOf(reference, options.region);
  const FlipFilters filters = makeFlipFilters(options.ppd);
  const DifferenceMap differences(reference, test, withMargin(region, filters.radius, reference));
  for (base::Image* image : {flip, color, feature})
    if (image) *image = base::Image(reference.width, reference.height, 1);
  const TileJob job = {reference, test, &filters, &differences};
  return forEachTile(region, filters, [&](TileWorkspace& workspace, const Rect& tile) {
    const auto at = [&](base::Image* image) { return image ? image->at(tile.x, tile.y) : nullptr; };
    return workspace.run(job, RowDecoder{}, tile, {at(flip), at(color), at(feature), reference.width});
  });
}

} // namespace

float pixelsPerDegree(float distance, float resolutionX, float width) {
  for (float value : {distance, resolutionX, width})
    if (!(std::isfinite(value) && value > 0))
      throw base::Error(base::ExitCode::usage, "viewing conditions", std::to_string(value),
                        "distance, resolution and width must be positive");
  return static_cast<float>(static_cast<double>(distance) * static_cast<double>(resolutionX) /
                            static_cast<double>(width) * (std::numbers::pi / 180));
}

int flipFilterRadius(const FlipOptions& options) {
  requireUsablePpd(options.ppd);
  return colorFilterRadius(options.ppd);
}

base::Image flipMap(const PixelView& reference, const PixelView& test, const FlipOptions& options) {
  base::Image flip;
  run(reference, test, options, &flip, nullptr, nullptr);
  return flip;
}

FlipMaps flipMaps(const PixelView& reference, const PixelView& test, const FlipOptions& options) {
  FlipMaps maps;
  maps.filteredPixels = run(reference, test, options, &maps.flip, &maps.color, &maps.feature);
  return maps;
}

} // namespace parity::compare

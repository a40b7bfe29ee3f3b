#include "compare/flip/flip_run.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "compare/flip/flip.h"

namespace parity::compare {
namespace {

std::string shapeAndTypeOf(const PixelView& view) {
  return std::to_string(view.width) + " x " + std::to_string(view.height) + " x " + std::to_string(view.channels) +
         (view.floats ? " floats" : " bytes");
}

} // namespace

void requireUsablePpd(float ppd) {
  if (!(ppd >= kMinPixelsPerDegree && ppd <= kMaxPixelsPerDegree))
    throw base::Error(base::ExitCode::usage, "ppd", std::to_string(ppd),
                      "pixels per degree must be between 1 and 1000");
}

void requireComparableViews(const PixelView& reference, const PixelView& test) {
  const auto refuse = [](const char* subject, const std::string& reason) {
    return base::Error(base::ExitCode::notComparable, subject, "", reason);
  };
  if (reference.empty()) throw refuse("reference", "the image has no pixels");
  if (test.empty()) throw refuse("test", "the image has no pixels");
  if (reference.width != test.width || reference.height != test.height || reference.channels != test.channels ||
      !reference.floats != !test.floats)
    throw refuse("images", "the reference is " + shapeAndTypeOf(reference) + " (channels last), the test " +
                               shapeAndTypeOf(test));
  if (reference.channels != 3 && reference.channels != 4)
    throw refuse("FLIP", "needs images of 3 channels, not " + std::to_string(reference.channels));
}

Rect regionOf(const PixelView& image, const std::optional<Rect>& region) {
  if (!region) return {0, 0, image.width, image.height};
  const Rect& r = *region;
  if (r.empty() || r.x < 0 || r.y < 0 || r.width > image.width - r.x || r.height > image.height - r.y)
    throw base::Error(base::ExitCode::usage, "region",
                      std::to_string(r.x) + "," + std::to_string(r.y) + "," + std::to_string(r.width) + "," +
                          std::to_string(r.height),
                      r.empty() ? "is empty"
                                : "leaves the image of " + std::to_string(image.width) + " x " +
                                      std::to_string(image.height));
  return r;
}

Rect withMargin(const Rect& region, int radius, const PixelView& image) {
  const int x = std::max(0, region.x - radius), y = std::max(0, region.y - radius);
  return {x, y, std::min(image.width, region.x + region.width + radius) - x,
          std::min(image.height, region.y + region.height + radius) - y};
}

std::uint64_t forEachTile(const Rect& region, const FlipFilters& filters,
                          const std::function<std::uint64_t(TileWorkspace&, const Rect&)>& work) {
  const std::vector<Rect> tiles = tilesOf(region);
  WorkspacePool<TileWorkspace> workspaces([&] { return std::make_unique<TileWorkspace>(filters); });
  std::atomic<std::uint64_t> total{0};
  base::parallelFor(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    auto workspace = workspaces.take();
    for (std::size_t i = begin; i < end; ++i) total += work(*workspace, tiles[i]);
    workspaces.giveBack(std::move(workspace));
  });
  return total;
}

} // namespace parity::compare

#include "compare/pooling/region.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "compare/pooling/region_list.h"

namespace parity::compare {

void requireWellFormed(const base::PixelList& list, std::size_t pixelCount) {
  const auto refuse = [&](std::size_t i, const char* reason) {
    return base::Error(base::ExitCode::failed, "region '" + list.name + "'", "entry " + std::to_string(i), reason);
  };
  if (!list.weights.empty() && list.weights.size() != list.pixels.size())
    throw refuse(list.weights.size(), "the number of weights is not the number of pixels");
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    if (list.pixels[i] >= pixelCount) throw refuse(i, "the pixel is outside the image");
    if (i > 0 && list.pixels[i] <= list.pixels[i - 1]) throw refuse(i, "the pixels are not in ascending order");
  }
  for (std::size_t i = 0; i < list.weights.size(); ++i)
    if (!(list.weights[i] >= 0 && std::isfinite(list.weights[i])))
      throw refuse(i, "the weight is negative or not finite");
}

base::PixelList wholeImage(int width, int height) {
  base::PixelList list;
  list.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::iota(list.pixels.begin(), list.pixels.end(), 0u);
  return list;
}

Rect boundsOf(std::span<const base::PixelList* const> lists, int width, int height, int margin) {
  const std::size_t wholeSize = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto isWhole = [&](const base::PixelList* list) { return list->pixels.size() == wholeSize; };
  if (wholeSize > 0 && std::ranges::any_of(lists, isWhole)) return {0, 0, width, height};
  int x0 = width, y0 = height, x1 = 0, y1 = 0;
  for (const base::PixelList* list : lists)
    for (const std::uint32_t pixel : list->pixels) {
      const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
      x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
      y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
    }
  if (x0 >= x1) return {};
  x0 = std::max(x0 - margin, 0), y0 = std::max(y0 - margin, 0);
  return {x0, y0, std::min(x1 + margin, width) - x0, std::min(y1 + margin, height) - y0};
}

} // namespace parity::compare

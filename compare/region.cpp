#include "compare/region.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "compare/metrics.h"
#include "compare/region_list.h"

namespace parity::compare {
namespace {

bool isMember(const base::PixelList& list, std::size_t i) { return list.weights.empty() || list.weights[i] > 0; }

// Erosion along columns, fed with the row-eroded runs of a mask from the top down. A pixel survives where the
// 2*radius+1 rows around it all hold its column; rows beyond the image hold every column.
class ColumnErosion {
public:
  ColumnErosion(int width, int height, int radius, int firstColumn, int endColumn)
      : m_width(width), m_height(height), m_radius(radius), m_firstColumn(firstColumn),
        m_lastRow(static_cast<std::size_t>(endColumn - firstColumn), -2), m_held(m_lastRow.size(), 0) {}

  void addRun(int y, int begin, int end) {
    for (int x = begin; x < end; ++x) {
      const auto column = static_cast<std::size_t>(x - m_firstColumn);
      const int before = y == 0 ? m_radius : m_lastRow[column] == y - 1 ? m_held[column] : 0;
      m_held[column] = before + 1;
      m_lastRow[column] = y;
      if (m_held[column] >= window()) keep(x, y - m_radius);
    }
  }

  // The rows below the image. Returns the surviving pixels in ascending order.
  std::vector<std::uint32_t> finish() {
    for (int y = m_height; y < m_height + m_radius; ++y)
      for (std::size_t column = 0; column < m_held.size(); ++column)
        if (m_lastRow[column] == m_height - 1 && m_held[column] + (y - m_height + 1) >= window())
          keep(m_firstColumn + static_cast<int>(column), y - m_radius);
    return std::move(m_kept);
  }

private:
  int window() const { return 2 * m_radius + 1; }
  void keep(int x, int y) {
    m_kept.push_back(static_cast<std::uint32_t>(static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
                                                static_cast<std::size_t>(x)));
  }

  int m_width, m_height, m_radius, m_firstColumn;
  std::vector<int> m_lastRow, m_held; // per column: the last row that held it, and how many in a row up to there
  std::vector<std::uint32_t> m_kept;
};

} // namespace

void requireWellFormed(const base::PixelList& list, std::size_t pixelCount) {
  const auto refuse = [&](std::size_t i, const char* reason) {
    return base::Error(base::ExitCode::failed, "region '" + list.name + "'", "entry " + std::to_string(i), reason);
  };
  if (!list.weights.empty() && list.weights.size() != list.pixels.size())
    throw refuse(list.weights.size(), "there are not as many weights as pixels");
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    if (list.pixels[i] >= pixelCount) throw refuse(i, "the pixel lies outside the image");
    if (i > 0 && list.pixels[i] <= list.pixels[i - 1]) throw refuse(i, "the pixels are not in ascending order");
  }
  for (std::size_t i = 0; i < list.weights.size(); ++i)
    if (!(list.weights[i] >= 0 && std::isfinite(list.weights[i])))
      throw refuse(i, "the weight is negative or not finite");
}

base::PixelList erode(const base::PixelList& list, int width, int height, int radius) {
  requireWellFormed(list, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  base::PixelList out;
  out.name = list.name;
  if (list.pixels.empty()) return out;

  const auto w = static_cast<std::uint32_t>(width);
  int firstColumn = width, endColumn = 0;
  for (std::uint32_t pixel : list.pixels) {
    firstColumn = std::min(firstColumn, static_cast<int>(pixel % w));
    endColumn = std::max(endColumn, static_cast<int>(pixel % w) + 1);
  }
  ColumnErosion columns(width, height, radius, firstColumn, endColumn);
  for (std::size_t i = 0; i < list.pixels.size();) {
    if (!isMember(list, i)) {
      ++i;
      continue;
    }
    // One run of neighbours in a row, shortened by the radius at both ends that are not the image's.
    const std::size_t start = i++;
    const auto y = list.pixels[start] / w;
    while (i < list.pixels.size() && list.pixels[i] == list.pixels[i - 1] + 1 && list.pixels[i] / w == y &&
           isMember(list, i))
      ++i;
    const int begin = static_cast<int>(list.pixels[start] % w), end = begin + static_cast<int>(i - start);
    columns.addRun(static_cast<int>(y), begin == 0 ? 0 : begin + radius, end == width ? width : end - radius);
  }
  out.pixels = columns.finish();

  if (!list.weights.empty()) {
    std::size_t from = 0;
    for (std::uint32_t pixel : out.pixels) {
      while (list.pixels[from] != pixel) ++from;
      out.weights.push_back(list.weights[from]);
    }
  }
  return out;
}

RegionFigures measureRegion(const base::Image& referenceDisplay, const base::Image& testDisplay,
                            const base::Image& flipMap, const base::PixelList& list, const FlipOptions& options) {
  RegionFigures out;
  out.name = list.name;
  out.all = measure(referenceDisplay, testDisplay, flipMap, list);
  out.interior = measure(referenceDisplay, testDisplay, flipMap,
                         erode(list, flipMap.width, flipMap.height, flipFilterRadius(options)));
  return out;
}

base::PixelList wholeImage(int width, int height) {
  base::PixelList list;
  list.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::iota(list.pixels.begin(), list.pixels.end(), 0u);
  return list;
}

} // namespace parity::compare

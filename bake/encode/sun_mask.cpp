#include "bake/encode/sun_mask.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"

namespace parity::bake {

namespace {

void requireSizes(const SunMask& mask) {
  const auto isOf = [](const auto& image, int width, int height) {
    return image.width == width && image.height == height && image.channels == 1;
  };
  const bool fits =
      mask.factor >= 1 && mask.factor <= 16 && !mask.sight.empty() && mask.sight.channels == 1 &&
      mask.sight.width % mask.factor == 0 && mask.sight.height % mask.factor == 0 &&
      (isOf(mask.owner, mask.sight.width, mask.sight.height) || isOf(mask.owner, mask.width(), mask.height()));
  if (!fits)
    throw base::fileError("sun mask", "size",
                          fmt::format("{} x {} sub-texels, {} a texel, do not match {} x {} owners", mask.sight.width,
                                      mask.sight.height, mask.factor, mask.owner.width, mask.owner.height));
}

// Disjoint sets of indices, each named by its smallest.
class Sets {
public:
  std::size_t add() {
    m_parents.push_back(m_parents.size());
    return m_parents.size() - 1;
  }
  std::size_t find(std::size_t i) {
    while (m_parents[i] != i) i = m_parents[i] = m_parents[m_parents[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    m_parents[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::size_t> m_parents;
};

} // namespace

std::vector<MaskChart> findCharts(const SunMask& mask) {
  requireSizes(mask);
  std::vector<MaskChart::Run> runs;
  Sets sets;
  std::size_t above = 0, first = 0; // the runs of the row above, and of this one
  for (int y = 0; y < mask.sight.height; ++y) {
    above = first;
    first = runs.size();
    std::size_t near = above;
    for (int x = 0; x < mask.sight.width;) {
      if (*mask.sight.at(x, y) == kUnknown) {
        ++x;
        continue;
      }
      const std::uint32_t owner = mask.ownerAt(x, y);
      MaskChart::Run run{y, x, x + 1};
      while (run.x1 < mask.sight.width && *mask.sight.at(run.x1, y) != kUnknown && mask.ownerAt(run.x1, y) == owner)
        ++run.x1;
      runs.push_back(run);
      const std::size_t self = sets.add();
      while (near < first && runs[near].x1 < run.x0) ++near;
      for (std::size_t k = near; k < first && runs[k].x0 <= run.x1; ++k)
        if (mask.ownerAt(runs[k].x0, y - 1) == owner) sets.join(self, k);
      x = run.x1;
    }
  }

  std::vector<MaskChart> charts;
  std::vector<std::size_t> chartOf(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t root = sets.find(i);
    if (root == i) {
      chartOf[i] = charts.size();
      charts.push_back({{}, runs[i].x0, runs[i].y, runs[i].x1, runs[i].y + 1});
    }
    MaskChart& chart = charts[chartOf[root]];
    chart.runs.push_back(runs[i]);
    chart.x0 = std::min(chart.x0, runs[i].x0);
    chart.x1 = std::max(chart.x1, runs[i].x1);
    chart.y1 = runs[i].y + 1;
  }
  return charts;
}

base::Image8 makeVisibilityMask(const SunMask& mask) {
  requireSizes(mask);
  const int width = mask.width(), height = mask.height(), factor = mask.factor;
  struct Counts {
    int lit = 0, known = 0;
  };
  std::vector<Counts> counts(static_cast<std::size_t>(width) * height);
  const auto forRows = [&](const auto& body) {
    base::parallelFor(static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) body(static_cast<int>(y));
    });
  };
  forRows([&](int y) {
    for (int x = 0; x < width * factor; ++x) {
      Counts& count = counts[static_cast<std::size_t>(y) * width + x / factor];
      for (int row = y * factor; row < (y + 1) * factor; ++row) {
        count.lit += *mask.sight.at(x, row) == kLit;
        count.known += *mask.sight.at(x, row) != kUnknown;
      }
    }
  });
  base::Image8 visibility(width, height, 1, 255);
  forRows([&](int y) {
    for (int x = 0; x < width; ++x) {
      Counts sum = counts[static_cast<std::size_t>(y) * width + x];
      if (sum.known == 0)
        for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row)
          for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column) {
            const Counts& other = counts[static_cast<std::size_t>(row) * width + column];
            sum = {sum.lit + other.lit, sum.known + other.known};
          }
      if (sum.known > 0)
        *visibility.at(x, y) = static_cast<std::uint8_t>((510 * sum.lit + sum.known) / (2 * sum.known));
    }
  });
  return visibility;
}

} // namespace parity::bake

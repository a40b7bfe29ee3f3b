#include "bake/light/direction_guide.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace parity::bake {

namespace {

// Cumulative shares of the values, from 0 to 1.
void accumulate(std::span<const double> values, std::span<double> result) {
  result[0] = 0;
  std::partial_sum(values.begin(), values.end(), result.begin() + 1);
  const double total = result.back();
  for (double& share : result) share /= total;
}

// The interval that u lies in; u becomes the place in all of them, each as wide as the other. density: times what that
// interval's is.
std::size_t find(std::span<const double> cumulative, double& u, double& density) {
  const auto count = static_cast<double>(cumulative.size() - 1);
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
  const auto i = static_cast<std::size_t>(above - cumulative.begin()) - 1;
  const double share = cumulative[i + 1] - cumulative[i];
  density *= share * count;
  u = (static_cast<double>(i) + std::clamp((u - cumulative[i]) / share, 0.0, 1.0)) / count;
  return i;
}

} // namespace

DirectionGuide::DirectionGuide(const std::array<double, kCells>& wanted)
    : m_rows(kRows + 1), m_columns(kRows * (kColumns + 1)) {
  std::array<double, kRows> sums{};
  for (std::size_t row = 0; row < kRows; ++row) {
    const auto cells = std::span(wanted).subspan(row * kColumns, kColumns);
    sums[row] = std::accumulate(cells.begin(), cells.end(), 0.0);
    accumulate(cells, std::span(m_columns).subspan(row * (kColumns + 1), kColumns + 1));
  }
  accumulate(sums, m_rows);
}

double DirectionGuide::warp(glm::dvec2& u) const {
  double density = 1;
  if (m_rows.empty()) return density;
  const std::size_t row = find(m_rows, u.x, density);
  find(std::span(m_columns).subspan(row * (kColumns + 1), kColumns + 1), u.y, density);
  return density;
}

} // namespace parity::bake

#include "bake/light/direction_guide.h"

#include <algorithm>
#include <bit>
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

// The interval that u lies in, of a power of two of them; u becomes the place in all of them, each as wide as the
// other. density: times what that interval's is. The search has no branch: a processor would guess every second one
// wrongly.
template <std::size_t count> std::size_t find(const double* cumulative, double& u, double& density) {
  static_assert(std::has_single_bit(count));
  std::size_t i = 0;
  for (std::size_t half = count / 2; half > 0; half /= 2) i += half * (cumulative[i + half] <= u ? 1 : 0);
  const double share = cumulative[i + 1] - cumulative[i];
  density *= share * static_cast<double>(count);
  u = (static_cast<double>(i) + std::clamp((u - cumulative[i]) / share, 0.0, 1.0)) / static_cast<double>(count);
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
  const std::size_t row = find<kRows>(m_rows.data(), u.x, density);
  find<kColumns>(m_columns.data() + row * (kColumns + 1), u.y, density);
  return density;
}

} // namespace parity::bake

#include "bake/light/texel_groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "bake/atlas/texel_points.h"

namespace parity::bake {

namespace {

// Which of the six axes, with their signs, a texel's first point is turned to.
std::uint8_t facingOf(const TexelGrid& grid, const Texel& texel) {
  const TexelPoints points = pointsOf(grid, texel);
  if (points.count == 0) return 0;
  const glm::vec3 n = points.points[0].normal, a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<std::uint8_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

} // namespace

TexelGroups::TexelGroups(const TexelGrid& grid) : m_order(grid.texels().size()) {
  std::vector<std::uint8_t> facing;
  facing.reserve(m_order.size());
  for (const Texel& texel : grid.texels()) facing.push_back(facingOf(grid, texel));
  const auto groupOf = [&](std::uint32_t i) {
    const Texel& t = grid.texels()[i];
    return std::tuple(t.page, t.y / kSide, t.x / kSide, t.instance, facing[i]);
  };
  std::iota(m_order.begin(), m_order.end(), 0u);
  std::ranges::sort(m_order, {}, [&](std::uint32_t i) { return std::tuple_cat(groupOf(i), std::tuple(i)); });
  for (std::uint32_t k = 0; k < m_order.size(); ++k)
    if (k == 0 || groupOf(m_order[k]) != groupOf(m_order[k - 1])) m_first.push_back(k);
  m_first.push_back(static_cast<std::uint32_t>(m_order.size()));
}

} // namespace parity::bake

// Neighbouring texels that see nearly the same: they are gathered for together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/texels.h"

namespace parity::bake {

class TexelGroups {
public:
  static constexpr int kSide = 4; // of a square of texels on a page, from which a group is taken
  static constexpr std::size_t kMost = std::size_t{kSide} * kSide;

  // Each group is of one object and of normals that point the same way by their largest component.
  explicit TexelGroups(const TexelGrid& grid);

  std::size_t count() const { return m_first.size() - 1; }
  // Indices into grid.texels(), 1 to kMost; each texel is in one group.
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(m_order).subspan(m_first[group], m_first[group + 1] - m_first[group]);
  }

private:
  std::vector<std::uint32_t> m_order, m_first;
};

} // namespace parity::bake

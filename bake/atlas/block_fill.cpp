#include "bake/atlas/block_fill.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "bake/encode/lightmap_page.h"
#include "base/parallel.h"

namespace parity::bake {

namespace {

using Owners = base::BasicImage<std::uint32_t>;

class BlockFiller {
public:
  BlockFiller(const Owners& owner, int side, base::Image8& codes)
      : m_owner(owner), m_codes(codes), m_side(side), m_known(static_cast<std::size_t>(side) * side) {}

  // The block with its first texel at (x0, y0).
  void fill(int x0, int y0) {
    m_width = std::min(m_side, m_codes.width - x0);
    m_height = std::min(m_side, m_codes.height - y0);
    int known = 0;
    for (int y = 0; y < m_height; ++y)
      for (int x = 0; x < m_width; ++x)
        known += knownAt(x, y) = *m_owner.at(x0 + x, (y0 + y) % m_owner.height) != kNoInstance;
    if (known == 0) return;
    for (; known < m_width * m_height; m_added.clear()) {
      for (int y = 0; y < m_height; ++y)
        for (int x = 0; x < m_width; ++x)
          if (!knownAt(x, y) && takeMean(x0, y0, x, y)) m_added.emplace_back(x, y);
      for (const auto& [x, y] : m_added) knownAt(x, y) = 1;
      known += static_cast<int>(m_added.size());
    }
  }

private:
  std::uint8_t& knownAt(int x, int y) { return m_known[static_cast<std::size_t>(y * m_side + x)]; }

  // From the known ones of its eight neighbours, if there are any.
  bool takeMean(int x0, int y0, int x, int y) {
    std::array<int, 3> sum{};
    int weight = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, m_height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, m_width - 1); ++u) {
        if (!knownAt(u, v)) continue;
        const int w = u == x || v == y ? 2 : 1;
        weight += w;
        for (int c = 0; c < 3; ++c) sum[c] += w * m_codes.at(x0 + u, y0 + v)[c];
      }
    for (int c = 0; c < 3 && weight > 0; ++c)
      m_codes.at(x0 + x, y0 + y)[c] = static_cast<std::uint8_t>((sum[c] + weight / 2) / weight);
    return weight > 0;
  }

  const Owners& m_owner;
  base::Image8& m_codes;
  int m_side, m_width = 0, m_height = 0;
  std::vector<std::uint8_t> m_known;
  std::vector<std::pair<int, int>> m_added;
};

} // namespace

void fillBlocks(const Owners& owner, int side, base::Image8& codes) {
  const auto rows = static_cast<std::size_t>((codes.height + side - 1) / side);
  base::parallelFor(rows, 4, [&](std::size_t begin, std::size_t end) {
    BlockFiller filler(owner, side, codes);
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
      for (int x0 = 0; x0 < codes.width; x0 += side) filler.fill(x0, row * side);
  });
}

} // namespace parity::bake

// Charts into a page by their outlines, which leave less free between them than their rectangles do.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/flat_chart.h"

namespace parity::bake {

// For each column of a rectangle the rows [low, high) that are taken; low = its height and high = 0: none.
struct Profile {
  std::vector<std::uint16_t> low, high;
};

// Of a chart with `padding` texels around it: half of them (rounded down) to the left and above, the rest to the right
// and below, so that charts whose profiles do not meet have `padding` free texels between them, diagonally too.
// Columns: those of the chart and `padding` more.
Profile makeProfile(const FlatChart& chart, int padding);

// The upper outline of what is placed, a height a column (B. Levy et al., "Least Squares Conformal Maps", 2002, 4: the
// horizon). Each chart goes where its far side is lowest; of such places where it leaves the least below it. Cost of a
// placement: the page's width times the chart's.
class Horizon {
public:
  Horizon(int width, int height);

  // The corner of the rectangle placed; nothing where it does not fit.
  std::optional<glm::ivec2> place(const glm::ivec2& size, const Profile& profile);
  int usedHeight() const { return m_usedHeight; }

private:
  int m_height, m_usedHeight = 0;
  std::vector<int> m_heights; // of each column
};

} // namespace parity::bake

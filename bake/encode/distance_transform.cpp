#include "bake/encode/distance_transform.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "base/parallel.h"

namespace parity::bake {

namespace {

using Distances = base::BasicImage<std::int32_t>;

// Along the columns, not squared. A block of them at a time, so that rows are read as they lie in memory.
Distances distancesInColumns(const base::Image8& sources) {
  Distances distances(sources.width, sources.height, 1);
  base::parallelFor(static_cast<std::size_t>(sources.width), 64, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> last(end - begin, kNoSource); // distance to the last source passed
    const auto scan = [&](int y, bool isFirst) {
      for (std::size_t x = begin; x < end; ++x) {
        std::int32_t& d = last[x - begin];
        if (*sources.at(static_cast<int>(x), y) != 0)
          d = 0;
        else if (d != kNoSource)
          ++d;
        std::int32_t& out = *distances.at(static_cast<int>(x), y);
        out = isFirst ? d : std::min(out, d);
      }
    };
    for (int y = 0; y < sources.height; ++y) scan(y, true);
    std::fill(last.begin(), last.end(), kNoSource);
    for (int y = sources.height - 1; y >= 0; --y) scan(y, false);
  });
  return distances;
}

// Replaces a row's distances along the columns by squared distances. A column's parabola is p(x) = (x - i)^2 + g^2.
class RowEnvelope {
public:
  explicit RowEnvelope(int width) : m_column(width), m_from(width), m_square(width) {}

  void apply(std::int32_t* row, int width) {
    int count = 0; // parabolas of the envelope, each the lowest from m_from on
    for (int u = 0; u < width; ++u) {
      if (row[u] == kNoSource) continue;
      const std::int64_t square = std::int64_t{row[u]} * row[u];
      const auto valueAt = [&](std::int64_t x) { return (x - u) * (x - u) + square; };
      while (count > 0 && valueOf(count - 1, m_from[count - 1]) > valueAt(m_from[count - 1])) --count;
      std::int64_t from = 0;
      if (count > 0) { // behind where the two meet; not negative, as the last is the lower one at its own start
        const std::int64_t i = m_column[count - 1];
        from = 1 + (std::int64_t{u} * u - i * i + square - m_square[count - 1]) / (2 * (u - i));
      }
      if (from >= width) continue;
      m_column[count] = u;
      m_from[count] = from;
      m_square[count] = square;
      ++count;
    }
    if (count == 0) return; // there is no source
    for (int x = width - 1, k = count - 1; x >= 0; --x) {
      row[x] = static_cast<std::int32_t>(valueOf(k, x));
      if (x == m_from[k]) --k;
    }
  }

private:
  std::int64_t valueOf(int k, std::int64_t x) const { return (x - m_column[k]) * (x - m_column[k]) + m_square[k]; }

  std::vector<std::int64_t> m_column, m_from, m_square;
};

} // namespace

Distances squaredDistances(const base::Image8& sources) {
  assert(sources.channels == 1 && sources.width <= base::kMaxImageSide && sources.height <= base::kMaxImageSide);
  Distances distances = distancesInColumns(sources);
  base::parallelFor(static_cast<std::size_t>(distances.height), 16, [&](std::size_t begin, std::size_t end) {
    RowEnvelope envelope(distances.width);
    for (std::size_t y = begin; y < end; ++y) envelope.apply(distances.at(0, static_cast<int>(y)), distances.width);
  });
  return distances;
}

} // namespace parity::bake

#include "reference/irradiance_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parallel.h"

namespace parity::reference {

namespace {

using lighting::Float4;

using std::numbers::pi;
constexpr int kSide = 4; // parts a side of a patch
constexpr int kMostPartsAround = 1024, kMostPartsDown = 512;
// The light that would have to move to make a patch even, as a share of all, times the patch's radius: less than this
// is left as it is. Real maps: 12 us a normal; 1e-7 takes up to 40 and is not measurably closer.
constexpr double kUneven = 1e-6;

// The smallest power of two of which at most `most` cover `size` cells.
int stepOf(int size, int most) {
  int step = 1;
  while ((size + step - 1) / step > most) step *= 2;
  return step;
}

// Half the azimuths, in turns, over which cos(azimuth) > c. Abramowitz and Stegun 1964, 4.4.45: off by at most
// kArcError.
constexpr double kArcError = 6.8e-5 / (2 * pi);
double halfArc(double c) {
  if (!(c < 1)) return 0;
  if (!(c > -1)) return 0.5;
  const double x = std::abs(c);
  const double arc = std::sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 + x * -0.0187293))) / (2 * pi);
  return c < 0 ? 0.5 - arc : arc;
}

Float4 toFloat4(const glm::dvec3& v) {
  return Float4{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.f};
}

Float4 absolute(const Float4& v) { return v < 0 ? -v : v; }

// What is above the horizon of light that is even from `height - reach` to `height + reach` above it: its light vector
// counts `vector` times, its light `light` times.
template <typename Number> struct Above { Number vector, light; };
Above<float> above(float height, float reach) {
  if (height >= reach) return {1, 0};
  if (height <= -reach) return {0, 0};
  return {(height + reach) / (2 * reach), (reach * reach - height * height) / (4 * reach)};
}
Above<Float4> above(const Float4& height, const Float4& reach) {
  const Float4 scale = 0.5f / reach, low = height < -reach ? -reach : height, inside = low > reach ? reach : low;
  return {(inside + reach) * scale, (reach * reach - inside * inside) * (scale * 0.5f)};
}

} // namespace

struct IrradianceSums::Surface {
  float x, y, z;       // of the normal
  double place, slope; // of its azimuth in columns; cot(polar angle) times this is the cosine of the horizon's azimuth
};

IrradianceSums::IrradianceSums(int width, int height, std::span<const glm::vec4> cells, std::span<const double> rowY)
    : m_across(stepOf(width, kMostPartsAround)), m_down(stepOf(height, kMostPartsDown)),
      m_columnCount((width + m_across * kSide - 1) / (m_across * kSide)),
      m_period(static_cast<double>(width) / (m_across * kSide)), m_total(lightOf(width, cells, rowY)),
      m_bright(findBrightCells(width, cells, rowY, m_total)) {
  makeColumns(width);
  makeRows(rowY);
  std::vector<glm::dvec2> rims; // cosine and sine of the azimuths between cells
  for (int x = 0; x <= width; ++x) {
    const double azimuth = (static_cast<double>(x) / width - 0.5) * 2 * pi;
    rims.emplace_back(std::cos(azimuth), std::sin(azimuth));
  }
  m_patches.resize(m_rows.size() * m_columnCount);
  m_parts.resize(m_patches.size());
  m_prefix.resize(m_rows.size() * (m_columnCount + std::size_t{1}));
  base::parallelFor(m_rows.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      std::array<glm::dvec3, 3> before{};
      for (int column = 0; column < m_columnCount; ++column) {
        const std::array<glm::dvec3, 3> vector = makePatch(width, cells, rowY, rims, static_cast<int>(row), column);
        for (std::size_t k = 0; k < 3; ++k) before[k] += vector[k];
        m_prefix[row * (m_columnCount + std::size_t{1}) + column + 1] = {toFloat4(before[0]), toFloat4(before[1]),
                                                                         toFloat4(before[2])};
      }
    }
  });
}

void IrradianceSums::makeColumns(int width) {
  const auto azimuthAt = [&](int x) { return (static_cast<double>(std::min(x, width)) / width - 0.5) * 2 * pi; };
  for (int column = 0; column < m_columnCount; ++column) {
    const int first = column * kSide * m_across;
    const double left = azimuthAt(first), right = azimuthAt(first + kSide * m_across), middle = 0.5 * (left + right);
    m_columns.push_back({static_cast<float>(std::cos(middle)), static_cast<float>(std::sin(middle)),
                         static_cast<float>(0.5 * (right - left))});
    Columns parts;
    for (int i = 0; i < kSide; ++i) {
      const double from = azimuthAt(first + i * m_across), to = azimuthAt(first + (i + 1) * m_across);
      parts.cosine[i] = static_cast<float>(std::cos(0.5 * (from + to)));
      parts.sine[i] = static_cast<float>(std::sin(0.5 * (from + to)));
      parts.halfWidth[i] = static_cast<float>(0.5 * (to - from));
      parts.chord[i] = static_cast<float>(2 * std::sin(0.5 * (to - from)));
    }
    m_partColumns.push_back(parts);
  }
}

void IrradianceSums::makeRows(std::span<const double> rowY) {
  const int height = static_cast<int>(rowY.size()) - 1, inPatch = m_down * kSide;
  const auto heightAt = [&](int y) { return rowY[static_cast<std::size_t>(std::min(y, height))]; };
  const auto makeRow = [&](int from, int to) {
    const double top = heightAt(from), bottom = heightAt(to), polarTop = std::acos(top),
                 polarBottom = std::acos(bottom);
    const double middle = 0.5 * (polarTop + polarBottom);
    return Row{static_cast<float>(std::cos(middle)),
               static_cast<float>(std::sin(middle)),
               static_cast<float>(0.5 * (polarBottom - polarTop)),
               static_cast<float>(0.5 * (top * top - bottom * bottom)),
               static_cast<float>(radiusUntil(top) - radiusUntil(bottom)),
               static_cast<float>(top - bottom)};
  };
  const auto addCotangent = [&](double y) {
    constexpr double kMost = 1e30; // at the poles
    m_cotangents.push_back(std::clamp(y / std::sqrt(std::max(1 / (kMost * kMost), 1 - y * y)), -kMost, kMost));
  };
  addCotangent(heightAt(0));
  for (int y = 0; y < height; y += inPatch) {
    m_rows.push_back(makeRow(y, y + inPatch));
    addCotangent(heightAt(y + inPatch));
    for (int i = 0; i < kSide; ++i) m_partRows.push_back(makeRow(y + i * m_down, y + (i + 1) * m_down));
  }
}

// Returns its light vector: by the coordinate of the direction.
std::array<glm::dvec3, 3> IrradianceSums::makePatch(int width, std::span<const glm::vec4> cells,
                                                    std::span<const double> rowY, std::span<const glm::dvec2> rims,
                                                    int row, int column) {
  constexpr int kParts = kSide * kSide;
  const int height = static_cast<int>(rowY.size()) - 1, left = column * kSide * m_across, upper = row * kSide * m_down;
  const double turn = 2 * pi / width;
  std::array<glm::dvec3, 3> vector{};
  std::array<glm::dvec3, kParts> light{};
  std::array<double, kParts> areas{};
  for (int y = upper; y < std::min(upper + kSide * m_down, height); ++y) {
    const double top = rowY[y], bottom = rowY[y + 1], area = turn * (top - bottom);
    const double ofY = 0.5 * turn * (top * top - bottom * bottom), radius = radiusUntil(top) - radiusUntil(bottom);
    for (int x = left; x < std::min(left + kSide * m_across, width); ++x) {
      const int part = (y - upper) / m_down * kSide + (x - left) / m_across;
      areas[part] += area;
      const glm::dvec3 L = glm::dvec3(cells[static_cast<std::size_t>(y) * width + x]) / m_total;
      if (isBright(L * area)) continue;
      light[part] += L * area;
      vector[0] += L * (radius * (rims[x + 1].y - rims[x].y));
      vector[1] += L * ofY;
      vector[2] += L * (radius * (rims[x].x - rims[x + 1].x));
    }
  }
  const glm::dvec3 all = std::accumulate(light.begin(), light.end(), glm::dvec3(0));
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const std::size_t index = static_cast<std::size_t>(row) * m_columnCount + column;
  glm::dvec3 uneven(0);
  for (int i = 0; i < kParts; ++i) {
    uneven += glm::abs(light[i] - all * (areas[i] / area));
    m_parts[index][i] = toFloat4(areas[i] > 0 ? light[i] / areas[i] : glm::dvec3(0));
  }
  const double radius = std::hypot(m_rows[row].halfHeight, m_rows[row].sine * m_columns[column].halfWidth);
  Patch& patch = m_patches[index];
  patch.light = toFloat4(all);
  patch.light[3] = std::max({uneven.x, uneven.y, uneven.z}) * radius > kUneven ? 1 : 0;
  patch.vector = {toFloat4(vector[0]), toFloat4(vector[1]), toFloat4(vector[2])};
  return vector;
}

inline void IrradianceSums::addParts(Float4& sum, const Surface& n, int row, int column) const {
  const std::array<Float4, 16>& radiance = m_parts[static_cast<std::size_t>(row) * m_columnCount + column];
  const Columns& columns = m_partColumns[static_cast<std::size_t>(column)];
  const Float4 ahead = n.x * columns.cosine + n.z * columns.sine;
  const Float4 aside = absolute(n.z * columns.cosine - n.x * columns.sine) * columns.halfWidth;
  for (int j = 0; j < kSide; ++j) {
    const Row& r = m_partRows[static_cast<std::size_t>(row) * kSide + j];
    const Float4 height = n.y * r.cosine + ahead * r.sine;
    const Float4 alongRow = aside * r.sine, alongColumn = absolute(ahead * r.cosine - n.y * r.sine) * r.halfHeight;
    // Within 4 % of the root of the sum of squares.
    const Float4 reach =
        (alongRow > alongColumn ? alongRow + 0.4f * alongColumn : alongColumn + 0.4f * alongRow) + 1e-9f;
    const Above<Float4> part = above(height, reach);
    const Float4 vector = n.y * r.y * 2 * columns.halfWidth + r.radius * columns.chord * ahead;
    const Float4 weight = part.vector * vector + part.light * (r.height * 2 * columns.halfWidth);
    for (int i = 0; i < kSide; ++i) sum += weight[i] * radiance[j * kSide + i];
  }
}

inline void IrradianceSums::addPatch(Float4& sum, const Surface& n, int row, int column) const {
  const Patch& patch = m_patches[static_cast<std::size_t>(row) * m_columnCount + column];
  if (patch.light[3] > 0) return addParts(sum, n, row, column);
  const Row& r = m_rows[static_cast<std::size_t>(row)];
  const Column& c = m_columns[static_cast<std::size_t>(column)];
  const float ahead = n.x * c.cosine + n.z * c.sine, aside = n.z * c.cosine - n.x * c.sine;
  const float alongRow = aside * r.sine * c.halfWidth, alongColumn = (ahead * r.cosine - n.y * r.sine) * r.halfHeight;
  const Above<float> part =
      above(n.y * r.cosine + ahead * r.sine, std::sqrt(alongRow * alongRow + alongColumn * alongColumn));
  sum += part.vector * (n.x * patch.vector.x + n.y * patch.vector.y + n.z * patch.vector.z) + part.light * patch.light;
}

// narrow, wide: half of the columns that the horizon leaves wholly above, and of those it leaves a part of.
Float4 IrradianceSums::sumOfRow(const Surface& n, int row, double narrow, double wide) const {
  // Columns count on around the rim.
  const auto columnAt = [&](double place) {
    const int around = place < 0 ? -1 : place >= m_period ? 1 : 0;
    return around * m_columnCount + std::min(static_cast<int>(place - around * m_period), m_columnCount - 1);
  };
  const int first = columnAt(n.place - wide), last = std::min(columnAt(n.place + wide), first + m_columnCount - 1);
  Float4 sum{};
  const auto addCut = [&](int begin, int end) {
    for (int column = begin; column < end; ++column)
      addPatch(sum, n, row,
               column < 0               ? column + m_columnCount
               : column < m_columnCount ? column
                                        : column - m_columnCount);
  };
  const int wholeBegin = columnAt(n.place - narrow) + 1, wholeEnd = columnAt(n.place + narrow);
  if (narrow < 0 || wholeBegin >= wholeEnd) {
    addCut(first, last + 1);
    return sum;
  }
  addCut(first, wholeBegin);
  addCut(wholeEnd, last + 1);
  const LightVector* prefix = m_prefix.data() + static_cast<std::size_t>(row) * (m_columnCount + 1);
  const auto until = [&](int column) {
    const int around = column < 0 ? -1 : column > m_columnCount ? 1 : 0;
    const LightVector &part = prefix[column - around * m_columnCount], &all = prefix[m_columnCount];
    const float times = static_cast<float>(around);
    return LightVector{part.x + times * all.x, part.y + times * all.y, part.z + times * all.z};
  };
  const LightVector from = until(wholeBegin), to = until(wholeEnd);
  return sum + n.x * (to.x - from.x) + n.y * (to.y - from.y) + n.z * (to.z - from.z);
}

glm::dvec3 IrradianceSums::irradiance(const glm::dvec3& normal) const {
  const double horizontal = std::hypot(normal.x, normal.z);
  const Surface n{.x = static_cast<float>(normal.x),
                  .y = static_cast<float>(normal.y),
                  .z = static_cast<float>(normal.z),
                  .place = std::min(std::atan2(normal.z, normal.x) / (2 * pi) + 0.5, 1.0) * m_period,
                  .slope = -normal.y / std::max(horizontal, 1e-30)};
  glm::dvec3 sum(0.0);
  double atTop = halfArc(n.slope * m_cotangents[0]);
  for (int row = 0; row < static_cast<int>(m_rows.size()); ++row) {
    const double atBottom = halfArc(n.slope * m_cotangents[static_cast<std::size_t>(row) + 1]);
    const double narrow = std::min(atTop, atBottom), wide = std::max(atTop, atBottom);
    atTop = atBottom;
    if (!(wide > 0)) continue;
    Float4 light;
    if (narrow == 0.5) {
      const LightVector& all = m_prefix[static_cast<std::size_t>(row) * (m_columnCount + 1) + m_columnCount];
      light = n.x * all.x + n.y * all.y + n.z * all.z;
    } else {
      light = sumOfRow(n, row, (narrow - kArcError) * m_period, std::min(0.5, wide + kArcError) * m_period);
    }
    sum += glm::dvec3(light[0], light[1], light[2]);
  }
  sum *= m_total;
  for (const BrightCell& cell : m_bright) sum += cell.irradiance(normal);
  return glm::max(sum, glm::dvec3(0.0));
}

} // namespace parity::reference

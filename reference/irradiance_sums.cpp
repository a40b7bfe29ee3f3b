#include "reference/irradiance_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace parity::reference {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBlocksInRow = 1024; // of prefix sums: 36 bytes each
constexpr double kShareThatMatters = 1e-4;
constexpr int kBandsWhereItMatters = 16;

// The integral of sqrt(1 - y^2) dy from 0.
double radiusUntil(double y) { return 0.5 * (y * std::sqrt(std::max(0.0, 1 - y * y)) + std::asin(y)); }

} // namespace

IrradianceSums::IrradianceSums(int width, int height, std::span<const glm::vec4> cells, std::span<const double> rowY)
    : m_width(width), m_height(height), m_stride(std::max(1, width / kBlocksInRow)),
      m_blocks((width + m_stride - 1) / m_stride) {
  for (int x = 0; x <= width; ++x) {
    const double azimuth = (static_cast<double>(x) / width - 0.5) * 2 * kPi;
    m_rims.emplace_back(std::cos(azimuth), std::sin(azimuth));
  }
  for (int row = 0; row < height; ++row) {
    m_firstBand.push_back(m_bands.size());
    const double top = rowY[row], bottom = rowY[row + 1], area = (top - bottom) * 2 * kPi / width;
    const auto inRow = cells.subspan(static_cast<std::size_t>(row) * width, static_cast<std::size_t>(width));
    const float peak = std::ranges::max(inRow, {}, &glm::vec4::w).w;
    const int bands = static_cast<double>(peak) * area > kShareThatMatters ? kBandsWhereItMatters : 1;
    for (int b = 0; b < bands; ++b) {
      const double from = glm::mix(top, bottom, static_cast<double>(b) / bands);
      const double to = glm::mix(top, bottom, (b + 1.0) / bands);
      m_bands.push_back({0.5 * (from * from - to * to), radiusUntil(from) - radiusUntil(to)});
    }
  }
  m_firstBand.push_back(m_bands.size());

  const int rows = (height + kTile - 1) / kTile * kTile;
  m_cells.resize(static_cast<std::size_t>(rows) * width);
  m_prefix.resize(static_cast<std::size_t>(rows) * (m_blocks + 1));
  base::parallelFor(static_cast<std::size_t>(height), kTile, [&](std::size_t begin, std::size_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      glm::dvec3 constant(0.0), cosine(0.0), sine(0.0);
      for (int x = 0; x < width; ++x) {
        if (x % m_stride == 0) m_prefix[tiled(m_blocks + 1, x / m_stride, row)] = {constant, cosine, sine};
        const glm::dvec3 radiance(cells[static_cast<std::size_t>(row) * width + x]);
        m_cells[tiled(width, x, row)] = radiance;
        constant += radiance * (2 * kPi / width);
        cosine += radiance * (m_rims[x + 1].y - m_rims[x].y);
        sine += radiance * (m_rims[x].x - m_rims[x + 1].x);
      }
      m_prefix[tiled(m_blocks + 1, m_blocks, row)] = {constant, cosine, sine};
    }
  });
}

inline glm::dvec3 IrradianceSums::apply(const Weight& weight, const Sums& sums) {
  return glm::dvec3(static_cast<float>(weight.constant) * sums.constant +
                    static_cast<float>(weight.cosine) * sums.cosine + static_cast<float>(weight.sine) * sums.sine);
}

inline glm::dvec3 IrradianceSums::sumUntil(int row, const Azimuth& end, const Weight& weight) const {
  const int cell = std::clamp(static_cast<int>(end.place), 0, m_width - 1),
            block = m_stride == 1 ? cell : cell / m_stride;
  glm::dvec3 sum = apply(weight, m_prefix[tiled(m_blocks + 1, block, row)]);
  const auto radiance = [&](int x) { return glm::dvec3(m_cells[tiled(m_width, x, row)]); };
  const double whole = weight.constant * (2 * kPi / m_width);
  for (int x = block * m_stride; x < cell; ++x)
    sum += radiance(x) *
           (whole + weight.cosine * (m_rims[x + 1].y - m_rims[x].y) + weight.sine * (m_rims[x].x - m_rims[x + 1].x));
  return sum + radiance(cell) * (whole * (end.place - cell) + weight.cosine * (end.sine - m_rims[cell].y) +
                                 weight.sine * (m_rims[cell].x - end.cosine));
}

glm::dvec3 IrradianceSums::irradiance(const glm::dvec3& normal) const {
  const double slope = std::hypot(normal.x, normal.z);
  const double cosine = slope > 0 ? normal.x / slope : 1, sine = slope > 0 ? normal.z / slope : 0;
  const double azimuth = std::atan2(sine, cosine) / (2 * kPi) + 0.5;
  glm::dvec3 sum(0.0);
  for (int row = 0; row < m_height; ++row) {
    const Sums& all = m_prefix[tiled(m_blocks + 1, m_blocks, row)];
    for (std::size_t b = m_firstBand[row]; b < m_firstBand[row + std::size_t{1}]; ++b) {
      // N.w = n_y y + slope sqrt(1 - y^2) cos(a - azimuth), integrated over the band.
      const double constant = normal.y * m_bands[b].y, swing = slope * m_bands[b].radius;
      if (constant <= -swing) continue;
      const Weight weight{constant, swing * cosine, swing * sine};
      if (constant >= swing) {
        sum += apply(weight, all);
        continue;
      }
      const double cosHalf = -constant / swing, sinHalf = std::sqrt(1 - cosHalf * cosHalf);
      const double half = std::acos(cosHalf) / (2 * kPi);
      double from = azimuth - half, to = azimuth + half;
      if (from < 0 || to > 1) { // around the rim
        sum += apply(weight, all);
        (from < 0 ? from : to) += from < 0 ? 1 : -1;
      }
      sum +=
          sumUntil(row, {to * m_width, cosine * cosHalf - sine * sinHalf, sine * cosHalf + cosine * sinHalf}, weight);
      sum -=
          sumUntil(row, {from * m_width, cosine * cosHalf + sine * sinHalf, sine * cosHalf - cosine * sinHalf}, weight);
    }
  }
  return glm::max(sum, glm::dvec3(0.0));
}

} // namespace parity::reference

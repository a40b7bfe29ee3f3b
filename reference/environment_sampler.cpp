#include "reference/environment_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "scenes/luminance.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

using std::numbers::pi;
constexpr int kMinWidth = 1024, kMinHeight = 512;

using scenes::luminanceOf;

glm::dvec3 texel(const base::Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return {p[0], p[1], p[2]};
}

// Bilinear, wrapped around horizontally and clamped at the poles. x, y in texels, the middle of the first at 0.5.
glm::vec3 interpolate(const base::Image& image, double x, double y) {
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), fx = x - 0.5 - left, fy = y - 0.5 - top;
  const int x0 = (static_cast<int>(left) + image.width) % image.width, x1 = (x0 + 1) % image.width;
  const int y0 = std::clamp(static_cast<int>(top), 0, image.height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, image.height - 1);
  return glm::mix(glm::mix(texel(image, x0, y0), texel(image, x1, y0), fx),
                  glm::mix(texel(image, x0, y1), texel(image, x1, y1), fx), fy);
}

void check(const scenes::Environment& environment) {
  const base::Image& image = environment.radiance;
  const auto fail = [&](const std::string& reason) {
    throw base::fileError("environment " + environment.name, "", reason);
  };
  if (image.empty() || image.channels != 3) fail("is not an image of 3 channels");
  for (const float value : image.pixels)
    if (!(value >= 0 && std::isfinite(value))) fail("holds a radiance that is negative or not finite");
  if (!std::isfinite(environment.rotationDeg)) fail("has a rotation that is not finite");
}

// The interval [cdf[i], cdf[i + 1]) that u in (0, 1) falls in, and where in it, [0, 1]. cdf: ascending from 0 to 1.
// Intervals without width are never taken.
struct Interval {
  int index;
  double place;
};
double placeIn(const double* cdf, int i, double u) {
  return std::clamp((u - cdf[i]) / (cdf[i + 1] - cdf[i]), 0.0, 1.0);
}
Interval invert(const double* cdf, int count, double u) {
  const double* above = std::upper_bound(cdf, cdf + count + 1, u);
  const int i = std::clamp(static_cast<int>(above - cdf) - 1, 0, count - 1);
  return {i, placeIn(cdf, i, u)};
}

// Turns the masses in cdf[1 .. count] into a distribution; returns their sum. All 0: left as zeros.
double accumulate(double* cdf, int count) {
  for (int i = 1; i <= count; ++i) cdf[i] += cdf[i - 1];
  const double sum = cdf[count];
  if (sum > 0)
    for (int i = 1; i <= count; ++i) cdf[i] = cdf[i] >= sum ? 1 : cdf[i] / sum;
  return sum;
}

} // namespace

EnvironmentSampler::EnvironmentSampler(const scenes::Environment& environment, Tables tables) {
  check(environment);
  const base::Image& image = environment.radiance;
  const int growX = (kMinWidth + image.width - 1) / image.width;
  const int growY = (kMinHeight + image.height - 1) / image.height;
  m_width = image.width * growX;
  m_height = image.height * growY;
  m_rotation = environment.rotationDeg * pi / 180;
  m_turn = {std::cos(m_rotation), std::sin(m_rotation)};
  m_cells.resize(static_cast<std::size_t>(m_width) * m_height);
  m_rowY.resize(m_height + std::size_t{1});
  for (int y = 0; y <= m_height; ++y) m_rowY[y] = std::cos(pi * y / m_height);
  m_rowCdf.assign(m_height + std::size_t{1}, 0);
  m_columnCdf.assign((m_width + std::size_t{1}) * m_height, 0);
  m_columnGuide.resize(m_cells.size());
  base::parallelFor(static_cast<std::size_t>(m_height), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      double* cdf = m_columnCdf.data() + y * (m_width + std::size_t{1});
      for (int x = 0; x < m_width; ++x) {
        const glm::vec3 cell = growX == 1 && growY == 1
                                   ? glm::vec3(texel(image, x, static_cast<int>(y)))
                                   : interpolate(image, (x + 0.5) / growX, (static_cast<double>(y) + 0.5) / growY);
        cdf[x + 1] = luminanceOf(cell);
        m_cells[y * m_width + x] = glm::vec4(cell, 0);
      }
      const double cellArea = (m_rowY[y] - m_rowY[y + 1]) * 2 * pi / m_width;
      m_rowCdf[y + 1] = accumulate(cdf, m_width) * cellArea;
      std::uint32_t column = 0;
      for (int i = 0; i < m_width; ++i) {
        while (column + 1 < static_cast<std::uint32_t>(m_width) && cdf[column + 1] * m_width <= i) ++column;
        m_columnGuide[y * m_width + i] = column;
      }
    }
  });
  m_total = accumulate(m_rowCdf.data(), m_height);
  if (isBlack()) return;
  for (glm::vec4& cell : m_cells) cell.w = static_cast<float>(luminanceOf(glm::vec3(cell)) / m_total);
  double square = 0; // the integral of the density squared; 1 / (4 pi) where it is the same everywhere
  for (int y = 0; y < m_height; ++y)
    for (int x = 0; x < m_width; ++x)
      square += static_cast<double>(cell(x, y).w) * cell(x, y).w * (m_rowY[y] - m_rowY[y + std::size_t{1}]) * 2 * pi /
                m_width;
  m_isEven = square * 4 * pi < 1.02;
  if (tables == Tables::forSamples) return;
  m_light.emplace(m_width, m_height, m_cells, m_rowY);
  m_irradiance.emplace(m_width, m_height, m_cells, m_rowY);
}

EnvironmentSample EnvironmentSampler::atCell(int x, int y) const {
  const glm::vec4& values = cell(x, y);
  return {.radiance = glm::vec3(values), .pdf = values.w};
}

glm::dvec2 EnvironmentSampler::placeOf(const glm::dvec3& direction) const {
  constexpr double kMost = 1 - 0x1p-20; // of a cell
  const double turns = std::atan2(direction.z, direction.x) / (2 * pi) + 0.5;
  const double theta = std::acos(std::clamp(direction.y, -1.0, 1.0));
  const int y = std::min(static_cast<int>(theta / pi * m_height), m_height - 1);
  const double below = (m_rowY[y] - direction.y) / (m_rowY[y] - m_rowY[y + std::size_t{1}]);
  return {std::min(turns * m_width, m_width - 1 + kMost), y + std::clamp(below, 0.0, kMost)};
}

EnvironmentSample EnvironmentSampler::evaluate(const glm::dvec3& direction) const {
  const double turns = (std::atan2(direction.z, direction.x) + m_rotation) / (2 * pi) + 0.5;
  const int x = std::min(static_cast<int>((turns - std::floor(turns)) * m_width), m_width - 1);
  const double theta = std::acos(std::clamp(direction.y, -1.0, 1.0));
  const int y = std::min(static_cast<int>(theta / pi * m_height), m_height - 1);
  EnvironmentSample s = atCell(x, y);
  s.direction = direction;
  return s;
}

EnvironmentSample EnvironmentSampler::sample(const glm::dvec2& u) const {
  const Interval row = invert(m_rowCdf.data(), m_height, u.y);
  const double* cdf = m_columnCdf.data() + static_cast<std::size_t>(row.index) * (m_width + std::size_t{1});
  const std::size_t guide = static_cast<std::size_t>(row.index) * m_width + static_cast<std::size_t>(u.x * m_width);
  int first = static_cast<int>(m_columnGuide[guide]);
  while (first + 1 < m_width && cdf[first + 1] <= u.x) ++first;
  const Interval column{first, placeIn(cdf, first, u.x)};
  EnvironmentSample s = atCell(column.index, row.index);
  const double azimuth = ((column.index + column.place) / m_width - 0.5) * 2 * pi - m_rotation;
  const double y = m_rowY[row.index] + (m_rowY[row.index + 1] - m_rowY[row.index]) * row.place;
  const double r = std::sqrt(std::max(0.0, 1 - y * y));
  s.direction = {r * std::cos(azimuth), y, r * std::sin(azimuth)};
  return s;
}

} // namespace parity::reference

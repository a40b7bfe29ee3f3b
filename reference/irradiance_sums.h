// What a panorama sends onto a surface that nothing shades, exactly.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace parity::reference {

// E(N), the integral of L(w) max(N.w, 0) over directions w, of a panorama whose cells have constant radiance L. What of
// a row lies above the surface's horizon is one interval of azimuth a, over which the integrals of L, L cos(a) and
// L sin(a) are differences of prefix sums; its height comes in by the integrals of y dy and sqrt(1 - y^2) dy in closed
// form. One thing is not exact: the horizon has one azimuth all along a row's height, or along a 16th of it in rows
// with a cell that holds more than 1e-4 of all light. Within 1e-5 of what a surface receives that faces the light
// (tests/reference).
class IrradianceSums {
public:
  // cells: radiance, and in w the share of all light per steradian, row by row, the top first. rowY: bounds of the rows
  // as heights on the unit sphere, 1 .. -1 (height + 1).
  IrradianceSums(int width, int height, std::span<const glm::vec4> cells, std::span<const double> rowY);

  // normal: unit, in the panorama's own frame: y up, azimuth atan2(z, x) from -pi at the left rim.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;

private:
  // Of the cells to the left of some azimuth: summed in double, kept in float, 6e-8 of the row.
  struct Sums {
    glm::vec3 constant{0.f}, cosine{0.f}, sine{0.f};
  };
  // A row or a part of its height: the integrals of y dy and sqrt(1 - y^2) dy.
  struct Band {
    double y, radius;
  };
  // Where an azimuth lies: cells from the left rim, and its cosine and sine.
  struct Azimuth {
    double place, cosine, sine;
  };
  // constant + cosine cos(a) + sine sin(a): what light from azimuth a counts.
  struct Weight {
    double constant, cosine, sine;
  };
  static glm::dvec3 apply(const Weight& weight, const Sums& sums);
  glm::dvec3 sumUntil(int row, const Azimuth& end, const Weight& weight) const;

  int m_width, m_height, m_stride, m_blocks;
  std::vector<Band> m_bands;
  std::vector<std::size_t> m_firstBand; // of each row, and the end
  std::vector<glm::dvec2> m_rims;       // cosine and sine of the azimuths between cells, m_width + 1
  // The horizon passes through neighbouring rows at neighbouring azimuths: bands of kTile rows, column by column.
  static constexpr int kTile = 16;
  static std::size_t tiled(int columns, int x, int row) {
    return (static_cast<std::size_t>(row / kTile) * columns + x) * kTile + row % kTile;
  }
  std::vector<glm::vec3> m_cells; // m_width columns
  std::vector<Sums> m_prefix;     // m_blocks + 1 columns: before cell block * m_stride; the last: of all cells
};

} // namespace parity::reference

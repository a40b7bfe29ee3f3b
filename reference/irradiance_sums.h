// What a panorama sends onto a surface that nothing shades, summed anew for every surface.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/float4.h"
#include "reference/bright_cells.h"

namespace parity::reference {

// E(N), the integral of L(w) max(N.w, 0) over directions w, of a panorama whose cells have constant radiance L. The
// panorama is divided into patches of at most 1.4 degrees of azimuth and of height. One that stands above the surface's
// horizon gives N . integral L(w) w dw, exactly and whatever is in it (light vectors: Gershun 1936, "The Light Field");
// of a row of patches those are one interval, the difference of two prefix sums. One that the horizon cuts counts as
// spread evenly over as wide a range of heights above it as the patch covers; where its light is uneven, each of
// its 4 x 4 parts does. A cell that holds more than 1e-3 of all light is integrated alone, exactly but for the
// horizon's azimuth, which is one along a 16th of its height. Within 1e-5 of what a surface receives that faces the
// light (tests/reference).
class IrradianceSums {
public:
  // cells: radiance row by row, the top first, w not read. rowY: bounds of the rows as heights on the unit sphere,
  // 1 .. -1 (height + 1). At least 1024 x 512.
  IrradianceSums(int width, int height, std::span<const glm::vec4> cells, std::span<const double> rowY);

  // normal: unit, in the panorama's own frame: y up, azimuth atan2(z, x) from -pi at the left rim.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;

private:
  using Float4 = lighting::Float4;
  // The integrals of radiance and of radiance times direction, as shares of m_total; RGB in three lanes.
  struct LightVector {
    Float4 x{}, y{}, z{};
  };
  struct Patch {
    Float4 light{};     // the fourth lane: 1 where the light is uneven, else 0
    LightVector vector; // summed in double, kept in float
  };
  // Of a row of patches or of parts: its middle's cosine and sine of the polar angle, half its height in radians, and
  // the integrals of y dy, sqrt(1 - y^2) dy and dy.
  struct Row {
    float cosine, sine, halfHeight, y, radius, height;
  };
  // Of a column of patches: its middle's cosine and sine of the azimuth, half its width in radians.
  struct Column {
    float cosine, sine, halfWidth;
  };
  // Of the four columns of parts in a patch; the chord is 2 sin(halfWidth).
  struct Columns {
    Float4 cosine{}, sine{}, halfWidth{}, chord{};
  };
  struct Surface;

  void makeColumns(int width);
  void makeRows(std::span<const double> rowY);
  std::array<glm::dvec3, 3> makePatch(int width, std::span<const glm::vec4> cells, std::span<const double> rowY,
                                      std::span<const glm::dvec2> rims, int row, int column);
  void addPatch(Float4& sum, const Surface& surface, int row, int column) const;
  void addParts(Float4& sum, const Surface& surface, int row, int column) const;
  Float4 sumOfRow(const Surface& surface, int row, double narrow, double wide) const;

  int m_across, m_down; // cells in a part
  int m_columnCount;
  double m_period;                  // columns of patches all around: the last may be narrower
  glm::dvec3 m_total;               // of all light, each channel
  std::vector<BrightCell> m_bright; // in none of the sums below
  std::vector<double> m_cotangents; // of the polar angles between the rows of patches, and at both ends
  std::vector<Row> m_rows, m_partRows;
  std::vector<Column> m_columns;
  std::vector<Columns> m_partColumns;
  std::vector<Patch> m_patches;
  std::vector<LightVector> m_prefix;           // m_columnCount + 1 a row: of the patches to the left
  std::vector<std::array<Float4, 16>> m_parts; // mean radiance of each patch's parts over m_total, row by row
};

} // namespace parity::reference

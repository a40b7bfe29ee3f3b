// How much light lies in which part of a panorama, from its cells up to the whole.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace parity::reference {

// A part of the panorama: 2^level x 2^level cells, fewer at the right and lower rims; at levels below 0 a part of a
// cell, divided evenly in azimuth and in the height on the unit sphere.
struct PanoramaBlock {
  int level = 0, x = 0, y = 0;
};

// How a block's light is divided: the share of the upper half, and the left half's share of the upper and the lower.
struct LightShares {
  float upper = 0, leftOfUpper = 0, leftOfLower = 0;
};
// Of the light of four quarters: upper left, upper right, lower left, lower right. Halves without light have a share of
// 0 or, the other one having none, 1.
LightShares sharesOf(double upperLeft, double upperRight, double lowerLeft, double lowerRight);

// The integrals of a block's radiance, and of its radiance times each coordinate of the direction.
struct LightMoments {
  glm::vec3 light{0.f}, x{0.f}, y{0.f}, z{0.f};
};

// A block's middle in azimuth and polar angle, the unit tangents there along its row (to the right) and its column
// (down), and its half extents along them, in radians. No direction of the block is farther from its middle than
// radius.
struct BlockFrame {
  glm::dvec3 middle, along, down;
  double halfWidth, halfHeight, radius;
};

// A panorama's cells and the sums over squares of 2 x 2, 4 x 4 .. of them, up to one block that holds all. Directions
// are the panorama's own: y up, azimuth atan2(z, x) from -pi at the left rim.
class LightPyramid {
public:
  // cells: radiance, and in w the density of its light per steradian, row by row, the top first. rowY: bounds of the
  // rows as heights on the unit sphere, 1 .. -1 (height + 1).
  LightPyramid(int width, int height, std::span<const glm::vec4> cells, std::span<const double> rowY);

  int width() const { return m_levels.front().width; }
  int height() const { return m_levels.front().height; }
  PanoramaBlock whole() const { return {static_cast<int>(m_levels.size()) - 1, 0, 0}; }

  // Density times solid angle; 0 beyond the rims.
  double power(const PanoramaBlock& block) const {
    if (block.level < 0) return std::ldexp(power(cellOf(block)), 2 * block.level);
    const Level& level = m_levels[static_cast<std::size_t>(block.level)];
    return block.x < level.width && block.y < level.height
               ? level.power[static_cast<std::size_t>(block.y) * level.width + block.x]
               : 0;
  }
  // Of a block's quarters, the blocks of the level below; level > 0, within the rims.
  const LightShares& shares(const PanoramaBlock& block) const {
    const Level& level = m_levels[static_cast<std::size_t>(block.level)];
    return level.shares[static_cast<std::size_t>(block.y) * level.width + block.x];
  }
  // Within the rims. radiance: of the cell that a block of level 0 or less is in; of others it is not read.
  LightMoments moments(const PanoramaBlock& block, const glm::vec3& radiance) const;
  BlockFrame frame(const PanoramaBlock& block) const {
    if (block.level < 0) return frameOfPart(block);
    const Level& level = m_levels[static_cast<std::size_t>(block.level)];
    const auto x = static_cast<std::size_t>(block.x), y = static_cast<std::size_t>(block.y);
    return makeFrame(level.polar[y], level.azimuth[x], level.halfWidth[x], level.halfHeight[y], level.radius[y]);
  }
  // The direction at u in [0, 1]^2 of a block of level 0 or less, even in solid angle.
  glm::dvec3 directionIn(const PanoramaBlock& block, const glm::dvec2& u) const;
  // The cell of a block of level 0 or less.
  static PanoramaBlock cellOf(const PanoramaBlock& block) {
    return {0, block.x >> -block.level, block.y >> -block.level};
  }

private:
  // Left and right in azimuth, top and bottom in height on the unit sphere; level 0 or less.
  struct Bounds {
    double left, right, top, bottom;
  };
  // polar, azimuth: cosine and sine of the middle.
  static BlockFrame makeFrame(const glm::dvec2& polar, const glm::dvec2& azimuth, double halfWidth, double halfHeight,
                              double radius) {
    return {.middle = {polar.y * azimuth.x, polar.x, polar.y * azimuth.y},
            .along = {-azimuth.y, 0, azimuth.x},
            .down = {polar.x * azimuth.x, -polar.y, polar.x * azimuth.y},
            .halfWidth = polar.y * halfWidth,
            .halfHeight = halfHeight,
            .radius = radius};
  }
  BlockFrame frameOfPart(const PanoramaBlock& block) const;
  Bounds boundsOf(const PanoramaBlock& block) const;
  LightMoments momentsOf(const Bounds& bounds, const glm::vec3& radiance) const;

  struct Level {
    int width = 0, height = 0;
    std::vector<double> power;                 // row by row
    std::vector<LightShares> shares;           // the same; none at level 0
    std::vector<LightMoments> moments;         // the same
    std::vector<glm::dvec2> polar, azimuth;    // cosine and sine of the middle of each row and column
    std::vector<double> halfHeight, halfWidth; // of each row; of each column in azimuth
    std::vector<double> radius;                // of each row
  };
  std::vector<Level> m_levels;
  std::vector<double> m_rowY;
};

} // namespace parity::reference

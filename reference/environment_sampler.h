// An unfiltered panorama to be read and importance-sampled.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "reference/irradiance_sums.h"
#include "reference/light_pyramid.h"
#include "scenes/scene.h"

namespace parity::reference {

// A direction with the radiance there and the density, per steradian, with which sample() comes by it. All three travel
// together.
struct EnvironmentSample {
  glm::dvec3 direction{0.0}; // world, unit
  glm::dvec3 radiance{0.0};
  double pdf = 0;
};

// The panorama's texels are cells of constant radiance, as lighting/ reads them; one coarser than 1024 x 512 is
// interpolated bilinearly to cells that are not. Sampling takes cells in proportion to luminance times exact solid
// angle, by the distribution of rows and of columns in a row, and is uniform in solid angle within one: the density is
// luminance over its integral, so no direction that gives light is left out.
class EnvironmentSampler {
public:
  // Throws base::Error (exit 4) where the radiance is empty, has not 3 channels, or holds a value that is negative or
  // not finite.
  // Tables::forSamples leaves out what irradiance() and light() read.
  enum class Tables { all, forSamples };
  explicit EnvironmentSampler(const scenes::Environment& environment, Tables tables = Tables::all);

  // No light comes from anywhere: sample() must not be called.
  bool isBlack() const { return !(m_total > 0); }

  // The radiance that comes from a direction (world, unit) and the density of sampling it.
  EnvironmentSample evaluate(const glm::dvec3& direction) const;
  // u in (0, 1)^2.
  EnvironmentSample sample(const glm::dvec2& u) const;

  // The integral of radiance times cosine over the hemisphere about a normal (world, unit). Not where isBlack().
  glm::dvec3 irradiance(const glm::dvec3& normal) const { return m_irradiance->irradiance(toPanorama(normal)); }

  // Between the world and the panorama's own frame, which its rotation turns about +Y.
  glm::dvec3 toPanorama(const glm::dvec3& v) const {
    return {v.x * m_turn.x - v.z * m_turn.y, v.y, v.x * m_turn.y + v.z * m_turn.x};
  }
  glm::dvec3 toWorld(const glm::dvec3& v) const {
    return {v.x * m_turn.x + v.z * m_turn.y, v.y, v.z * m_turn.x - v.x * m_turn.y};
  }
  // Where a direction (unit, of the panorama's frame) lies: its cell and, behind the point, how far it is to the right
  // in azimuth and down in height. Below width and height.
  glm::dvec2 placeOf(const glm::dvec3& direction) const;
  // Radiance in xyz, in w the density of sample().
  const glm::vec4& cell(int x, int y) const { return m_cells[static_cast<std::size_t>(y) * m_width + x]; }
  // The luminance hardly differs between directions: its variance is at most 0.02 of its mean squared.
  bool isEven() const { return m_isEven; }
  // The integral of luminance over the sphere.
  double totalLuminance() const { return m_total; }
  // Of light by that density. Not where isBlack().
  const LightPyramid& light() const { return *m_light; }

private:
  EnvironmentSample atCell(int x, int y) const;

  int m_width = 0, m_height = 0;
  double m_rotation = 0;       // radians: azimuth in the panorama less that in the world
  glm::dvec2 m_turn{1.0, 0.0}; // its cosine and sine
  bool m_isEven = false;
  double m_total = 0;                       // the integral of luminance over the sphere
  std::vector<glm::vec4> m_cells;           // radiance and density, row by row, the top first
  std::vector<double> m_rowY;               // bounds of the rows, cos(theta): 1 .. -1
  std::vector<double> m_rowCdf;             // 0 .. 1, m_height + 1
  std::vector<double> m_columnCdf;          // 0 .. 1, m_width + 1 a row
  std::vector<std::uint32_t> m_columnGuide; // m_width a row: where the search for u in [i, i + 1) / m_width begins
  std::optional<LightPyramid> m_light;
  std::optional<IrradianceSums> m_irradiance;
};

} // namespace parity::reference

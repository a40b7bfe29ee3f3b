// The prefiltered environment as shaders read it, and what it should be: a sum over every cell of the panorama. For
// tests and bench/prefilter_error.cpp.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "base/parallel.h"
#include "lighting/cube.h"
#include "lighting/cube_sampler.h"
#include "lighting/environment_light.h"
#include "scenes/procedural_environment.h"
#include "shading/shading.h"

namespace parity::tests {

inline std::vector<glm::dvec3> makeDirections(int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions(count);
  for (glm::dvec3& d : directions) d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  return directions;
}

// [direction][roughness]: sum L D NoL w / sum D NoL w over the cells, w their solid angles, N = V = direction. An
// environment without rotation.
inline std::vector<std::vector<glm::dvec3>> integrateLobes(const scenes::Environment& environment,
                                                           const std::vector<glm::dvec3>& directions,
                                                           const std::vector<double>& roughnesses) {
  struct Cell {
    glm::dvec3 direction, energy;
    double solidAngle;
  };
  const base::Image& image = environment.radiance;
  constexpr double kPi = std::numbers::pi;
  std::vector<Cell> cells;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double area =
          2 * kPi / image.width * (std::cos(kPi * y / image.height) - std::cos(kPi * (y + 1) / image.height));
      const float* p = image.at(x, y);
      cells.push_back({scenes::directionAt((x + 0.5) / image.width, (y + 0.5) / image.height),
                       area * glm::dvec3(p[0], p[1], p[2]), area});
    }
  std::vector<double> a2;
  for (const double roughness : roughnesses) a2.push_back(std::pow(roughness, 4));
  std::vector<std::vector<glm::dvec3>> filtered(directions.size());
  base::parallelFor(directions.size(), 1, [&](std::size_t k, std::size_t) {
    std::vector<glm::dvec3> sums(roughnesses.size());
    std::vector<double> weights(roughnesses.size());
    for (const Cell& cell : cells) {
      const double NoL = glm::dot(directions[k], cell.direction);
      if (NoL <= 0) continue;
      for (std::size_t r = 0; r < roughnesses.size(); ++r) {
        const double t = 0.5 * (1 + NoL) * (a2[r] - 1) + 1; // NoH^2 = (1 + NoL) / 2
        sums[r] += NoL / (t * t) * cell.energy;
        weights[r] += NoL / (t * t) * cell.solidAngle;
      }
    }
    for (std::size_t r = 0; r < roughnesses.size(); ++r) filtered[k].push_back(sums[r] / weights[r]);
  });
  return filtered;
}

class PrefilterReader {
public:
  explicit PrefilterReader(const lighting::CubeMap& cube) {
    for (int mip = 0; mip <= kRoughest; ++mip)
      for (int layer = 0; layer < kLayers; ++layer) {
        const int n = cube.faceSize >> mip;
        const std::size_t size = lighting::texelIndex(lighting::kCubeFaces, 0, 0, n);
        const auto first = cube.mips[mip].begin() + (layer < lighting::layersOfMip(mip) ? layer * size : 0);
        m_levels.push_back(lighting::makeCubeLevel({first, first + size}, n));
      }
  }

  // As the high-end path does it: gpu/shaders/path.glsl, skyRadianceBetweenLevels.
  glm::dvec3 read(const glm::dvec3& direction, double roughness) const {
    const shading::f64::PrefilterBlend blend = shading::f64::prefilterBlend(shading::f64::mipFromRoughness(roughness));
    return glm::mix(level(blend.lower, direction), level(blend.upper, direction), blend.upperShare);
  }

  // As the mobile path does it: skyRadiance.
  glm::dvec3 readTrilinear(const glm::dvec3& direction, double roughness) const {
    const double mip = shading::f64::mipFromRoughness(roughness);
    const int lower = std::min(static_cast<int>(mip), kRoughest - 1);
    return glm::mix(level(kLayers * lower, direction), level(kLayers * (lower + 1), direction), mip - lower);
  }

private:
  static constexpr int kLayers = shading::f64::kPrefilterLayers, kRoughest = shading::f64::kPrefilterRoughestMip;
  glm::dvec3 level(int index, const glm::dvec3& direction) const {
    return glm::dvec3(lighting::readLevel(m_levels[index], glm::vec3(direction)));
  }
  std::vector<lighting::CubeLevel> m_levels;
};

// For each roughness the root of the mean square of what read(direction, roughness) is off, over directions and
// channels, relative to the mean.
template <typename Read> std::vector<double> relativeRmse(const std::vector<std::vector<glm::dvec3>>& truth,
                                                          const std::vector<glm::dvec3>& directions,
                                                          const std::vector<double>& roughnesses, const Read& read) {
  std::vector<double> errors;
  for (std::size_t r = 0; r < roughnesses.size(); ++r) {
    double squares = 0, sum = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const glm::dvec3 difference = read(directions[k], roughnesses[r]) - truth[k][r];
      squares += glm::dot(difference, difference);
      sum += truth[k][r].x + truth[k][r].y + truth[k][r].z;
    }
    const double count = 3.0 * static_cast<double>(directions.size());
    errors.push_back(std::sqrt(squares / count) / (sum / count));
  }
  return errors;
}

} // namespace parity::tests

// The prefiltered environment as shaders read it, and what it should be: a sum over every cell of the panorama. For
// tests and bench/prefilter_error.cpp.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "base/parallel.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/cube_sampler.h"
#include "lighting/environment/environment_light.h"
#include "lighting/environment/panorama_cells.h"
#include "scenes/builtin/procedural_environment.h"
#include "shading/shading.h"
#include "support/read_level.h"

namespace parity::tests {

inline std::vector<glm::dvec3> makeDirections(int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions(count);
  for (glm::dvec3& d : directions) d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  return directions;
}

// [direction][roughness]: sum L D NoL w / sum D NoL w over the cells, w their solid angles, N = V = direction. Cells
// near the direction are summed in parts, as lobes may be narrower than they. An environment without rotation.
inline std::vector<std::vector<glm::dvec3>> integrateLobes(const scenes::Environment& environment,
                                                           const std::vector<glm::dvec3>& directions,
                                                           const std::vector<double>& roughnesses) {
  const base::Image& image = environment.radiance;
  constexpr double kPi = std::numbers::pi;
  const double cellWidth = kPi / image.height;
  std::vector<glm::dvec3> middles;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      middles.push_back(scenes::directionAt((x + 0.5) / image.width, (y + 0.5) / image.height));
  std::vector<double> a2;
  for (const double roughness : roughnesses) a2.push_back(std::pow(roughness, 4));
  std::vector<std::vector<glm::dvec3>> filtered(directions.size());
  base::parallelFor(directions.size(), 1, [&](std::size_t k, std::size_t) {
    std::vector<glm::dvec3> sums(roughnesses.size());
    std::vector<double> weights(roughnesses.size());
    const auto add = [&](const glm::dvec3& direction, const glm::dvec3& radiance, double solidAngle) {
      const glm::dvec3 between = direction - directions[k];
      const double u = glm::dot(between, between) / 4, NoL = 1 - 2 * u; // (1 - NoL) / 2 without its cancellation
      if (NoL <= 0) return;
      for (std::size_t r = 0; r < roughnesses.size(); ++r) {
        const double t = u + a2[r] * (1 - u), weight = NoL / (t * t) * a2[r] * solidAngle; // NoH^2 = 1 - u
        sums[r] += weight * radiance;
        weights[r] += weight;
      }
    };
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const glm::dvec3& middle = middles[static_cast<std::size_t>(y) * image.width + x];
        const double cosine = glm::dot(middle, directions[k]);
        if (cosine < -0.05) continue;
        const double angle = std::sqrt(std::max(0.0, 2 - 2 * cosine)) / cellWidth; // in cells
        const int parts = angle < 1.5 ? 32 : angle < 4 ? 8 : angle < 12 ? 3 : 1;
        const float* p = image.at(x, y);
        for (int j = 0; j < parts; ++j) {
          const double upper = (y + 1. * j / parts) / image.height, lower = (y + (j + 1.) / parts) / image.height;
          const double area = 2 * kPi / image.width / parts * (std::cos(kPi * upper) - std::cos(kPi * lower));
          for (int i = 0; i < parts; ++i)
            add(parts == 1 ? middle : scenes::directionAt((x + (i + 0.5) / parts) / image.width, (upper + lower) / 2),
                glm::dvec3(p[0], p[1], p[2]), area);
        }
      }
    for (std::size_t r = 0; r < roughnesses.size(); ++r) filtered[k].push_back(sums[r] / weights[r]);
  });
  return filtered;
}

class PrefilterReader {
public:
  // cells: where the cube has fine levels, for read; must outlive it.
  explicit PrefilterReader(const lighting::EnvironmentLight& light, const lighting::PanoramaCells* cells = nullptr)
      : m_lamps(light.lamps.compact), m_cells(cells) {
    const lighting::CubeMap& cube = light.prefiltered;
    for (int mip = 0; mip <= kRoughest; ++mip)
      for (int layer = 0; layer < kLayers; ++layer) {
        const int n = cube.faceSize >> mip;
        const std::size_t size = lighting::texelIndex(lighting::kCubeFaces, 0, 0, n);
        const auto first = cube.mips[mip].begin() + (layer < lighting::layersOf(cube, mip) ? layer * size : 0);
        m_levels.push_back(lighting::makeCubeLevel({first, first + size}, n));
      }
  }

  // As the high-end path does it: highend/shaders/reflection.glsl for N = V, with cells or without.
  glm::dvec3 read(const glm::dvec3& direction, double roughness) const {
    const double mip = shading::f64::unclampedMip(roughness);
    const shading::f64::PrefilterBlend blend =
        m_cells ? shading::f64::finePrefilterBlend(mip) : shading::f64::prefilterBlend(std::max(mip, 0.0));
    const glm::dvec3 radiance =
        glm::mix(level(blend.lower, direction), level(blend.upper, direction), blend.upperShare) +
        compactLamps(direction, std::max(mip, shading::f64::kSharpestPrefilteredMip));
    if (!m_cells || mip >= shading::f64::kSharpestPrefilteredMip) return radiance;
    const shading::f64::SharpLobe sharp = shading::f64::sharpLobe(mip);
    return glm::mix(glm::dvec3(lighting::readCells(*m_cells, direction, sharp.width)), radiance, sharp.tail);
  }

  // As the mobile path does it: skyRadiance.
  glm::dvec3 readTrilinear(const glm::dvec3& direction, double roughness) const {
    const double mip = shading::f64::mipFromRoughness(roughness);
    const int lower = std::min(static_cast<int>(mip), kRoughest - 1);
    return glm::mix(level(kLayers * lower, direction), level(kLayers * (lower + 1), direction), mip - lower);
  }

private:
  glm::dvec3 compactLamps(const glm::dvec3& direction, double mip) const {
    const double a2 = std::pow(shading::f64::roughnessFromMip(std::min(mip, double{kRoughest})), 4);
    const double integral = shading::f64::prefilteredLobeIntegral(a2);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < m_lamps.nodes.size(); ++i) {
      if (!m_lamps.isLeaf(i)) continue;
      const glm::dvec3 d = glm::dvec3(m_lamps.nodes[i].direction) - direction;
      sum += glm::dvec3(m_lamps.nodes[i].light) *
             shading::f64::prefilteredLobe(a2, integral, glm::dot(d, d) / 4, m_lamps.nodes[i].spread);
    }
    return sum;
  }

  static constexpr int kLayers = shading::f64::kPrefilterLayers, kRoughest = shading::f64::kPrefilterRoughestMip;
  glm::dvec3 level(int index, const glm::dvec3& direction) const {
    return glm::dvec3(tests::readLevel(m_levels[index], direction));
  }
  std::vector<lighting::CubeLevel> m_levels;
  lighting::LampTree m_lamps;
  const lighting::PanoramaCells* m_cells;
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

// Environments and points that the reference's tests share.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "reference/shade.h"

namespace parity::tests {

inline constexpr int kPanoramaWidth = 1024, kPanoramaHeight = 512; // not interpolated by the sampler

// Lambert and single scattering: what needs no table of albedos.
inline reference::Model plainModel(reference::GeometryTerm term = reference::GeometryTerm::heightCorrelated) {
  return {.surface = {.geometryTerm = term, .diffuse = shading::DiffuseLobe::lambert},
          .scattering = reference::Scattering::single};
}

// The middle of a panorama's cell, as a direction: u = atan2(z, x) / 2 pi + 0.5, v from +Y down.
inline glm::dvec3 cellDirection(double x, double y) {
  const double azimuth = ((x + 0.5) / kPanoramaWidth - 0.5) * 2 * std::numbers::pi;
  const double theta = (y + 0.5) / kPanoramaHeight * std::numbers::pi;
  return {std::sin(theta) * std::cos(azimuth), std::cos(theta), std::sin(theta) * std::sin(azimuth)};
}

inline scenes::Environment makePanorama(const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
  scenes::Environment environment;
  environment.name = "test";
  environment.radiance = base::Image(kPanoramaWidth, kPanoramaHeight, 3);
  for (int y = 0; y < kPanoramaHeight; ++y)
    for (int x = 0; x < kPanoramaWidth; ++x) {
      const glm::vec3 value = radiance(cellDirection(x, y));
      for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = value[c];
    }
  return environment;
}

inline scenes::Environment makeWhitePanorama() {
  return makePanorama([](const glm::dvec3&) { return glm::vec3(1); });
}

// A coloured sky with a source of 1.4 degrees across that gives most of the light.
inline scenes::Environment makeSunnyPanorama() {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.7, 0.5));
  return makePanorama([=](const glm::dvec3& d) {
    const glm::vec3 sky = glm::mix(glm::vec3(0.3f, 0.25f, 0.2f), glm::vec3(0.2f, 0.5f, 1.f), 0.5f + 0.5f * float(d.y));
    return glm::dot(d, sun) > std::cos(0.012) ? glm::vec3(9000, 8000, 6000) : sky;
  });
}

// N = +Y, V leaning to +X by the angle whose cosine is NoV.
inline reference::SurfaceSample makePoint(double NoV, float roughness, float metallic) {
  reference::SurfaceSample sample;
  sample.normal = {0, 1, 0};
  sample.view = glm::vec3(std::sqrt(1 - NoV * NoV), NoV, 0);
  sample.roughness = roughness;
  sample.metallic = metallic;
  return sample;
}

} // namespace parity::tests

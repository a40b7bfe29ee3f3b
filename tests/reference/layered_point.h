// Points with a coat and a sheen, and what they are shaded with: for the tests of layers.
#pragma once

#include <gtest/gtest.h>

#include "reference/layers.h"
#include "reference/shade.h"
#include "reference/surroundings.h"

namespace parity::reference {

using shading::Term;

inline glm::dvec3 layerTerm(const ShadedSample& sample, Term term) {
  return glm::dvec3(sample.terms[static_cast<std::size_t>(term)]);
}
inline glm::dvec3 sumOfTerms(const ShadedSample& sample) {
  glm::dvec3 color(0);
  for (const glm::vec3& term : sample.terms) color += glm::dvec3(term);
  return color;
}

inline scenes::Light sunFrom(const glm::vec3& towards) {
  scenes::Light light;
  light.kind = scenes::LightKind::directional;
  light.direction = -glm::normalize(towards);
  light.color = {3, 2, 1};
  return light;
}

class LayersTest : public testing::Test {
protected:
  static const DirectionalAlbedo& albedo() {
    static const DirectionalAlbedo table(Model{}.surface.geometryTerm, Model{}.surface.fresnel);
    return table;
  }
  static const SheenAlbedo& sheenAlbedo() {
    static const SheenAlbedo table;
    return table;
  }
  static const EnvironmentSampler& white() {
    static const EnvironmentSampler sampler(tests::makeWhitePanorama());
    return sampler;
  }
  static const EnvironmentSampler& sunny() {
    static const EnvironmentSampler sampler(tests::makeSunnyPanorama());
    return sampler;
  }
  static Inputs inputsOf(const EnvironmentSampler* environment, std::vector<scenes::Light> lights = {}) {
    return {
        .environment = environment, .albedo = &albedo(), .lights = std::move(lights), .sheenAlbedo = &sheenAlbedo()};
  }
  static ShadedSample shadeOne(const SurfaceSample& sample, const Inputs& inputs,
                               const IntegralOptions& integral = {}) {
    return shade({&sample, 1}, inputs, {.model = {}, .integral = integral}).front();
  }
  // Of all layers, with a coat whose normal is its own.
  static SurfaceSample layered() {
    SurfaceSample sample = tests::makePoint(0.6, 0.4f, 0.25f);
    sample.baseColor = {0.9f, 0.5f, 0.1f};
    sample.emissive = {0.5f, 0.25f, 1};
    sample.coat = 0.7f;
    sample.coatRoughness = 0.3f;
    sample.coatNormal = glm::normalize(glm::vec3(0.2f, 1, -0.1f));
    sample.sheenColor = {0.8f, 0.4f, 0.2f};
    sample.sheenRoughness = 0.5f;
    return sample;
  }
};

} // namespace parity::reference

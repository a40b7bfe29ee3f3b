// Points that light passes through, and the scenes about them.
#pragma once

#include <memory>

#include "reference/layered_point.h"
#include "support/matte_scenes.h"

namespace parity::reference {

// What rays need of a scene, which must outlive it.
class SeenThrough {
public:
  explicit SeenThrough(const scenes::Scene& scene)
      : m_visibility(scene), m_bodies(scene, lighting::Visibility::Contents::bodies), m_surfaces(scene),
        m_emitters(scene, m_surfaces) {}
  // Without shadows.
  void giveTo(Inputs& inputs) const {
    inputs.behind = &m_visibility;
    inputs.bodies = &m_bodies;
    inputs.surfaces = &m_surfaces;
    inputs.emitters = &m_emitters;
  }
  void giveShadowsTo(Inputs& inputs) const {
    giveTo(inputs);
    inputs.visibility = &m_visibility;
  }
  const lighting::Visibility& bodies() const { return m_bodies; }

private:
  lighting::Visibility m_visibility, m_bodies;
  lighting::SurfaceLight m_surfaces;
  lighting::Emitters m_emitters;
};

inline scenes::Material glass(float thickness = 1) {
  scenes::Material material = tests::matte("glass", 1);
  material.transmission = 1;
  material.thickness = thickness;
  return material;
}

class PassedThroughTest : public LayersTest {
protected:
  // N = +Y, all light that enters passes.
  static SurfaceSample pane(double NoV, float roughness) {
    SurfaceSample sample = tests::makePoint(NoV, roughness, 0);
    sample.geometricNormal = sample.normal;
    sample.coatNormal = sample.normal;
    sample.transmission = 1;
    return sample;
  }
  // Where a ray from the eye meets the front of a body.
  static SurfaceSample surfaceOf(const lighting::Visibility& bodies, const glm::dvec3& eye, const glm::dvec3& direction,
                                 float roughness) {
    SurfaceSample sample;
    const auto hit = bodies.firstHit(eye, direction);
    EXPECT_TRUE(hit.has_value());
    if (!hit) return sample;
    const lighting::SurfacePoint point = lighting::surfacePointAt(bodies.scene(), *hit, direction);
    sample.position = point.position;
    sample.normal = sample.coatNormal = point.smooth;
    sample.geometricNormal = point.geometric;
    sample.view = -direction;
    sample.instance = hit->instance;
    sample.roughness = roughness;
    sample.transmission = 1;
    sample.thickness = 1;
    return sample;
  }
  static glm::dvec3 through(const ShadedSample& shaded) { return layerTerm(shaded, Term::transmission); }
  static double schlick(double NoV) { return 0.04 + 0.96 * std::pow(1 - NoV, 5); }
};

} // namespace parity::reference

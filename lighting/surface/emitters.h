// The triangles that emit light, to be sampled.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/surface/surface_light.h"

namespace parity::lighting {

// A point on an emitting triangle.
struct EmitterSample {
  glm::dvec3 position{0.0}, normal{0.0}; // world; unit, of the side that its front faces
  Visibility::Hit hit;                   // as if a ray had met it from the front
  bool bothSides = false;                // it emits from its back, too
  double pdf = 0;                        // per square metre
};

class Emitters {
public:
  // `surfaces` is of the same scene; both must outlive it.
  Emitters(const scenes::Scene& scene, const SurfaceLight& surfaces);

  bool empty() const { return m_cdf.empty(); }
  // Triangles in proportion to area times mean luminance (of four points), points uniform in area. u in (0, 1)^2: what
  // is left of u.x within its triangle is used again, so that points that are spread well stay so.
  EmitterSample sample(const glm::dvec2& u) const;
  // The density, per square metre, with which sample() comes by this point.
  double pdf(const Visibility::Hit& hit) const;

private:
  struct Triangle {
    std::uint32_t instance = 0, triangle = 0;
  };
  const scenes::Scene& m_scene;
  const SurfaceLight& m_surfaces;
  std::vector<Triangle> m_triangles;
  std::vector<double> m_cdf;                       // cumulative share, to 1
  std::vector<std::vector<float>> m_pdfOfInstance; // of each triangle of each emitting instance, else empty
};

} // namespace parity::lighting

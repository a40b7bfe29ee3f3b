// What one point reflects of the light of a direction, in the frame of its shading normal.
#pragma once

#include <cmath>

#include "reference/direct_light.h"
#include "reference/lobes.h"
#include "reference/point_visibility.h"

namespace parity::reference {

// Axes of a right-handed frame around n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
struct Frame {
  glm::dvec3 x, y, z;
  explicit Frame(const glm::dvec3& n) : z(n) {
    const double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z), b = n.x * n.y * a;
    x = {1 + s * n.x * n.x * a, s * b, -s * n.x};
    y = {b, s + n.y * n.y * a, -n.y};
  }
  // The axis x along t, but for what of t is along n; t = 0, or along n: as above.
  Frame(const glm::dvec3& n, const glm::dvec3& t) : Frame(n) {
    const glm::dvec3 side = t - glm::dot(t, n) * n;
    const double length = glm::length(side);
    if (!(length > 1e-9)) return;
    x = side / length;
    y = glm::cross(n, x);
  }
  glm::dvec3 toLocal(const glm::dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  glm::dvec3 toWorld(const glm::dvec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

// The frame (world) that a point's lobes are of.
inline Frame frameOf(const SurfaceSample& sample, const Lobes& lobes) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(sample.normal));
  return lobes.isStretched() ? Frame(normal, glm::dvec3(sample.tangent)) : Frame(normal);
}

// A view (unit, local) that a normal turned away from the eye has; others as they are.
inline glm::dvec3 visibleView(const glm::dvec3& local) {
  if (local.z >= kMinNoV) return local;
  const double length = std::hypot(local.x, local.y), rest = std::sqrt(1 - kMinNoV * kMinNoV);
  return length > 0 ? glm::dvec3(local.x / length * rest, local.y / length * rest, kMinNoV)
                    : glm::dvec3(rest, 0, kMinNoV);
}

// The lobes of a point. Where there is a horizon (reference/point_visibility.h), a normal map tilts part of the
// hemisphere below it. The diffuse lobe gets no light from there. The part of the specular lobe that would go there is
// folded up: it leaves mirrored at the tangent plane, as if the surface beside the point had reflected it on,
//   f(L) cos = f_s(L) N.L + f_s(L') N.L',  L' = L - 2 (H.L) H,  L above the horizon of normal H,
// so that the lobe keeps its energy: a lone surface under an even sky is as bright as without shadows. Path tracers
// bend the shading normal up for the same reason (Keller et al. 2017, "The Iray Light Transport Simulation and
// Rendering System", appendix A.3; Cycles' ensure_valid_specular_reflection), which shades with another normal; that
// light reflected into the surface meets a mirror beside the point is Schuessler et al.'s ("Microfacet-based Normal
// Mapping for Robust Monte Carlo Path Tracing", 2017).
class Reflection {
public:
  // lobes: of the sample; it and fromHere must outlive this. A normal turned away from the eye has the lobe of the last
  // visible direction.
  Reflection(const SurfaceSample& sample, const Lobes& lobes, const PointVisibility& fromHere)
      : m_lobes(lobes), m_frame(frameOf(sample, lobes)),
        m_view(visibleView(m_frame.toLocal(glm::normalize(glm::dvec3(sample.view))))), m_atView(lobes.viewAt(m_view)),
        m_folds(fromHere.hasHorizon()), m_horizon(m_frame.toLocal(fromHere.horizonNormal())) {}

  const Frame& frame() const { return m_frame; }
  const glm::dvec3& view() const { return m_view; } // local

  // A direction of the specular lobe (local) as it leaves.
  glm::dvec3 foldUp(const glm::dvec3& local) const {
    return m_folds && glm::dot(m_horizon, local) < 0 ? mirror(local) : local;
  }
  // Whether light of this direction (local; above the horizon, if there is one) is reflected at all.
  bool mayReflect(const glm::dvec3& local) const { return local.z > 0 || (m_folds && mirror(local).z > 0); }

  // pdfSpecular: of a visible normal's mirror direction, folded up.
  LobeValues evaluate(const glm::dvec3& local) const {
    LobeValues values;
    if (local.z > 0) values = m_lobes.evaluate(m_view, local, m_atView);
    if (!m_folds) return values;
    if (const glm::dvec3 image = mirror(local); image.z > 0) {
      const LobeValues folded = m_lobes.evaluate(m_view, image, m_atView);
      values.specular += folded.specular;
      values.pdfSpecular += folded.pdfSpecular;
    }
    return values;
  }

  // Of even light, about: to choose between the lobes.
  glm::dvec3 diffuseAlbedo() const { return m_lobes.diffuseReflectance(m_atView); }

  // Where a perfect mirror looks (world), and how much it reflects of there.
  glm::dvec3 mirrorDirection() const { return m_frame.toWorld(foldUp({-m_view.x, -m_view.y, m_view.z})); }
  glm::dvec3 mirrorReflectance() const { return m_lobes.fresnel(m_view.z); }

private:
  glm::dvec3 mirror(const glm::dvec3& local) const { return local - 2 * glm::dot(m_horizon, local) * m_horizon; }

  const Lobes& m_lobes;
  Frame m_frame;
  glm::dvec3 m_view;
  LobeView m_atView;
  bool m_folds;
  glm::dvec3 m_horizon;
};

} // namespace parity::reference

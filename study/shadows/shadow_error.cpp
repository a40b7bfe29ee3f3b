#include "study/shadows/shadow_error.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/constants.hpp>

#include "base/parallel.h"
#include "gpu/shadows/shadow_views.h"
#include "gpu/surface/material_pass.h"
#include "gpu/surface/surface_pass.h"
#include "highend/renderer.h"
#include "lighting/surface/visibility.h"
#include "shading/terms.h"

namespace parity::shadows {

namespace {

// Radiance that the light gives, by all of its terms.
std::vector<double> lightOf(const gpu::ShadedSurface& shaded, std::size_t count) {
  std::vector<double> sum(count, 0);
  for (const shading::Term term : {shading::Term::sunDiffuse, shading::Term::sunSpecular, shading::Term::localDiffuse,
                                   shading::Term::localSpecular})
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec4& t = shaded.terms[static_cast<std::size_t>(term)][i];
      sum[i] += t.x + t.y + t.z;
    }
  return sum;
}

// Exact, from any point of a plane.
class Rays {
public:
  Rays(const scenes::Scene& scene, const scenes::Light& light) : m_visibility(scene), m_light(light) {}
  bool sees(const glm::dvec3& p, const glm::dvec3& n) const {
    glm::dvec3 L = -glm::dvec3(m_light.direction);
    double distance = std::numeric_limits<double>::infinity();
    if (m_light.kind != scenes::LightKind::directional) {
      L = glm::dvec3(m_light.position) - p;
      distance = glm::length(L);
      L /= distance;
    }
    return glm::dot(n, L) > 0 &&
           !m_visibility.isOccluded(m_visibility.leaveSurface(p, n), L, distance - 2 * m_visibility.surfaceOffset(p));
  }

private:
  lighting::Visibility m_visibility;
  const scenes::Light& m_light;
};

// Where the plane through p with normal n lies under the texel (x, y) beside p's own; none: not before its horizon.
std::optional<glm::dvec3> besides(const gpu::ShadowView& view, double texelsPerUnit, const glm::dvec3& p,
                                  const glm::dvec3& n, double x, double y) {
  const glm::dvec3 right(view.right), up(view.up), forward(view.forward), origin(view.origin);
  const glm::dvec3 step = (x * right + y * up) / texelsPerUnit;
  const double toForward = glm::dot(n, forward);
  if (view.orthographic) {
    if (toForward > -1e-6) return std::nullopt;
    return p + step - forward * (glm::dot(n, step) / toForward);
  }
  const glm::dvec3 d = p - origin;
  const glm::dvec3 direction = d / glm::dot(d, forward) + step;
  const double t = glm::dot(n, d) / glm::dot(n, direction);
  if (!(t > 0) || t > 1e6 * glm::length(d)) return std::nullopt;
  return origin + t * direction;
}

const std::vector<glm::dvec2>& diskOfTwoTexels() {
  static const std::vector<glm::dvec2> points = [] {
    std::vector<glm::dvec2> result;
    for (int ring = 1; ring <= 4; ++ring)
      for (int k = 0; k < 8 * ring; ++k) {
        const double a = glm::two_pi<double>() * k / (8 * ring);
        result.emplace_back(0.5 * ring * std::cos(a), 0.5 * ring * std::sin(a));
      }
    return result;
  }();
  return points;
}

std::size_t faceOf(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<std::size_t>(2 * axis + (d[axis] < 0 ? 1 : 0));
}

} // namespace

VisibilityError measureVisibility(const gpu::Device& device, const Setup& setup, const scenes::Light& light) {
  const gpu::SceneBuffers buffers(device, setup.scene);
  const gpu::SurfacePass pass(device, buffers, setup.width, setup.height);
  const gpu::Surface surface =
      std::move(pass.render(setup.camera, {0, setup.height}, glm::vec2(0.5f)).front()); // opaque
  const gpu::MaterialPass materials(device, buffers, pass.binKinds(), surface.size());
  const std::vector<gpu::ResolvedMaterial> points = materials.resolve(surface, setup.camera);
  std::vector<scenes::Light> mapped = setup.others;
  mapped.push_back(light);
  gpu::ShadowMaps maps(device, buffers, mapped, setup.options);
  const auto shade = [&](gpu::ShadowMaps* shadows) {
    highend::Inputs inputs;
    inputs.lights = {light};
    inputs.shadows = shadows;
    inputs.terms = true;
    inputs.hiddenFeatures = gpu::kFeatureLobes; // the base's light alone tells what a shadow keeps
    const highend::Options plain{.model = {.diffuse = shading::DiffuseLobe::lambert},
                                 .compensation = shading::Compensation::none};
    const highend::Renderer renderer(device, buffers, pass.binKinds(), inputs, plain);
    return lightOf(renderer.shade(surface, setup.camera), surface.size());
  };
  const std::vector<double> lit = shade(nullptr), shadowed = shade(&maps);
  const gpu::ShadowOfLight of = maps.of(light);
  const Rays rays(setup.scene, light);

  VisibilityError error;
  const std::size_t pixels = std::size_t{setup.width} * setup.height;
  error.map.resize(pixels);
  error.exact.resize(pixels);
  error.difference.resize(pixels);
  error.band.resize(pixels);
  base::parallelFor(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!(lit[i] > 1e-12)) continue;
      const glm::dvec3 p(points[i].position), n = glm::normalize(glm::dvec3(points[i].geometricNormal));
      const std::uint32_t pixel = surface.pixels[i];
      const bool sees = rays.sees(p, n);
      error.map[pixel] = static_cast<float>(shadowed[i] / lit[i]);
      error.exact[pixel] = sees ? 1.f : 0.f;
      error.difference[pixel] = error.map[pixel] - error.exact[pixel];
      if (of.count == 0) continue;
      const gpu::ShadowView& view =
          maps.drawn()[of.first + (of.count == 1 ? 0 : faceOf(p - glm::dvec3(light.position)))];
      if (view.side == 0) continue;
      const double texels = 0.5 * view.side / gpu::shadowExtent(view, setup.options.filter);
      for (const glm::dvec2& d : diskOfTwoTexels()) {
        const auto q = besides(view, texels, p, n, d.x, d.y);
        if (q && rays.sees(*q, n) == sees) continue;
        error.band[pixel] = 1;
        break;
      }
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(lit[i] > 1e-12)) continue;
    const std::uint32_t pixel = surface.pixels[i];
    const double difference = error.difference[pixel];
    if (error.band[pixel]) {
      ++error.inside;
      error.insideMean += std::abs(difference);
      continue;
    }
    ++error.outside;
    error.outsideMean += std::abs(difference);
    error.acne += difference < -0.1 ? 1 : 0;
    error.leaks += difference > 0.1 ? 1 : 0;
  }
  if (error.outside > 0) error.outsideMean /= static_cast<double>(error.outside);
  if (error.inside > 0) error.insideMean /= static_cast<double>(error.inside);
  return error;
}

} // namespace parity::shadows

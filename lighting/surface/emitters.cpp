#include "lighting/surface/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/luminance.h"

namespace parity::lighting {

namespace {

std::array<glm::dvec3, 3> cornersOf(const scenes::Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  const scenes::Instance& placed = scene.instances[instance];
  const scenes::Mesh& mesh = scene.meshes[placed.mesh];
  const glm::dmat4 toWorld(placed.toWorld);
  std::array<glm::dvec3, 3> corners;
  for (int k = 0; k < 3; ++k)
    corners[static_cast<std::size_t>(k)] =
        glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[3 * triangle + static_cast<std::uint32_t>(k)]], 1));
  return corners;
}

using scenes::luminanceOf;

// Points of a triangle that stand for a quarter of it each.
constexpr std::array<glm::vec2, 4> kQuarters = {
    {{1 / 3.f, 1 / 3.f}, {1 / 6.f, 1 / 6.f}, {2 / 3.f, 1 / 6.f}, {1 / 6.f, 2 / 3.f}}};

} // namespace

Emitters::Emitters(const scenes::Scene& scene, const SurfaceLight& surfaces)
    : m_scene(scene), m_surfaces(surfaces), m_pdfOfInstance(scene.instances.size()) {
  double total = 0;
  std::vector<double> powers;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const scenes::Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    if (!surfaces.emits(i) || scene.materials[mesh.material].alphaMode == scenes::AlphaMode::blend) continue;
    m_pdfOfInstance[i].resize(mesh.indices.size() / 3);
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
      const auto corners = cornersOf(scene, i, t);
      const double area = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
      double luminance = 0;
      for (const glm::vec2& b : kQuarters)
        luminance += luminanceOf(surfaces.emission({.instance = i, .triangle = t, .barycentric = b})) / 4;
      if (!(area * luminance > 0) || !std::isfinite(area * luminance)) continue;
      m_pdfOfInstance[i][t] = static_cast<float>(luminance);
      m_triangles.push_back({i, t});
      powers.push_back(area * luminance);
      total += area * luminance;
    }
  }
  double sum = 0;
  for (const double power : powers) m_cdf.push_back((sum += power) / total);
  for (auto& pdfs : m_pdfOfInstance)
    for (float& pdf : pdfs) pdf = static_cast<float>(pdf / total);
}

EmitterSample Emitters::sample(const glm::dvec2& u) const {
  const auto found = std::upper_bound(m_cdf.begin(), m_cdf.end() - 1, u.x);
  const Triangle& chosen = m_triangles[static_cast<std::size_t>(found - m_cdf.begin())];
  const double before = found == m_cdf.begin() ? 0 : *(found - 1);
  const double rest = glm::clamp((u.x - before) / (*found - before), 0.0, 1.0);
  const auto corners = cornersOf(m_scene, chosen.instance, chosen.triangle);
  const double root = std::sqrt(rest), b1 = root * (1 - u.y), b2 = root * u.y; // Turk 1990, "Generating Random Points"
  EmitterSample sample;
  sample.hit = {.instance = chosen.instance, .triangle = chosen.triangle, .barycentric = glm::vec2(b1, b2)};
  sample.position = (1 - b1 - b2) * corners[0] + b1 * corners[1] + b2 * corners[2];
  const bool isMirrored = glm::determinant(glm::mat3(m_scene.instances[chosen.instance].toWorld)) < 0;
  sample.normal =
      glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) * (isMirrored ? -1. : 1.);
  sample.bothSides = m_surfaces.isDoubleSided(chosen.instance);
  sample.pdf = m_pdfOfInstance[chosen.instance][chosen.triangle];
  return sample;
}

double Emitters::pdf(const Visibility::Hit& hit) const {
  const std::vector<float>& pdfs = m_pdfOfInstance[hit.instance];
  return pdfs.empty() ? 0 : pdfs[hit.triangle];
}

} // namespace parity::lighting

#include "gpu/shadows/shadow_casters.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parity::gpu {

namespace {

constexpr float kFlat = 1e-6f, kBehind = 1e-5f;
// Comparing more pairs than that takes longer than it saves.
constexpr std::size_t kMaxPairs = 10'000'000;

struct Plane {
  glm::vec3 normal{0.f};
  glm::vec3 point{0.f};
};

// NaN where a point has one, as min and max let it pass by.
class BoundsBuilder {
public:
  void add(const glm::vec3& p) {
    m_bounds.lower = glm::min(m_bounds.lower, p);
    m_bounds.upper = glm::max(m_bounds.upper, p);
    m_poison += 0.f * (p.x + p.y + p.z);
  }
  scenes::Bounds bounds() const { return {m_bounds.lower + m_poison, m_bounds.upper + m_poison}; }

private:
  scenes::Bounds m_bounds{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
  float m_poison = 0; // 0, or NaN
};

scenes::Bounds boundsOf(const scenes::Mesh& mesh) {
  BoundsBuilder builder;
  for (const std::uint32_t i : mesh.indices) builder.add(mesh.positions[i]);
  return builder.bounds();
}
scenes::Bounds boundsOf(const std::array<glm::vec3, 8>& corners) {
  BoundsBuilder builder;
  for (const glm::vec3& p : corners) builder.add(p);
  return builder.bounds();
}

// In object space. None: it is not flat.
std::optional<Plane> planeOf(const scenes::Mesh& mesh, float size) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::vec3 p = mesh.positions[mesh.indices[i]];
    const glm::vec3 n = glm::cross(mesh.positions[mesh.indices[i + 1]] - p, mesh.positions[mesh.indices[i + 2]] - p);
    const float length = glm::length(n);
    if (!(length > kFlat * size * size)) continue; // a sliver says little of the plane
    const glm::vec3 normal = n / length;
    const bool isFlat = std::all_of(mesh.indices.begin(), mesh.indices.end(), [&](std::uint32_t k) {
      return std::abs(glm::dot(normal, mesh.positions[k] - p)) <= kFlat * size;
    });
    return isFlat ? std::optional<Plane>({normal, p}) : std::nullopt;
  }
  return std::nullopt;
}

float extentOf(const scenes::Bounds& b) {
  float extent = 0;
  for (int c = 0; c < 3; ++c) extent = std::max({extent, std::abs(b.lower[c]), std::abs(b.upper[c])});
  return extent;
}

// Squares of what is smaller are finite (Embree has the same limit).
bool isUsable(const scenes::Bounds& b) {
  const glm::vec3 d = b.upper - b.lower;
  return d.x >= 0 && d.y >= 0 && d.z >= 0 && extentOf(b) < 1.8e18f;
}

// Which sides of the flat ones have something; `all`: also what is blended, which receives.
void findSides(std::vector<Caster>& casters, const std::vector<std::array<glm::vec3, 8>>& all, float size) {
  const auto flat =
      static_cast<std::size_t>(std::count_if(casters.begin(), casters.end(), [](const Caster& c) { return c.isFlat; }));
  if (flat == 0 || flat > kMaxPairs / all.size()) return;
  for (Caster& caster : casters) {
    if (!caster.isFlat) continue;
    caster.castsUp = caster.castsDown = false;
    for (const auto& corners : all)
      for (const glm::vec3& p : corners) {
        const float side = glm::dot(caster.normal, p) - caster.distance;
        caster.castsUp |= side > kBehind * size;
        caster.castsDown |= side < -kBehind * size;
      }
  }
}

} // namespace

Casters findCasters(const scenes::Scene& scene) {
  struct OfMesh {
    bool isKnown = false;
    scenes::Bounds bounds;
    std::optional<Plane> plane;
  };
  std::vector<OfMesh> meshes(scene.meshes.size());
  Casters found;
  std::vector<Caster>& casters = found.list;
  std::vector<std::array<glm::vec3, 8>> all;
  glm::vec3 lower(INFINITY), upper(-INFINITY);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const scenes::Instance& instance = scene.instances[i];
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.indices.empty()) continue;
    OfMesh& of = meshes[instance.mesh];
    if (!of.isKnown) {
      of.bounds = boundsOf(mesh);
      of.plane = planeOf(mesh, glm::length(of.bounds.upper - of.bounds.lower));
      of.isKnown = true;
    }
    Caster caster;
    caster.instance = i;
    for (unsigned c = 0; c < 8; ++c) {
      const glm::vec3 corner((c & 1) ? of.bounds.upper.x : of.bounds.lower.x,
                             (c & 2) ? of.bounds.upper.y : of.bounds.lower.y,
                             (c & 4) ? of.bounds.upper.z : of.bounds.lower.z);
      caster.corners[c] = glm::vec3(instance.toWorld * glm::vec4(corner, 1.f));
    }
    caster.bounds = boundsOf(caster.corners);
    if (!isUsable(caster.bounds)) continue;
    found.extent = std::max(found.extent, extentOf(caster.bounds));
    all.push_back(caster.corners);
    lower = glm::min(lower, caster.bounds.lower);
    upper = glm::max(upper, caster.bounds.upper);
    const scenes::Material& material = scene.materials[mesh.material];
    if (!material.castsShadow()) continue;
    if (of.plane) {
      const glm::vec3 normal = glm::inverse(glm::transpose(glm::mat3(instance.toWorld))) * of.plane->normal;
      const float length = glm::length(normal);
      caster.isFlat = std::isfinite(length) && length > 0;
      if (caster.isFlat) {
        caster.normal = normal / length;
        caster.distance = glm::dot(caster.normal, glm::vec3(instance.toWorld * glm::vec4(of.plane->point, 1.f)));
      }
    }
    casters.push_back(caster);
  }
  if (!all.empty()) findSides(casters, all, glm::length(upper - lower));
  return found;
}

bool castsAwayFrom(const Caster& caster, const glm::vec3& position) {
  if (!caster.isFlat) return true;
  return glm::dot(caster.normal, position) > caster.distance ? caster.castsDown : caster.castsUp;
}

bool castsAlong(const Caster& caster, const glm::vec3& direction) {
  if (!caster.isFlat) return true;
  return glm::dot(caster.normal, direction) < 0 ? caster.castsDown : caster.castsUp;
}

} // namespace parity::gpu

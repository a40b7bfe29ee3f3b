// Whether anything of the scene stands between two points: shadows, exactly, by Embree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// All instances' triangles in world space. They occlude from both sides, as in a shadow map: what is single-sided is
// not see-through to light. Masked materials let rays through where their alpha test fails
// (lighting/surface/alpha_mask.h); blended and unlit ones (sky domes, signs) cast no shadow. A triangle without area or
// with a vertex that is not finite (or beyond 1.8e18 m, Embree's limit) occludes nothing. All members but the
// constructor may be called by any number of threads; the answers depend on the scene alone.
class Visibility {
public:
  // bodies: in place of all that, the instances that bound a body which light passes through
  // (scenes::Material::hasVolume), whether they occlude or not.
  // behind: those of the casters that light does not pass through at all (scenes::Material::hasTransmission), which are
  // what a path's backdrop shows.
  enum class Contents { casters, bodies, behind };
  // The scene must outlive it and not change. Throws base::Error (exit 4) beyond kMaxTriangles, and for what Embree
  // reports.
  explicit Visibility(const scenes::Scene& scene, Contents contents = Contents::casters);
  ~Visibility();

  // Of all instances together. Embree took 50 bytes a triangle of a floor of 4 million, copies of its vertices
  // included.
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 23;

  // Whether something lies on origin + t direction for t in [0, maxDistance]. direction: unit; finite.
  bool isOccluded(const glm::dvec3& origin, const glm::dvec3& direction,
                  double maxDistance = std::numeric_limits<double>::infinity()) const;

  // The nearest triangle that a ray meets.
  struct Hit {
    std::uint32_t instance = 0, triangle = 0; // of the scene; of the instance's mesh
    glm::vec2 barycentric{0.f};               // weights of the triangle's second and third vertex
    float distance = 0;
    glm::vec3 geometric{0.f}; // normal of the triangle, unit, on the side of its front
    bool front = true;        // it is met from the side that its front faces
  };
  // As isOccluded, and what it is that lies there first; nothing where the ray meets nothing.
  std::optional<Hit> firstHit(const glm::dvec3& origin, const glm::dvec3& direction,
                              double maxDistance = std::numeric_limits<double>::infinity()) const;
  // The same of one instance, as if nothing else were there, and of all but one. Of scenes with a body alone: elsewhere
  // both are firstHit.
  std::optional<Hit> firstHitOf(std::uint32_t instance, const glm::dvec3& origin, const glm::dvec3& direction,
                                double maxDistance = std::numeric_limits<double>::infinity()) const;
  std::optional<Hit> firstHitBeside(std::uint32_t instance, const glm::dvec3& origin, const glm::dvec3& direction,
                                    double maxDistance = std::numeric_limits<double>::infinity()) const;

  // Where a ray leaves a surface so that it does not meet the surface itself: moved along the geometric normal (unit,
  // towards the side of the ray) by surfaceOffset(position).
  glm::dvec3 leaveSurface(const glm::dvec3& position, const glm::dvec3& geometricNormal) const {
    return position + geometricNormal * surfaceOffset(position);
  }
  // What it was made of.
  const scenes::Scene& scene() const;

  // 2^-18 (4e-6) of the largest coordinate of the scene or the position, in metres: positions, vertices and Embree's
  // intersections are 32-bit floats, each wrong by a few 2^-24 of the coordinates it was computed from (an eye up
  // to 16 times as far away included). What is nearer to a surface than this casts no shadow on it.
  double surfaceOffset(const glm::dvec3& position) const;

private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

// A hash of all that decides the answers of Visibility(scene).
std::string hashOfOccluders(const scenes::Scene& scene);

} // namespace parity::lighting

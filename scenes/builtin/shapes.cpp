// Generated meshes for the built-in scenes.
#include "scenes/builtin/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace parity::scenes {
namespace {

constexpr double kTwoPi = glm::two_pi<double>();

// Two triangles per quad of a grid of (columns + 1) x (rows + 1) vertices from `first` on, rows from top to bottom.
void addGridTriangles(Mesh& mesh, std::uint32_t first, int columns, int rows) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
    if (pa == pb || pb == pc || pc == pa) return; // at a pole
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y)
    for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(columns); ++x) {
      const std::uint32_t a = first + y * stride + x, b = a + stride;
      add(a, b, b + 1);
      add(a, b + 1, a + 1);
    }
}

// A tube around a curve, its ring in the plane of two axes that turn with the curve as little as `up` allows.
Mesh makeTube(int segments, int sides, const std::function<glm::dvec3(double)>& curve,
              const std::function<double(double)>& radius, const glm::dvec3& up) {
  return makeSurface(sides, segments, [&](double u, double v) {
    constexpr double kStep = 1e-4;
    const glm::dvec3 along = glm::normalize(curve(v + kStep) - curve(v - kStep));
    const glm::dvec3 side = glm::normalize(glm::cross(up, along)), other = glm::cross(along, side);
    const double angle = kTwoPi * u;
    return curve(v) + radius(v) * (std::cos(angle) * side - std::sin(angle) * other);
  });
}

// A smooth curve through control points (Catmull and Rom 1974, uniform), t in [0,1].
template <typename Vec, std::size_t kCount> Vec interpolate(const std::array<Vec, kCount>& points, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (kCount - 1);
  const int i = std::min(static_cast<int>(at), static_cast<int>(kCount) - 2);
  const double x = at - i;
  const auto get = [&](int k) {
    return points[static_cast<std::size_t>(std::clamp(k, 0, static_cast<int>(kCount) - 1))];
  };
  const Vec a = get(i - 1), b = get(i), c = get(i + 1), d = get(i + 2);
  return 0.5 *
         (2.0 * b + (c - a) * x + (2.0 * a - 5.0 * b + 4.0 * c - d) * x * x + (3.0 * b - a - 3.0 * c + d) * x * x * x);
}

// Some unit vector at right angles to a unit vector.
glm::dvec3 perpendicularTo(const glm::dvec3& axis) {
  const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(other, axis));
}

// A profile (radius, height) from the top down, turned about +Y.
template <std::size_t kCount> Mesh makeTurned(const std::array<glm::dvec2, kCount>& profile, int segments, int rows) {
  return makeSurface(segments, rows, [&](double u, double v) {
    const glm::dvec2 p = interpolate(profile, v);
    const double radius = std::max(p.x, 0.0);
    return glm::dvec3(radius * std::sin(kTwoPi * u), p.y, radius * std::cos(kTwoPi * u));
  });
}

} // namespace

Mesh makeSurface(int columns, int rows, const std::function<glm::dvec3(double, double)>& p) {
  constexpr double kStep = 1e-5, kBesidePole = 1e-3;
  Mesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const double u = static_cast<double>(x) / columns, v = static_cast<double>(y) / rows;
      mesh.positions.push_back(glm::vec3(p(u, v)));
      mesh.uv0.push_back({static_cast<float>(u), static_cast<float>(v)});
      // One-sided at the ends: a profile is clamped there.
      const auto normalAt = [&](double w) {
        const double lower = std::max(w - kStep, 0.0), upper = std::min(w + kStep, 1.0);
        return glm::cross(p(u, upper) - p(u, lower), p(u + kStep, w) - p(u - kStep, w));
      };
      glm::dvec3 normal = normalAt(v);
      if (glm::length(normal) < 1e-14) normal = normalAt(v < 0.5 ? v + kBesidePole : v - kBesidePole);
      mesh.normals.push_back(glm::vec3(glm::normalize(normal)));
    }
  addGridTriangles(mesh, 0, columns, rows);
  return mesh;
}

Mesh makeSphere(double radius, int segments, int rings) {
  Mesh mesh;
  for (int y = 0; y <= rings; ++y)
    for (int x = 0; x <= segments; ++x) {
      const double u = static_cast<double>(x) / segments, v = static_cast<double>(y) / rings;
      // The seam closes and the poles meet bit by bit.
      const double phi = x == segments ? 0.0 : kTwoPi * u, theta = glm::pi<double>() * v;
      const double ring = y == 0 || y == rings ? 0.0 : std::sin(theta);
      const glm::dvec3 normal(ring * std::sin(phi), std::cos(theta), ring * std::cos(phi));
      mesh.normals.push_back(glm::vec3(normal));
      mesh.positions.push_back(glm::vec3(radius * normal));
      mesh.uv0.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  addGridTriangles(mesh, 0, segments, rings);
  return mesh;
}

Mesh makeTorusKnot(int p, int q, double radius, double tubeRadius, int segments, int sides) {
  const auto curve = [=](double t) {
    const double angle = kTwoPi * t * p, winding = kTwoPi * t * q;
    const double r = radius * (1.0 + 0.4 * std::cos(winding));
    return glm::dvec3(r * std::sin(angle), 0.4 * radius * std::sin(winding), r * std::cos(angle));
  };
  return makeTube(
      segments, sides, curve, [=](double) { return tubeRadius; }, glm::dvec3(0.0, 1.0, 0.0));
}

Mesh makeRoundedBox(const glm::dvec3& halfExtent, double edgeRadius, int steps) {
  Mesh mesh;
  // Along an edge of half length h: samples of equal angle in the rounded parts, one flat quad between them.
  const auto samplesOf = [&](double h) {
    std::vector<double> samples;
    for (int i = 0; i <= steps; ++i) {
      const double angle = glm::quarter_pi<double>() * (steps - i) / steps;
      samples.push_back(-(h - edgeRadius) - edgeRadius * std::tan(angle));
    }
    for (int i = steps; i >= 0; --i) samples.push_back(-samples[static_cast<std::size_t>(i)]);
    return samples;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      // right x up = outward
      const int rightAxis = (axis + 1) % 3, upAxis = (axis + 2) % 3;
      const std::vector<double> columns = samplesOf(halfExtent[rightAxis]), rows = samplesOf(halfExtent[upAxis]);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (std::size_t y = 0; y < rows.size(); ++y)
        for (std::size_t x = 0; x < columns.size(); ++x) {
          glm::dvec3 p;
          p[axis] = side * halfExtent[axis];
          p[rightAxis] = side * columns[x];
          p[upAxis] = -rows[y];
          const glm::dvec3 inner = glm::clamp(p, -halfExtent + edgeRadius, halfExtent - edgeRadius);
          const glm::dvec3 normal = glm::normalize(p - inner);
          mesh.positions.push_back(glm::vec3(inner + edgeRadius * normal));
          mesh.normals.push_back(glm::vec3(normal));
          mesh.uv0.push_back({static_cast<float>(0.5 + 0.5 * columns[x] / halfExtent[rightAxis]),
                              static_cast<float>(0.5 + 0.5 * rows[y] / halfExtent[upAxis])});
        }
      addGridTriangles(mesh, first, static_cast<int>(columns.size()) - 1, static_cast<int>(rows.size()) - 1);
    }
  return mesh;
}

Mesh makeRod(const glm::dvec3& from, const glm::dvec3& to, double radius, int sides) {
  const glm::dvec3 along = glm::normalize(to - from);
  const glm::dvec3 side = perpendicularTo(along), other = glm::cross(along, side);
  const auto onRing = [&](const glm::dvec3& center, double r, double u) {
    return center + r * (std::cos(kTwoPi * u) * side - std::sin(kTwoPi * u) * other);
  };
  Mesh mesh = makeSurface(sides, 1, [&](double u, double v) { return onRing(glm::mix(from, to, v), radius, u); });
  appendMesh(mesh, makeSurface(sides, 1, [&](double u, double v) { return onRing(from, v * radius, u); }));
  appendMesh(mesh, makeSurface(sides, 1, [&](double u, double v) { return onRing(to, (1 - v) * radius, u); }));
  return mesh;
}

Mesh makeRing(const glm::dvec3& axis, double radius, double tubeRadius, int segments, int sides) {
  const glm::dvec3 side = perpendicularTo(axis), other = glm::cross(axis, side);
  const auto curve = [=](double t) { return radius * (std::cos(kTwoPi * t) * side + std::sin(kTwoPi * t) * other); };
  return makeTube(
      segments, sides, curve, [=](double) { return tubeRadius; }, axis);
}

Mesh makeCard(double width, double height) {
  return makeSurface(1, 1, [=](double u, double v) { return glm::dvec3((u - 0.5) * width, (1 - v) * height, 0); });
}

Mesh makeTeapot() {
  const std::array<glm::dvec2, 9> body = {{{0.40, 0.80},
                                           {0.45, 0.79},
                                           {0.56, 0.70},
                                           {0.68, 0.53},
                                           {0.72, 0.36},
                                           {0.66, 0.19},
                                           {0.52, 0.07},
                                           {0.44, 0.00},
                                           {0.00, 0.00}}};
  const std::array<glm::dvec2, 9> lid = {{{0.00, 1.06},
                                          {0.07, 1.04},
                                          {0.095, 0.98},
                                          {0.05, 0.92},
                                          {0.09, 0.885},
                                          {0.25, 0.86},
                                          {0.37, 0.82},
                                          {0.42, 0.79},
                                          {0.38, 0.78}}};
  const std::array<glm::dvec3, 6> spout = {
      {{0.50, 0.25, 0}, {0.74, 0.30, 0}, {0.88, 0.46, 0}, {0.94, 0.62, 0}, {1.02, 0.74, 0}, {1.12, 0.80, 0}}};
  const std::array<glm::dvec3, 7> handle = {{{-0.52, 0.66, 0},
                                             {-0.72, 0.74, 0},
                                             {-0.95, 0.72, 0},
                                             {-1.04, 0.56, 0},
                                             {-0.98, 0.38, 0},
                                             {-0.84, 0.24, 0},
                                             {-0.60, 0.18, 0}}};
  const glm::dvec3 sideways(0, 0, 1);
  Mesh mesh = makeTurned(body, 96, 64);
  appendMesh(mesh, makeTurned(lid, 96, 48));
  const auto spoutRadius = [](double t) { return 0.16 - 0.14 * t + 0.055 * t * t; };
  // The curves go on straight beyond their ends, so that the direction there is theirs.
  const auto extend = [](const auto& points) {
    return [points](double t) {
      const double inside = std::clamp(t, 0.0, 1.0);
      const double step = inside < 0.5 ? 1e-3 : -1e-3;
      const auto at = interpolate(points, inside);
      return at + (interpolate(points, inside + step) - at) * ((t - inside) / step);
    };
  };
  appendMesh(mesh, makeTube(48, 32, extend(spout), spoutRadius, sideways));
  appendMesh(mesh, makeTube(
                       64, 24, extend(handle), [](double) { return 0.055; }, sideways));
  return mesh;
}

Mesh makeFloor(double halfSize, float repeats, int cells) {
  Mesh mesh = makeSurface(cells, cells, [=](double u, double v) {
    return glm::dvec3((2 * u - 1) * halfSize, 0.0, (2 * v - 1) * halfSize);
  });
  for (glm::vec2& uv : mesh.uv0) uv *= repeats;
  return mesh;
}

void addQuad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, d - a));
  const glm::dvec3 right = glm::normalize(d - a), down = glm::cross(right, normal);
  for (const glm::dvec3& p : {a, b, c, d}) {
    mesh.positions.push_back(glm::vec3(p));
    mesh.normals.push_back(glm::vec3(normal));
    mesh.uv0.push_back({static_cast<float>(glm::dot(p - a, right)), static_cast<float>(glm::dot(p - a, down))});
  }
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

Mesh makeBox(const glm::dvec3& lower, const glm::dvec3& upper) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool isUpper : {false, true}) {
      const int s = (axis + 1) % 3, t = (axis + 2) % 3; // s x t = axis
      const auto corner = [&](bool atS, bool atT) {
        glm::dvec3 p = isUpper ? upper : lower;
        p[s] = (atS ? upper : lower)[s];
        p[t] = (atT ? upper : lower)[t];
        return p;
      };
      if (isUpper)
        addQuad(mesh, corner(false, true), corner(false, false), corner(true, false), corner(true, true));
      else
        addQuad(mesh, corner(true, true), corner(true, false), corner(false, false), corner(false, true));
    }
  return mesh;
}

void appendMesh(Mesh& mesh, const Mesh& part, const glm::mat4& transform) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::mat3 rotation(transform);
  for (std::size_t i = 0; i < part.positions.size(); ++i) {
    mesh.positions.push_back(glm::vec3(transform * glm::vec4(part.positions[i], 1.f)));
    mesh.normals.push_back(glm::normalize(rotation * part.normals[i]));
    mesh.uv0.push_back(part.uv0[i]);
  }
  for (const std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

} // namespace parity::scenes

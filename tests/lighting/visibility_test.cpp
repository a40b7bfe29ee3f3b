// Rays against the scene: a double-precision loop over all triangles, and scenes whose shadows are known.
#include "lighting/surface/visibility.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "base/expect_error.h"
#include "base/parallel.h"
#include "scenes/builtin/builtin.h"
#include "scenes/builtin/shapes.h"
#include "support/random_direction.h"
#include "support/small_scenes.h"

namespace parity::lighting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

scenes::Scene makeScene(const scenes::Mesh& mesh, const glm::mat4& toWorld = glm::mat4(1.f)) {
  scenes::Scene scene;
  scene.name = "test";
  scene.meshes = {mesh};
  scene.instances = {{0, toWorld, "node"}};
  scene.materials.emplace_back().name = "grey";
  return scene;
}

using tests::randomDirection;

struct Ray {
  glm::dvec3 origin, direction;
  double maxDistance;
};

struct Triangle {
  glm::dvec3 corner, edge1, edge2;
};

std::vector<Triangle> trianglesOf(const scenes::Scene& scene) {
  std::vector<Triangle> triangles;
  for (const scenes::Instance& instance : scene.instances) {
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].unlit) continue;
    const glm::dmat4 toWorld(instance.toWorld);
    const auto vertex = [&](std::size_t i) {
      return glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[i]], 1));
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      triangles.push_back({vertex(i), vertex(i + 1) - vertex(i), vertex(i + 2) - vertex(i)});
  }
  return triangles;
}

// Moeller and Trumbore 1997 over every triangle, in double. margin: by how much, in barycentric coordinates and
// metres, a hit must lie within; a negative one counts near misses.
bool isOccludedNaively(const std::vector<Triangle>& triangles, const Ray& ray, double margin) {
  for (const Triangle& triangle : triangles) {
    const glm::dvec3 P = glm::cross(ray.direction, triangle.edge2), T = ray.origin - triangle.corner;
    const double det = glm::dot(triangle.edge1, P);
    if (det == 0) continue;
    const double u = glm::dot(P, T) / det;
    if (!(u >= margin && u <= 1 - margin)) continue;
    const glm::dvec3 Q = glm::cross(T, triangle.edge1);
    const double v = glm::dot(ray.direction, Q) / det, t = glm::dot(triangle.edge2, Q) / det;
    if (v >= margin && u + v <= 1 - margin && t >= margin && t <= ray.maxDistance - margin) return true;
  }
  return false;
}

TEST(Visibility, IsWhatEveryTriangleInTurnSays) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  for (const char* name : {"spheres", "lamps", "lights", "materials"}) {
    const scenes::Scene scene = scenes::makeBuiltinScene(name);
    const Visibility visibility(scene);
    const scenes::Bounds bounds = scene.bounds();
    const std::vector<Triangle> triangles = trianglesOf(scene);
    int hits = 0, misses = 0;
    for (int i = 0; i < 150; ++i) {
      const glm::dvec3 inBounds(uniform(random), uniform(random), uniform(random));
      const Ray ray{glm::mix(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper), inBounds), randomDirection(random),
                    i % 3 == 0 ? kInfinity : bounds.radius() * uniform(random)};
      const bool surely = isOccludedNaively(triangles, ray, 1e-4), perhaps = isOccludedNaively(triangles, ray, -1e-4);
      if (surely != perhaps) continue; // too close to an edge for 32 bits
      ++(surely ? hits : misses);
      ASSERT_EQ(visibility.isOccluded(ray.origin, ray.direction, ray.maxDistance), surely) << name << ", ray " << i;
    }
    EXPECT_GT(hits, 20) << name;
    EXPECT_GT(misses, 20) << name;
    EXPECT_GT(hits + misses, 140) << name;
  }
}

TEST(Visibility, FirstHitIsTheNearestTriangleAndItsSide) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform;
  for (const char* name : {"lamps", "materials"}) {
    scenes::Scene scene = scenes::makeBuiltinScene(name);
    for (std::size_t i = 0; i < scene.instances.size(); i += 2) // every other one mirrored
      scene.instances[i].toWorld *= glm::mat4(glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, 1));
    const Visibility visibility(scene);
    const scenes::Bounds bounds = scene.bounds();
    int fronts = 0, backs = 0, misses = 0;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 inBounds(uniform(random), uniform(random), uniform(random));
      const glm::dvec3 origin = glm::mix(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper), inBounds);
      const glm::dvec3 direction = randomDirection(random);
      const auto hit = visibility.firstHit(origin, direction);
      EXPECT_EQ(hit.has_value(), visibility.isOccluded(origin, direction));
      if (!hit) {
        ++misses;
        continue;
      }
      // Nothing lies before it, and it is the triangle that it says.
      if (hit->distance > 1e-3) {
        EXPECT_FALSE(visibility.isOccluded(origin, direction, hit->distance * (1 - 1e-4)));
      }
      const scenes::Instance& instance = scene.instances.at(hit->instance);
      const scenes::Mesh& mesh = scene.meshes[instance.mesh];
      std::array<glm::dvec3, 3> v;
      for (int k = 0; k < 3; ++k)
        v[k] = glm::dvec3(glm::dmat4(instance.toWorld) *
                          glm::dvec4(mesh.positions[mesh.indices.at(3 * hit->triangle + k)], 1));
      const double b1 = hit->barycentric.x, b2 = hit->barycentric.y;
      const glm::dvec3 there = (1 - b1 - b2) * v[0] + b1 * v[1] + b2 * v[2];
      EXPECT_LT(glm::distance(there, origin + direction * double(hit->distance)), 1e-4 * bounds.radius());
      // The loader's rule: counter-clockwise in object space is the front, a mirroring transform keeps it one.
      const glm::dvec3 front =
          glm::cross(v[1] - v[0], v[2] - v[0]) * (glm::determinant(glm::mat3(instance.toWorld)) < 0 ? -1.0 : 1.0);
      const double cosine = glm::dot(glm::normalize(front), direction);
      if (std::abs(cosine) > 1e-3) {
        EXPECT_EQ(hit->front, cosine < 0) << name << ", ray " << i;
      }
      EXPECT_GT(glm::dot(glm::normalize(front), glm::dvec3(hit->geometric)), 1 - 1e-4);
      ++(hit->front ? fronts : backs);
    }
    EXPECT_GT(fronts, 200) << name;
    EXPECT_GT(backs, 50) << name;
    EXPECT_GT(misses, 200) << name;
  }
}

// The plane y = 0 under a sphere: in shadow where the way to the sun passes the centre within the radius.
TEST(Visibility, ShadowOfASphereIsACylinder) {
  const double radius = 0.7;
  const scenes::Scene scene = makeScene(scenes::makeSphere(radius, 512, 256), tests::translation(2, 3, -1));
  const Visibility visibility(scene);
  const glm::dvec3 centre(2, 3, -1), sun = glm::normalize(glm::dvec3(0.5, 1, 0.3));
  const glm::dvec3 middle = centre - sun * (centre.y / sun.y);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> around(-1.2, 1.2);
  int shadowed = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p = middle + glm::dvec3(around(random), 0, around(random));
    const double distance = glm::length(glm::cross(centre - p, sun));
    if (std::abs(distance - radius) < 1e-4) continue; // the mesh lies within 5e-5 of the sphere
    EXPECT_EQ(visibility.isOccluded(p, sun), distance < radius) << distance;
    EXPECT_FALSE(visibility.isOccluded(p, -sun));
    shadowed += distance < radius;
  }
  EXPECT_GT(shadowed, 200);
}

TEST(Visibility, LightInAClosedBoxIsSeenFromWithinAlone) {
  const scenes::Scene scene = makeScene(scenes::makeRoundedBox(glm::dvec3(1), 0.1, 3));
  const Visibility visibility(scene);
  const glm::dvec3 light(0.3, -0.2, 0.1);
  std::mt19937 random(9);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 d = randomDirection(random), outside = light + d * 3.0, within = light + d * 0.6;
    EXPECT_TRUE(visibility.isOccluded(outside, -d, 3.0));
    EXPECT_FALSE(visibility.isOccluded(within, -d, 0.6));
    EXPECT_FALSE(visibility.isOccluded(outside, -d, 0.9)) << "ends before the wall";
    EXPECT_FALSE(visibility.isOccluded(outside, d));
  }
}

// Points interpolated in 32 bits as the surface pass does, far from the origin too.
TEST(Visibility, ConvexSurfacesDoNotShadowThemselvesAtGrazingLight) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform;
  for (const float away : {0.f, 50.f, 3000.f})
    for (const scenes::Mesh& mesh : {scenes::makeSphere(0.8, 96, 48), scenes::makeFloor(40, 1, 3)}) {
      const glm::mat4 toWorld = glm::mat4(glm::mat3(0.8f, 0, 0.6f, 0, 1, 0, -0.6f, 0, 0.8f)) +
                                tests::translation(away, -away / 3, 0.7f * away) - glm::mat4(1.f);
      const scenes::Scene scene = makeScene(mesh, toWorld);
      const Visibility visibility(scene);
      for (int i = 0; i < 4000; ++i) {
        const std::size_t first = 3 * (random() % (mesh.indices.size() / 3));
        const auto vertex = [&](std::size_t k) {
          return glm::vec3(toWorld * glm::vec4(mesh.positions[mesh.indices[first + k]], 1));
        };
        const glm::vec3 v0 = vertex(0), e1 = vertex(1) - v0, e2 = vertex(2) - v0;
        const float u = uniform(random), v = uniform(random) * (1 - u);
        const glm::vec3 p = v0 + u * e1 + v * e2;
        const glm::dvec3 d1(e1), d2(e2), normal = glm::normalize(glm::cross(d1, d2));
        const glm::dvec3 along = glm::normalize(d1 * std::cos(6.3 * u) + glm::cross(normal, d1) * std::sin(6.3 * u));
        const double sine = i % 2 == 0 ? 0.002 : 0.3;
        const glm::dvec3 light = glm::normalize(along + normal * sine), from = visibility.leaveSurface(p, normal);
        ASSERT_FALSE(visibility.isOccluded(from, light)) << away << ", point " << i;
        ASSERT_TRUE(visibility.isOccluded(from, -normal)) << "the surface is right below";
      }
    }
}

TEST(Visibility, BothSidesOccludeAndBlendedUnlitAndMostlyTransmissiveMaterialsDoNot) {
  scenes::Scene scene = makeScene(tests::makeQuad(0));
  scene.materials[0].doubleSided = false;
  for (const double side : {1.0, -1.0}) EXPECT_TRUE(Visibility(scene).isOccluded({0.2, 0.1, side}, {0, 0, -side}));
  scene.materials[0].alphaMode = scenes::AlphaMode::blend;
  EXPECT_FALSE(Visibility(scene).isOccluded({0.2, 0.1, 1}, {0, 0, -1}));
  scene.materials[0].alphaMode = scenes::AlphaMode::opaque;
  scene.materials[0].unlit = true;
  EXPECT_FALSE(Visibility(scene).isOccluded({0.2, 0.1, 1}, {0, 0, -1}));
  scene.materials[0].unlit = false;
  for (const float transmission : {0.5f, 0.51f, 1.f}) {
    scene.materials[0].transmission = transmission;
    EXPECT_EQ(Visibility(scene).isOccluded({0.2, 0.1, 1}, {0, 0, -1}), transmission == 0.5f) << transmission;
  }
}

// What lies behind glass is what casts, without all that transmits, be it little; bodies are those with a volume.
TEST(Visibility, ContentsAreTheCastersTheBodiesOrWhatLiesBehind) {
  scenes::Scene scene = tests::makeQuadScene();
  scenes::Material& m = scene.materials[0];
  const auto isThere = [&](Visibility::Contents contents) {
    return Visibility(scene, contents).isOccluded({0, 0, 1}, {0, 0, -1});
  };
  using Contents = Visibility::Contents;
  EXPECT_TRUE(isThere(Contents::casters) && isThere(Contents::behind));
  EXPECT_FALSE(isThere(Contents::bodies));
  m.transmission = 0.4f;
  EXPECT_TRUE(isThere(Contents::casters));
  EXPECT_FALSE(isThere(Contents::behind)) << "it is looked through";
  m.thickness = 0.1f;
  EXPECT_TRUE(isThere(Contents::bodies));
  m.transmission = 0.8f;
  EXPECT_FALSE(isThere(Contents::casters) || isThere(Contents::behind));
  EXPECT_TRUE(isThere(Contents::bodies));
  m.transmission = 0, m.diffuseTransmission = 1;
  EXPECT_TRUE(isThere(Contents::behind)) << "leaves are seen";
}

TEST(Visibility, NothingAndTrianglesOfNoUseOccludeNothing) {
  EXPECT_FALSE(Visibility(scenes::Scene()).isOccluded({0, 0, 0}, {0, 0, 1}));
  scenes::Scene scene = makeScene(tests::makeQuad(0));
  scene.meshes[0].positions = {{-1, -1, 0}, {1, 1, 0}, {1, 1, 0}, {3, 3, 0}};
  EXPECT_FALSE(Visibility(scene).isOccluded({0.5, 0.5, 1}, {0, 0, -1})) << "lines";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  scene.meshes[0].positions = {{nan, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, INFINITY, 0}};
  EXPECT_FALSE(Visibility(scene).isOccluded({0.5, 0, 1}, {0, 0, -1})) << "not finite";
  // A whole triangle beside a broken one still counts.
  scene.meshes[0] = tests::makeQuad(0);
  scene.meshes[0].positions[3].x = nan; // (1, 1), (-1, -1) and this
  const Visibility half(scene);
  EXPECT_TRUE(half.isOccluded({0.5, -0.5, 1}, {0, 0, -1}));
  EXPECT_FALSE(half.isOccluded({-0.5, 0.5, 1}, {0, 0, -1}));
}

TEST(Visibility, MoreTrianglesThanItTakesAreRefusedInWords) {
  scenes::Scene scene = makeScene(scenes::makeFloor(1, 1, 512)); // 2^19 triangles
  scene.instances.assign(17, scene.instances[0]);
  base::expectError([&] { const Visibility visibility(scene); }, {"triangles in all instances"});
}

TEST(Visibility, AnswersAllThreadsAlike) {
  const scenes::Scene scene = scenes::makeBuiltinScene("lamps");
  const Visibility visibility(scene);
  std::mt19937 random(1);
  std::vector<glm::dvec3> directions(20000);
  for (glm::dvec3& d : directions) d = randomDirection(random);
  std::vector<char> alone(directions.size()), together(directions.size());
  const glm::dvec3 from(0.1, 1.2, 0.2);
  for (std::size_t i = 0; i < alone.size(); ++i) alone[i] = visibility.isOccluded(from, directions[i]);
  base::parallelFor(together.size(), 100, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) together[i] = visibility.isOccluded(from, directions[i]);
  });
  EXPECT_EQ(alone, together);
}

TEST(Visibility, HashCoversWhatDecidesAndNothingElse) {
  scenes::Scene scene = makeScene(tests::makeQuad(0));
  scene.images.resize(1);
  scene.images[0].pixels = base::Image8(2, 2, 4, 255);
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[0].alphaMode = scenes::AlphaMode::mask;
  const std::string original = hashOfOccluders(scene);
  const auto hashWith = [&](const auto& change) {
    scenes::Scene other = scene;
    change(other);
    return hashOfOccluders(other);
  };
  EXPECT_EQ(hashWith([](scenes::Scene& s) { s.materials[0].roughness = 0.3f; }), original);
  EXPECT_EQ(hashWith([](scenes::Scene& s) { s.materials[0].name = "other"; }), original);
  EXPECT_EQ(hashWith([](scenes::Scene& s) { s.materials[0].transmission = 0.4f; }), original) << "it still casts";
  const std::function<void(scenes::Scene&)> changes[] = {
      [](scenes::Scene& s) { s.instances[0].toWorld[3].x = 1; },
      [](scenes::Scene& s) { s.instances.push_back(s.instances[0]); },
      [](scenes::Scene& s) { s.meshes[0].positions[2].x = 2; },
      [](scenes::Scene& s) { s.meshes[0].indices[5] = 1; },
      [](scenes::Scene& s) { s.meshes[0].uv0[1].x = 0.5f; },
      [](scenes::Scene& s) { s.meshes[0].colors.assign(4, glm::vec4(0.5f)); },
      [](scenes::Scene& s) { s.materials[0].alphaMode = scenes::AlphaMode::opaque; },
      [](scenes::Scene& s) { s.materials[0].alphaMode = scenes::AlphaMode::blend; },
      [](scenes::Scene& s) { s.materials[0].unlit = true; },
      [](scenes::Scene& s) { s.materials[0].transmission = 0.6f; },
      [](scenes::Scene& s) { s.materials[0].alphaCutoff = 0.4f; },
      [](scenes::Scene& s) { s.materials[0].baseColor.a = 0.4f; },
      [](scenes::Scene& s) { s.materials[0].baseColorTexture.image = -1; },
      [](scenes::Scene& s) { s.materials[0].baseColorTexture.uvTransform[2] = 0.5f; },
      [](scenes::Scene& s) { s.materials[0].baseColorTexture.sampler.wrapV = scenes::Wrap::clampToEdge; },
      [](scenes::Scene& s) { s.materials[0].baseColorTexture.sampler.magFilter = scenes::Filter::nearest; },
      [](scenes::Scene& s) { s.images[0].pixels.pixels[7] = 0; }};
  int index = 0;
  for (const auto& change : changes) EXPECT_NE(hashWith(change), original) << "change " << index++;
}

} // namespace
} // namespace parity::lighting

// Generated tangent frames against what uv and normals define.
#include <cmath>
#include <random>

#include "scenes/builtin/shapes.h"
#include "scenes/gltf/tangents.h"

#include <gtest/gtest.h>

namespace parity::tests {
namespace {

using scenes::Mesh;

// A unit quad in z = 0 facing +Z; u along +X, v down (glTF). mirrored: u runs along -X.
Mesh makeQuadMesh(bool mirrored) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  for (const glm::vec3& p : mesh.positions) mesh.uv0.push_back({mirrored ? 1 - p.x : p.x, 1 - p.y});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TEST(Tangents, FollowUAndPointUpAgainstV) {
  Mesh mesh = makeQuadMesh(false);
  EXPECT_EQ(makeTangents(mesh, 0), 0u);
  ASSERT_EQ(mesh.tangents.size(), 4u);
  for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1)); // bitangent z x x = +y: up in the image
  mesh = makeQuadMesh(true);
  EXPECT_EQ(makeTangents(mesh, 0), 0u);
  for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(-1, 0, 0, -1)); // -(z x -x) = +y again
}

TEST(Tangents, SplitVerticesAtAMirroredSeam) {
  Mesh mesh; // two quads side by side, u mirrored about x = 1
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.normals.assign(6, {0, 0, 1});
  for (const glm::vec3& p : mesh.positions) mesh.uv0.push_back({std::abs(p.x - 1), 1 - p.y});
  mesh.colors.assign(6, glm::vec4(0.5f));
  mesh.indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
  EXPECT_EQ(makeTangents(mesh, 0), 0u);
  ASSERT_EQ(mesh.positions.size(), 8u) << "the two vertices of the seam are there twice";
  EXPECT_EQ(mesh.colors.size(), 8u);
  EXPECT_EQ(mesh.normals.size(), 8u);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const glm::vec4 expected = i < 6 ? glm::vec4(-1, 0, 0, -1) : glm::vec4(1, 0, 0, 1);
    EXPECT_EQ(mesh.tangents[mesh.indices[i]], expected) << i;
  }
}

TEST(Tangents, ShareAFrameAcrossVerticesThatDifferInNothing) {
  // A bent strip, once indexed and once with every corner on its own: the frames must be the same.
  Mesh indexed = scenes::makeSphere(1, 24, 12);
  Mesh corners = indexed;
  corners.positions.clear(), corners.normals.clear(), corners.uv0.clear();
  for (std::size_t i = 0; i < indexed.indices.size(); ++i) {
    corners.positions.push_back(indexed.positions[indexed.indices[i]]);
    corners.normals.push_back(indexed.normals[indexed.indices[i]]);
    corners.uv0.push_back(indexed.uv0[indexed.indices[i]]);
    corners.indices[i] = static_cast<std::uint32_t>(i);
  }
  makeTangents(indexed, 0);
  makeTangents(corners, 0);
  for (std::size_t i = 0; i < indexed.indices.size(); ++i) {
    const glm::vec4 a = indexed.tangents[indexed.indices[i]], b = corners.tangents[i];
    EXPECT_NEAR(glm::length(a - b), 0.f, 1e-5f);
  }
}

TEST(Tangents, AreThoseOfASphereInClosedForm) {
  Mesh mesh = scenes::makeSphere(2, 96, 48);
  EXPECT_EQ(makeTangents(mesh, 0), 0u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 n = mesh.normals[i], t = glm::vec3(mesh.tangents[i]);
    EXPECT_NEAR(glm::length(t), 1.f, 1e-5f);
    EXPECT_NEAR(glm::dot(t, n), 0.f, 1e-5f);
    if (std::abs(n.y) > 0.99f) continue;                              // dP/du turns around the poles
    const glm::vec3 alongU = glm::normalize(glm::vec3(n.z, 0, -n.x)); // p = (sin, ., cos)(2 pi u)
    EXPECT_GT(glm::dot(t, alongU), 0.999f);
    EXPECT_EQ(mesh.tangents[i].w, 1.f);
  }
}

TEST(Tangents, FallBackToSomeOrthonormalFrameWithoutUv) {
  Mesh mesh = makeQuadMesh(false);
  for (glm::vec2& uv : mesh.uv0) uv = {0.5f, 0.5f};
  EXPECT_EQ(makeTangents(mesh, 0), 4u);
  Mesh none = makeQuadMesh(false);
  none.uv0.clear();
  EXPECT_EQ(makeTangents(none, 1), 4u) << "no uv set 1 at all";
  for (const Mesh* each : {&mesh, &none})
    for (const glm::vec4& t : each->tangents) {
      EXPECT_NEAR(glm::length(glm::vec3(t)), 1.f, 1e-6f);
      EXPECT_NEAR(t.z, 0.f, 1e-6f);
      EXPECT_EQ(t.w, 1.f);
    }
}

TEST(Tangents, MendTheFilesOwn) {
  Mesh mesh = makeQuadMesh(false);
  mesh.tangents = {{3, 0, 0, 1}, {0, 0, 0, 1}, {0, std::nanf(""), 0, 1}, {0, 2, 0, -0.5f}};
  const auto broken = mendTangents(mesh);
  EXPECT_EQ(broken.zero + broken.notFinite, 2u);
  EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(mesh.tangents[3], glm::vec4(0, 1, 0, -1));
  for (const glm::vec4& t : mesh.tangents) EXPECT_NEAR(glm::dot(glm::vec3(t), glm::vec3(0, 0, 1)), 0.f, 1e-6f);
}

TEST(Tangents, PerpendicularToIsUnitAndPerpendicularForAnyNormal) {
  std::mt19937 random(7);
  std::normal_distribution<float> gauss;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 n = glm::normalize(glm::vec3(gauss(random), gauss(random), i % 3 ? gauss(random) : -0.f));
    EXPECT_NEAR(glm::length(scenes::perpendicularTo(n)), 1.f, 1e-5f);
    EXPECT_NEAR(glm::dot(scenes::perpendicularTo(n), n), 0.f, 1e-5f);
  }
  for (const glm::vec3 n : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
    EXPECT_NEAR(glm::dot(scenes::perpendicularTo(n), n), 0.f, 0.f);
}

} // namespace
} // namespace parity::tests

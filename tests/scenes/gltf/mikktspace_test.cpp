// MikkTSpace against the public code's results, and what it promises about order.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "scenes/builtin/shapes.h"
#include "scenes/gltf/mikktspace.h"
#include "scenes/gltf/tangents.h"

namespace parity::tests {
namespace {

struct Golden {
  std::string name;
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uv;
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec4> tangents; // per corner, w as in glTF

  scenes::TangentInput input() const { return {positions, normals, uv, indices}; }
};

template <typename Vec> std::vector<Vec> vectors(const nlohmann::json& numbers) {
  std::vector<Vec> out(numbers.size() / Vec::length());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    out[i / Vec::length()][static_cast<int>(i % Vec::length())] = numbers[i].get<float>();
  return out;
}

std::vector<Golden> readGolden() {
  const auto file = std::filesystem::path(PARITY_SOURCE_DIR) / "tests/scenes/data/mikktspace_golden.json";
  std::vector<Golden> all;
  const nlohmann::json golden = nlohmann::json::parse(base::readText(file));
  for (const auto& mesh : golden["meshes"]) {
    all.push_back({mesh["name"], vectors<glm::vec3>(mesh["positions"]), vectors<glm::vec3>(mesh["normals"]),
                   vectors<glm::vec2>(mesh["uv"]), mesh["indices"], vectors<glm::vec4>(mesh["tangents"])});
    for (glm::vec4& t : all.back().tangents) t.w = -t.w;
  }
  return all;
}

TEST(MikkTSpace, GivesThePublicCodesTangentsAtEveryCorner) {
  const std::vector<Golden> all = readGolden();
  ASSERT_EQ(all.size(), 5u);
  for (const Golden& golden : all) {
    const std::vector<glm::vec4> made = makeCornerTangents(golden.input());
    ASSERT_EQ(made.size(), golden.tangents.size());
    std::size_t undefined = 0;
    for (std::size_t c = 0; c < made.size(); ++c)
      if (const float error = glm::length(made[c] - golden.tangents[c]); error > 1e-5f) {
        // The public code leaves (1, 0, 0) where nothing defines a tangent; that is where we have none.
        ASSERT_EQ(golden.tangents[c], glm::vec4(1, 0, 0, 1))
            << golden.name << " corner " << c << " is off by " << error;
        ASSERT_EQ(made[c], glm::vec4(0)) << golden.name << " corner " << c;
        ++undefined;
      }
    // At the poles of the sphere's seam only triangles without area meet.
    EXPECT_EQ(undefined, golden.name == "degenerate" ? 6u : golden.name == "sphere" ? 2u : 0u) << golden.name;
  }
}

// The same mesh with its triangles and vertices in another order; cornerOf: for each new corner the old one.
struct Shuffled {
  Golden mesh;
  std::vector<std::size_t> cornerOf;
};
Shuffled shuffle(const Golden& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> vertices(mesh.positions.size()), newOf(vertices.size());
  std::vector<std::size_t> triangles(mesh.indices.size() / 3);
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::iota(triangles.begin(), triangles.end(), std::size_t{0});
  std::shuffle(vertices.begin(), vertices.end(), random);
  std::shuffle(triangles.begin(), triangles.end(), random);
  Shuffled out;
  for (const std::uint32_t v : vertices) {
    newOf[v] = static_cast<std::uint32_t>(out.mesh.positions.size());
    out.mesh.positions.push_back(mesh.positions[v]);
    out.mesh.normals.push_back(mesh.normals[v]);
    out.mesh.uv.push_back(mesh.uv[v]);
  }
  for (const std::size_t t : triangles)
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
      out.mesh.indices.push_back(newOf[mesh.indices[c]]);
      out.cornerOf.push_back(c);
    }
  return out;
}

// Few vertices, many triangles over them: edges of three and more triangles, both orientations, no area in uv, equal
// corners. Here the public code takes what comes first.
Golden makeTangle(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> real(-1, 1);
  Golden mesh;
  for (int v = 0; v < 40; ++v) {
    mesh.positions.push_back(v % 7                    ? glm::vec3(real(random), real(random), real(random))
                             : mesh.positions.empty() ? glm::vec3(0)
                                                      : mesh.positions.back());
    mesh.normals.push_back(glm::normalize(glm::vec3(real(random), real(random), 1.5f)));
    mesh.uv.push_back(v % 3 ? glm::vec2(real(random), real(random)) : glm::vec2(0.5f));
  }
  for (int i = 0; i < 900; ++i) mesh.indices.push_back(random() % 40);
  return mesh;
}

TEST(MikkTSpace, DoesNotDependOnTheOrderOfTrianglesOrVertices) {
  std::vector<Golden> meshes = readGolden();
  for (unsigned seed = 0; seed < 20; ++seed) meshes.push_back(makeTangle(seed));
  for (const Golden& mesh : meshes) {
    const std::vector<glm::vec4> made = makeCornerTangents(mesh.input());
    for (unsigned seed = 1; seed < 4; ++seed) {
      const Shuffled other = shuffle(mesh, seed);
      const std::vector<glm::vec4> again = makeCornerTangents(other.mesh.input());
      for (std::size_t c = 0; c < again.size(); ++c)
        ASSERT_EQ(again[c], made[other.cornerOf[c]]) << mesh.name << " corner " << c; // bit by bit
    }
  }
}

TEST(MikkTSpace, IsUnitAndAtRightAnglesWhereverItIsDefined) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Golden mesh = makeTangle(seed);
    const std::vector<glm::vec4> made = makeCornerTangents(mesh.input());
    for (std::size_t c = 0; c < made.size(); ++c) {
      if (made[c].w == 0) continue;
      EXPECT_NEAR(glm::length(glm::vec3(made[c])), 1.f, 1e-6f);
      EXPECT_NEAR(glm::dot(glm::vec3(made[c]), mesh.normals[mesh.indices[c]]), 0.f, 1e-5f);
      EXPECT_EQ(std::abs(made[c].w), 1.f);
    }
  }
}

// Two triangles side by side, their shared corners written with either sign of 0; the second turns u by 45 degrees.
TEST(MikkTSpace, TakesBothZerosForTheSame) {
  Golden mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.f, 0, -0.f}, {0, 1, -0.f}, {-1, 0, 0}};
  mesh.normals.assign(6, {0, 0, 1});
  mesh.uv = {{0, 0}, {1, 0}, {0, 1}, {-0.f, 0}, {0, 1}, {-1, -1}};
  mesh.indices = {0, 1, 2, 3, 4, 5};
  const std::vector<glm::vec4> made = makeCornerTangents(mesh.input());
  EXPECT_EQ(made[0], made[3]) << "one group";
  EXPECT_NE(made[0], made[1]) << "of two directions";
}

// Two sheets that lie on each other, back to back but with the same normals: their directions cancel.
TEST(MikkTSpace, GivesEachTriangleItsOwnDirectionWhereASumVanishes) {
  Golden mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0.5f, 0}, {1, 0.5f, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uv = {{0, 0}, {0, 1}, {1, 0.5f}, {-1, 0.5f}};
  mesh.indices = {0, 2, 1, 0, 1, 3};
  const std::vector<glm::vec4> made = makeCornerTangents(mesh.input());
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(made[c], glm::vec4(c < 3 ? 1 : -1, 0, 0, -1)) << c;
}

// One vertex with very many triangles: nothing may look at pairs of them.
TEST(MikkTSpace, TakesFansOfManyTrianglesInLinearTime) {
  constexpr std::uint32_t kCount = 200000;
  for (const bool hasUv : {true, false}) {
    Golden fan;
    fan.positions.emplace_back(0);
    fan.uv.emplace_back(0.5f);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const double angle = 2 * M_PI * i / kCount;
      fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
      fan.uv.emplace_back(hasUv ? std::cos(angle) : 0.5, 0.5 + std::sin(angle));
      fan.indices.insert(fan.indices.end(), {0, i + 1, (i + 1) % kCount + 1});
    }
    fan.normals.assign(fan.positions.size(), {0, 0, 1});
    const auto start = std::chrono::steady_clock::now();
    const std::vector<glm::vec4> made = makeCornerTangents(fan.input());
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0) << hasUv;
    if (hasUv) {
      EXPECT_NEAR(glm::length(made[0] - glm::vec4(1, 0, 0, -1)), 0, 1e-5f);
    }
  }
}

} // namespace
} // namespace parity::tests

// Draco streams: what comes out is what went in, and nothing is believed that the accessors do not say.
#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "scenes/builtin/shapes.h"
#include "scenes/gltf/bytes_as.h"
#include "scenes/gltf/draco_writer.h"
#include "scenes/gltf/file/draco.h"

namespace parity::tests {
namespace {

using scenes::DracoExpectation;
using scenes::DracoMesh;

// A sphere; libdraco keeps no vertex that no triangle has, so there is none.
DracoSource makeSource() {
  const scenes::Mesh sphere = scenes::makeSphere(2, 16, 9);
  DracoSource source;
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (const std::uint32_t v : sphere.indices) {
    const auto [number, isNew] = numbers.try_emplace(v, static_cast<std::uint32_t>(numbers.size()));
    source.indices.push_back(number->second);
    if (!isNew) continue;
    source.positions.push_back(sphere.positions[v]);
    source.normals.push_back(sphere.normals[v]);
    source.uv.push_back(sphere.uv0[v]);
    source.joints.push_back(number->second * 0x01030507u);
  }
  return source;
}

DracoExpectation expectationOf(const DracoSource& source) {
  return {source.positions.size(),
          source.indices.size(),
          true,
          std::size_t{1} << 24,
          {{0, 5126, 3}, {1, 5126, 3}, {2, 5126, 2}, {3, 5121, 4}}};
}

// A triangle as the numbers of its corners, free of the order of vertices and triangles.
using Corner = std::array<float, 8>;
std::vector<std::array<Corner, 3>> trianglesOf(const std::vector<glm::vec3>& positions,
                                               const std::vector<glm::vec3>& normals, const std::vector<glm::vec2>& uv,
                                               const std::vector<std::uint32_t>& indices) {
  std::vector<std::array<Corner, 3>> out(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t v = indices[i];
    out[i / 3][i % 3] = {positions[v].x, positions[v].y, positions[v].z, normals[v].x,
                         normals[v].y,   normals[v].z,   uv[v].x,        uv[v].y};
  }
  for (auto& triangle : out)
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  std::sort(out.begin(), out.end());
  return out;
}

void expectReason(const std::vector<std::byte>& stream, const DracoExpectation& expected, const std::string& part) {
  try {
    scenes::decodeDraco(stream, expected);
    ADD_FAILURE() << "no error where one with '" << part << "' was due";
  } catch (const std::invalid_argument& reason) {
    EXPECT_NE(std::string(reason.what()).find(part), std::string::npos) << reason.what();
  }
}

TEST(Draco, GivesTheMeshThatWasEncoded) {
  const DracoSource source = makeSource();
  for (const bool edgebreaker : {false, true}) {
    const DracoMesh mesh = scenes::decodeDraco(encodeDraco(source, edgebreaker), expectationOf(source));
    ASSERT_EQ(mesh.attributes.size(), 4u);
    EXPECT_EQ(trianglesOf(as<glm::vec3>(mesh.attributes[0]), as<glm::vec3>(mesh.attributes[1]),
                          as<glm::vec2>(mesh.attributes[2]), mesh.indices),
              trianglesOf(source.positions, source.normals, source.uv, source.indices))
        << edgebreaker;
    std::vector<std::uint32_t> joints = as<std::uint32_t>(mesh.attributes[3]), given = source.joints;
    std::sort(joints.begin(), joints.end());
    std::sort(given.begin(), given.end());
    EXPECT_EQ(joints, given);
  }
}

// Made by libdraco 1.5.5 of the triangle (0,0,0) (1,0,0) (0,2,0), and legible: "DRACO", bitstream 2.2, a mesh,
// sequential, no flags; one triangle of three points, its indices as bytes; one group of one attribute (positions,
// 32-bit floats, three of them, not normalised, id 0) as raw values: nine floats.
TEST(Draco, DecodesAStreamByteByByte) {
  const std::vector<unsigned char> head = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 1, 3,
                                           1,   0,   1,   2,   1,   1, 0, 9, 3, 0, 0, 0};
  const std::vector<float> values = {0, 0, 0, 1, 0, 0, 0, 2, 0};
  std::vector<std::byte> stream(head.size() + values.size() * sizeof(float));
  std::memcpy(stream.data(), head.data(), head.size());
  std::memcpy(stream.data() + head.size(), values.data(), values.size() * sizeof(float));
  const DracoMesh mesh = scenes::decodeDraco(stream, {3, 3, true, 4096, {{0, 5126, 3}}});
  EXPECT_EQ(as<glm::vec3>(mesh.attributes[0]), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}));
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Draco, UndoesTheQuantisationOfPositions) {
  const DracoSource source = makeSource();
  const DracoMesh mesh = scenes::decodeDraco(encodeDraco(source, true, 12), expectationOf(source));
  for (const glm::vec3& p : as<glm::vec3>(mesh.attributes[0])) {
    float nearest = 1e9f;
    for (const glm::vec3& q : source.positions) nearest = std::min(nearest, glm::length(p - q));
    EXPECT_LT(nearest, 4.f / 4095 * 0.87f) << "half a diagonal of a cell of the 12-bit grid over 4 m";
  }
}

TEST(Draco, ConvertsToTheAccessorsTypeWhereTheNumbersFit) {
  DracoSource source = makeSource();
  DracoExpectation expected = expectationOf(source);
  expected.attributes = {{3, 5123, 4}};
  const DracoMesh mesh = scenes::decodeDraco(encodeDraco(source, false), expected);
  const std::vector<std::uint16_t> joints = as<std::uint16_t>(mesh.attributes[0]);
  ASSERT_EQ(joints.size(), 4 * source.joints.size());
  EXPECT_EQ(joints[4 * 7 + 3], 7u);
  EXPECT_EQ(joints[4 * 7], 7u * 7);
  expected.attributes = {{3, 5120, 4}}; // 8 bits with a sign end at 127
  expectReason(encodeDraco(source, false), expected, "does not fit the accessor's componentType");
}

TEST(Draco, RefusesWhatTheAccessorsDoNotSay) {
  const DracoSource source = makeSource();
  for (const bool edgebreaker : {false, true}) {
    const std::vector<std::byte> stream = encodeDraco(source, edgebreaker);
    DracoExpectation expected = expectationOf(source);
    expected.indices -= 3;
    expectReason(stream, expected, "triangles, but the accessor has");
    expected = expectationOf(source);
    expected.vertices += 1;
    expectReason(stream, expected, "vertices, but the accessors have");
    expected = expectationOf(source);
    expected.attributes[2].componentCount = 3;
    expectReason(stream, expected, "attribute 2 has 2 components, but the accessor has 3");
    expected = expectationOf(source);
    expected.attributes[1].id = 9;
    expectReason(stream, expected, "the stream has no attribute 9");
    expected = expectationOf(source);
    expected.maxBytes = 5000;
    expectReason(stream, expected, "more memory than the limit allows");
  }
}

TEST(Draco, RefusesWhatIsNoStreamOfAMesh) {
  const DracoExpectation expected = expectationOf(makeSource());
  expectReason({}, expected, "not a Draco stream");
  expectReason(std::vector<std::byte>(200, std::byte{7}), expected, "not a Draco stream");
  std::vector<std::byte> stream = encodeDraco(makeSource(), true);
  stream[6] = std::byte{1};
  expectReason(stream, expected, "Draco bitstream 2.1, expected 2.2");
  stream[6] = std::byte{2};
  stream[7] = std::byte{0};
  expectReason(stream, expected, "not a Draco stream of a triangle mesh");
}

// Cut short, or with bytes changed: a reason or some mesh of the right size, and nothing else.
TEST(Draco, SurvivesDamage) {
  const DracoSource source = makeSource();
  const DracoExpectation expected = expectationOf(source);
  std::mt19937 random(5);
  std::size_t refused = 0;
  for (const bool edgebreaker : {false, true}) {
    const std::vector<std::byte> good = encodeDraco(source, edgebreaker);
    for (int i = 0; i < 600; ++i) {
      std::vector<std::byte> stream = good;
      if (i % 3 == 0)
        stream.resize(random() % good.size());
      else
        for (int n = 0; n < 3; ++n)
          stream[random() % (i % 3 == 1 ? 60 : good.size())] = static_cast<std::byte>(random());
      try {
        const DracoMesh mesh = scenes::decodeDraco(stream, expected);
        EXPECT_EQ(mesh.attributes[0].size(), 12 * expected.vertices);
        EXPECT_EQ(mesh.indices.size(), expected.indices);
        EXPECT_LT(*std::max_element(mesh.indices.begin(), mesh.indices.end()), expected.vertices);
      } catch (const std::invalid_argument&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 400u) << "at least all that were cut";
}

} // namespace
} // namespace parity::tests

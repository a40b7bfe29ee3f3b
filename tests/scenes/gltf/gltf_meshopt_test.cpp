// meshoptimizer's streams: known ones, re-encoded ones, filters by their definition, damaged ones.
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "scenes/builtin/shapes.h"
#include "scenes/gltf/bytes_as.h"
#include "scenes/gltf/file/meshopt.h"

namespace parity::tests {
namespace {

using scenes::decodeMeshopt;
using scenes::MeshoptFilter;
using scenes::MeshoptLayout;
using scenes::MeshoptMode;

std::vector<std::byte> packed(const std::vector<unsigned char>& values) {
  std::vector<std::byte> bytes(values.size());
  std::memcpy(bytes.data(), values.data(), values.size());
  return bytes;
}

template <typename T> std::vector<std::byte> encodeAttributes(const std::vector<T>& elements, std::size_t stride) {
  const std::size_t count = elements.size() * sizeof(T) / stride;
  std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), elements.data(), count, stride));
  return packed(out);
}

void expectReason(const std::vector<std::byte>& stream, const MeshoptLayout& layout, const std::string& part) {
  try {
    scenes::decodeMeshopt(stream, layout);
    ADD_FAILURE() << "no error where one with '" << part << "' was due";
  } catch (const std::invalid_argument& reason) {
    EXPECT_NE(std::string(reason.what()).find(part), std::string::npos) << reason.what();
  }
}

// The streams and their contents are meshoptimizer's own test data (A. Kapoulkine, demo/tests.cpp: kIndexDataV0,
// kIndexSequenceV1, kVertexDataV0).
TEST(Meshopt, DecodesTheLibrarysPublishedStreams) {
  const std::vector<std::byte> triangles =
      packed({0xe0, 0xf0, 0x10, 0xfe, 0xff, 0xf0, 0x0c, 0xff, 0x02, 0x02, 0x02, 0x00, 0x76, 0x87,
              0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00});
  const std::vector<std::uint32_t> list = {0, 1, 2, 2, 1, 3, 4, 6, 5, 7, 8, 9};
  EXPECT_EQ(as<std::uint32_t>(decodeMeshopt(triangles, {12, 4, MeshoptMode::triangles})), list);
  EXPECT_EQ(as<std::uint16_t>(decodeMeshopt(triangles, {12, 2, MeshoptMode::triangles})),
            std::vector<std::uint16_t>(list.begin(), list.end()));

  const std::vector<std::byte> sequence =
      packed({0xd1, 0x00, 0x04, 0xcd, 0x01, 0x04, 0x07, 0x98, 0x1f, 0x00, 0x00, 0x00, 0x00});
  EXPECT_EQ(as<std::uint32_t>(decodeMeshopt(sequence, {6, 4, MeshoptMode::indices})),
            (std::vector<std::uint32_t>{0, 1, 51, 2, 49, 1000}));

  std::vector<unsigned char> vertices = {0xa0, 0x01, 0x3f, 0x00, 0x00, 0x00, 0x58, 0x57, 0x58, 0x01, 0x26, 0x00, 0x00,
                                         0x00, 0x01, 0x0c, 0x00, 0x00, 0x00, 0x58, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00,
                                         0x00, 0x00, 0x00, 0x01, 0x3f, 0x00, 0x00, 0x00, 0x17, 0x18, 0x17, 0x01, 0x26,
                                         0x00, 0x00, 0x00, 0x01, 0x0c, 0x00, 0x00, 0x00, 0x17, 0x01, 0x08};
  vertices.resize(85, 0x00);
  EXPECT_EQ(as<std::uint16_t>(decodeMeshopt(packed(vertices), {4, 12, MeshoptMode::attributes})),
            (std::vector<std::uint16_t>{0, 0,   0, 0, 0, 0,   300, 0,   0, 0, 500, 0,
                                        0, 300, 0, 0, 0, 500, 300, 300, 0, 0, 500, 500}));
}

TEST(Meshopt, GivesTheMeshThatWasEncoded) {
  const scenes::Mesh mesh = scenes::makeSphere(1, 60, 31);
  const std::vector<std::byte> positions = encodeAttributes(mesh.positions, 12);
  EXPECT_EQ(as<glm::vec3>(decodeMeshopt(positions, {mesh.positions.size(), 12, MeshoptMode::attributes})),
            mesh.positions);
  std::vector<unsigned char> list(meshopt_encodeIndexBufferBound(mesh.indices.size(), mesh.positions.size()));
  list.resize(meshopt_encodeIndexBuffer(list.data(), list.size(), mesh.indices.data(), mesh.indices.size()));
  const auto decoded = as<std::uint32_t>(decodeMeshopt(packed(list), {mesh.indices.size(), 4, MeshoptMode::triangles}));
  ASSERT_EQ(decoded.size(), mesh.indices.size());
  for (std::size_t i = 0; i < decoded.size(); i += 3) { // triangles may be rotated
    std::array<std::uint32_t, 3> a = {decoded[i], decoded[i + 1], decoded[i + 2]};
    const std::array<std::uint32_t, 3> b = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    for (int turn = 0; turn < 2 && a != b; ++turn) a = {a[1], a[2], a[0]};
    ASSERT_EQ(a, b) << i;
  }
}

// EXT_meshopt_compression, "Filters": x and y of the octahedron over the integer that stands for one, in z; the sign of
// the octahedron's lower half folded out; a unit vector times 127; w as it is.
TEST(Meshopt, AppliesTheOctahedralFilterAsDefined) {
  const std::vector<std::array<std::int8_t, 4>> stored = {
      {127, 0, 127, 1}, {0, 0, 127, -1}, {-100, 90, 127, 1}, {5, 3, 7, 0}};
  const auto out = as<std::array<std::int8_t, 4>>(decodeMeshopt(
      encodeAttributes(stored, 4), {stored.size(), 4, MeshoptMode::attributes, MeshoptFilter::octahedral}));
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const double one = stored[i][2];
    double x = stored[i][0] / one, y = stored[i][1] / one;
    const double z = 1 - std::abs(x) - std::abs(y), fold = std::max(-z, 0.0);
    x += x >= 0 ? -fold : fold, y += y >= 0 ? -fold : fold;
    const double length = std::sqrt(x * x + y * y + z * z);
    EXPECT_NEAR(out[i][0], x / length * 127, 0.51) << i;
    EXPECT_NEAR(out[i][1], y / length * 127, 0.51) << i;
    EXPECT_NEAR(out[i][2], z / length * 127, 0.51) << i;
    EXPECT_EQ(out[i][3], stored[i][3]) << i;
  }
}

// The three smallest components over sqrt(2) of the integer in the fourth, whose lowest two bits say which is left out.
TEST(Meshopt, AppliesTheQuaternionFilterAsDefined) {
  const std::vector<std::array<std::int16_t, 4>> stored = {
      {0, 0, 0, 32767}, {1000, -2000, 3000, 32764}, {50, 60, -70, 127 - 2}};
  const auto out = as<std::array<std::int16_t, 4>>(decodeMeshopt(
      encodeAttributes(stored, 8), {stored.size(), 8, MeshoptMode::attributes, MeshoptFilter::quaternion}));
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const int largest = stored[i][3] & 3;
    const double scale = 1 / (std::sqrt(2.0) * (stored[i][3] | 3));
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = stored[i][c] * scale;
      sum += value * value;
      EXPECT_NEAR(out[i][static_cast<std::size_t>(largest + 1 + static_cast<int>(c)) & 3], value * 32767, 1) << i;
    }
    EXPECT_NEAR(out[i][static_cast<std::size_t>(largest)], std::sqrt(1 - sum) * 32767, 1) << i;
  }
}

// Eight bits of exponent over 24 bits of mantissa, both with a sign: 2^e m.
TEST(Meshopt, AppliesTheExponentialFilterAsDefined) {
  const auto pack = [](int e, int m) {
    return static_cast<std::uint32_t>(e) << 24 | (static_cast<std::uint32_t>(m) & 0xffffff);
  };
  const std::vector<std::uint32_t> stored = {pack(0, 5), pack(-3, -20), pack(10, 3), pack(-24, 0x7fffff)};
  const auto out = as<float>(
      decodeMeshopt(encodeAttributes(stored, 8), {2, 8, MeshoptMode::attributes, MeshoptFilter::exponential}));
  EXPECT_EQ(out, (std::vector<float>{5.f, -2.5f, 3072.f, std::ldexp(8388607.f, -24)}));
}

TEST(Meshopt, RefusesLayoutsThatTheExtensionForbids) {
  const std::vector<std::byte> stream = encodeAttributes(std::vector<float>(64, 1.f), 16);
  using enum MeshoptMode;
  expectReason(stream, {0, 16, attributes}, "its count is 0");
  expectReason(stream, {16, 0, attributes}, "its byteStride 0 is not a multiple of 4");
  expectReason(stream, {16, 6, attributes}, "its byteStride 6");
  expectReason(stream, {16, 260, attributes}, "its byteStride 260");
  expectReason(stream, {16, 1, triangles}, "its byteStride is 1, but TRIANGLES have 2 or 4");
  expectReason(stream, {16, 8, indices}, "its byteStride is 8, but INDICES have 2 or 4");
  expectReason(stream, {16, 4, triangles}, "16 indices do not form whole triangles");
  expectReason(stream, {15, 4, triangles, MeshoptFilter::exponential},
               "the filter EXPONENTIAL works only with the mode ATT");
  expectReason(stream, {16, 16, attributes, MeshoptFilter::octahedral},
               "the filter OCTAHEDRAL cannot have a byteStride of 16");
  expectReason(stream, {16, 16, attributes, MeshoptFilter::quaternion}, "the filter QUATERNION cannot have");
  expectReason(stream, {std::size_t{1} << 31, 256, attributes}, "bytes cannot hold 2147483648 elements of 256 bytes");
  expectReason(stream, {3000000000, 4, triangles}, "cannot hold");
  expectReason(stream, {16, 4, indices}, "the stream is damaged, or does not hold INDICES");
  EXPECT_THROW(scenes::meshoptModeOf("TRIANGLE"), std::invalid_argument);
  EXPECT_THROW(scenes::meshoptFilterOf(""), std::invalid_argument);
  EXPECT_EQ(scenes::meshoptModeOf("INDICES"), indices);
  EXPECT_EQ(scenes::meshoptFilterOf("EXPONENTIAL"), MeshoptFilter::exponential);
}

TEST(Meshopt, SurvivesDamage) {
  const scenes::Mesh mesh = scenes::makeSphere(1, 30, 16);
  const std::vector<std::byte> good = encodeAttributes(mesh.positions, 12);
  const MeshoptLayout layout{mesh.positions.size(), 12, MeshoptMode::attributes};
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    std::vector<std::byte> stream = good;
    const bool cut = i % 2;
    if (cut)
      stream.resize(random() % good.size());
    else
      stream[random() % good.size()] = static_cast<std::byte>(random());
    try {
      EXPECT_EQ(decodeMeshopt(stream, layout).size(), 12 * mesh.positions.size());
      EXPECT_FALSE(cut);
    } catch (const std::invalid_argument&) {
    }
  }
}

} // namespace
} // namespace parity::tests

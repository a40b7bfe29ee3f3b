// Where the surface pass places pixels in a lightmap, and what baked maps hold.
#include "support/baked_quads.h"

namespace parity::gpu {
namespace {

using tests::makeFrontCamera;
constexpr std::uint32_t kSide = 16;

class BakedSurfaceTest : public tests::DeviceTest {
protected:
  // (u, v, page + 1, side) by pixel of the picture.
  std::map<std::uint32_t, glm::vec4> places(const scenes::Scene& scene, const scenes::LightmapUvs* lightmap) {
    const SceneBuffers buffers(device(), scene, SpecularAa::off, {}, lightmap);
    m_vertexData = buffers.vertexData();
    const SurfacePass pass(device(), buffers, kSide, kSide);
    const Surface surface = std::move(pass.render(makeFrontCamera(1, 3, true), {0, kSide}, glm::vec2(0.5f)).front());
    std::map<std::uint32_t, glm::vec4> result;
    m_bytes = surface.lightmap.size();
    if ((m_vertexData & kVertexLightmap) == 0) return result;
    const auto values = surface.lightmap.downloadAs<glm::vec4>(surface.size());
    for (std::size_t i = 0; i < values.size(); ++i) result[surface.pixels[i]] = values[i];
    return result;
  }
  static glm::vec2 uvOf(std::uint32_t pixel) {
    return {(static_cast<float>(pixel % kSide) + 0.5f) / kSide, 1 - (static_cast<float>(pixel / kSide) + 0.5f) / kSide};
  }
  std::uint32_t m_vertexData = 0;
  vk::DeviceSize m_bytes = 0;
};

TEST_F(BakedSurfaceTest, InterpolatesTheCornersOfEachTriangleAndAddsTheOffset) {
  scenes::LightmapUvs uvs;
  uvs.corners = {{9, 9}}; // of another object
  // The second triangle's chart lies elsewhere than the first one's: shared vertices have two uvs.
  for (const glm::vec2 corner : tests::quadCorners())
    uvs.corners.push_back(uvs.corners.size() < 4 ? 0.25f * corner : 0.25f * corner + glm::vec2(0.5f, 0));
  uvs.places = {{.firstCorner = 1, .offset = {0.125f, 0.0625f}, .page = 2}};
  const auto placed = places(tests::makeQuadScene(), &uvs);
  ASSERT_EQ(placed.size(), std::size_t{kSide} * kSide);
  for (const auto& [pixel, place] : placed) {
    const glm::vec2 at = uvOf(pixel);
    if (at.x == at.y) continue; // on the diagonal
    const glm::vec2 expected =
        0.25f * at + glm::vec2(0.125f, 0.0625f) + (at.y > at.x ? glm::vec2(0.5f, 0) : glm::vec2(0));
    EXPECT_NEAR(place.x, expected.x, 1e-6f) << pixel;
    EXPECT_NEAR(place.y, expected.y, 1e-6f) << pixel;
    EXPECT_EQ(place.z, 3);
    EXPECT_EQ(place.w, 1);
  }
}

TEST_F(BakedSurfaceTest, TellsTheBackFromTheFrontAndObjectsWithoutALightmap) {
  scenes::Scene scene = tests::makeTwoQuads();
  scene.instances[0].toWorld[0].x *= -1; // half a turn about +Y
  scene.instances[0].toWorld[2].z *= -1;
  const scenes::LightmapUvs uvs{tests::quadCorners(), {{.page = 0}, {.page = -1}}};
  const auto placed = places(scene, &uvs);
  ASSERT_EQ(placed.size(), std::size_t{kSide} * kSide);
  for (const auto& [pixel, place] : placed) {
    const bool isLeft = pixel % kSide < kSide / 2;
    EXPECT_EQ(place.z, isLeft ? 1 : 0);
    EXPECT_EQ(place.w, isLeft ? -1 : 1);
    if (isLeft) {
      EXPECT_NEAR(place.x, 1 - 2 * uvOf(pixel).x, 1e-6f);
    }
  }
}

TEST_F(BakedSurfaceTest, WithoutLightmapsNothingIsWritten) {
  EXPECT_TRUE(places(tests::makeQuadScene(), nullptr).empty());
  EXPECT_EQ(m_bytes, 16u);
  const scenes::LightmapUvs none{{}, {{.page = -1, .capture = 1}}};
  EXPECT_TRUE(places(tests::makeQuadScene(), &none).empty());
  EXPECT_EQ(m_vertexData & kVertexLightmap, 0u);
}

TEST_F(BakedSurfaceTest, MapsSayWhatIsThere) {
  EXPECT_EQ(makeBakedMaps(device(), {}).parts, 0u);
  const tests::HostPages lightmap = tests::makeLightmapPages(vk::Format::eR8G8B8A8Unorm, 2, 3,
                                                             [](auto...) { return glm::vec4(0.5f); }),
                         shadow = tests::makeShadowPages(4, 3, [](auto) { return 7; });
  const GpuLightmapScales scales[2] = {};
  const GpuCapture captures[1] = {{.position = {1, 2, 3, 4}, .boxLower = {}, .boxUpper = {}}};
  const BakedMaps maps = makeBakedMaps(device(), {.lightmap = lightmap.view(),
                                                  .sunShadow = shadow.view(),
                                                  .transitionScale = 5,
                                                  .scales = scales,
                                                  .captures = captures});
  EXPECT_EQ(maps.parts, kBakedLightmap | kBakedSunShadow | kBakedCaptures);
  EXPECT_EQ(maps.scaleCount, 2u);
  EXPECT_EQ(maps.transitionScale, 5);
  const auto stored = maps.captures.downloadAs<glm::vec4>(2);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(stored[0].x), 1u);
  EXPECT_EQ(stored[1], glm::vec4(1, 2, 3, 4));
}

TEST_F(BakedSurfaceTest, MorePagesThanTheDeviceTakesAreRefused) {
  const std::uint32_t count = device().properties().limits.maxImageArrayLayers + 1;
  const std::vector<std::byte> none;
  EXPECT_THROW(makeBakedMaps(device(), {.lightmap = {vk::Format::eR8G8B8A8Unorm, 1, 2, count, none}}), base::Error);
}

} // namespace
} // namespace parity::gpu

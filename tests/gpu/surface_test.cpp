// The surface pass against planes whose every pixel is known.
#include "support/device.h"
#include "support/small_scenes.h"

#include <cstring>

#include "gpu/surface/surface_pass.h"

namespace parity::gpu {
namespace {

using tests::makeFrontCamera;
using tests::makeQuadScene;
using tests::translation;

constexpr std::uint32_t kSurfaceSide = 64;

struct Entry {
  glm::vec3 position, normal;
  glm::vec4 tangent, uv, uvDerivatives;
};

// Entries by pixel index of the whole picture.
std::map<std::uint32_t, Entry> download(const Surface& surface) {
  const std::size_t n = surface.size();
  const auto positions = surface.position.downloadAs<glm::vec4>(n), normals = surface.normal.downloadAs<glm::vec4>(n),
             tangents = surface.tangent.downloadAs<glm::vec4>(n), uvs = surface.uv.downloadAs<glm::vec4>(n),
             derivatives = surface.uv0Derivatives.downloadAs<glm::vec4>(n);
  std::map<std::uint32_t, Entry> entries;
  for (std::size_t i = 0; i < n; ++i)
    entries[surface.pixels[i]] = {glm::vec3(positions[i]), glm::vec3(normals[i]), tangents[i], uvs[i], derivatives[i]};
  return entries;
}

class SurfaceTest : public tests::DeviceTest {
protected:
  Surface render(const scenes::Scene& scene, const scenes::Camera& camera) {
    m_buffers = std::make_unique<SceneBuffers>(device(), scene);
    m_pass = std::make_unique<SurfacePass>(device(), *m_buffers, kSurfaceSide, kSurfaceSide);
    return std::move(m_pass->render(camera, {0, kSurfaceSide}, glm::vec2(0.5f)).front());
  }
  void TearDown() override {
    m_pass.reset();
    m_buffers.reset();
    DeviceTest::TearDown();
  }
  std::unique_ptr<SceneBuffers> m_buffers;
  std::unique_ptr<SurfacePass> m_pass;
};

TEST_F(SurfaceTest, GivesPositionFrameUvAndDerivativesOfAFacingPlaneInBothProjections) {
  const scenes::Scene scene = makeQuadScene();
  for (const bool orthographic : {false, true}) {
    const auto entries = download(render(scene, makeFrontCamera(1, 3, orthographic)));
    ASSERT_EQ(entries.size(), std::size_t{kSurfaceSide} * kSurfaceSide);
    for (const auto& [pixel, e] : entries) {
      const float x = (static_cast<float>(pixel % kSurfaceSide) + 0.5f) / kSurfaceSide,
                  y = (static_cast<float>(pixel / kSurfaceSide) + 0.5f) / kSurfaceSide;
      ASSERT_NEAR(e.position.x, 2 * x - 1, 2e-6f);
      ASSERT_NEAR(e.position.y, 1 - 2 * y, 2e-6f) << "row 0 is the top of the picture";
      ASSERT_NEAR(e.position.z, 0, 2e-6f);
      ASSERT_EQ(e.normal, glm::vec3(0, 0, 1));
      ASSERT_EQ(e.tangent, glm::vec4(1, 0, 0, 1));
      ASSERT_NEAR(e.uv.x, x, 2e-6f);
      ASSERT_NEAR(e.uv.y, 1 - y, 2e-6f);
      ASSERT_NEAR(e.uvDerivatives.x, 1.f / kSurfaceSide, 1e-6f);
      ASSERT_NEAR(e.uvDerivatives.y, 0, 1e-6f);
      ASSERT_NEAR(e.uvDerivatives.z, 0, 1e-6f);
      ASSERT_NEAR(e.uvDerivatives.w, -1.f / kSurfaceSide, 1e-6f);
    }
  }
}

TEST_F(SurfaceTest, DerivativesOfATiltedPlaneAreThoseOfTheProjection) {
  scenes::Scene scene = makeQuadScene();
  const float angle = 1.2f; // about +X: the top leans away
  scene.instances[0].toWorld[1] = glm::vec4(0, std::cos(angle), -std::sin(angle), 0);
  scene.instances[0].toWorld[2] = glm::vec4(0, std::sin(angle), std::cos(angle), 0);
  const float distance = 3;
  const auto entries = download(render(scene, makeFrontCamera(1, distance, false)));
  ASSERT_GT(entries.size(), 300u);
  // A ray (x, y, -d) meets the plane at v = y d / (d cos a - y sin a) along its own up axis (from y' = v cos a, z' = -v
  // sin a).
  const auto along = [&](double y) { return y * distance / (distance * std::cos(angle) - y * std::sin(angle)); };
  const auto acrossPerX = [&](double y) { return (distance + along(y) * std::sin(angle)) / distance; };
  const double step = 2.0 / kSurfaceSide;
  for (const auto& [pixel, e] : entries) {
    const double y = 1 - (pixel / kSurfaceSide + 0.5) * step, x = (pixel % kSurfaceSide + 0.5) * step - 1, h = 1e-5;
    ASSERT_NEAR(e.uv.y, 0.5 + along(y) / 2, 2e-5);
    ASSERT_NEAR(e.uvDerivatives.x, step * acrossPerX(y) / 2, 2e-5);
    ASSERT_NEAR(e.uvDerivatives.y, 0, 2e-5);
    const double dvdy = (along(y + h) - along(y - h)) / (2 * h) * -step / 2;
    ASSERT_NEAR(e.uvDerivatives.w, dvdy, 1e-4 * std::abs(dvdy) + 2e-5);
    const double dudy = x * (acrossPerX(y + h) - acrossPerX(y - h)) / (2 * h) * -step / 2;
    ASSERT_NEAR(e.uvDerivatives.z, dudy, 1e-3 * std::abs(dudy) + 2e-5);
  }
}

TEST_F(SurfaceTest, BackFaceTurnsItsFrameRoundOrIsCulledWhereSingleSided) {
  scenes::Scene scene = makeQuadScene();
  scene.instances[0].toWorld[0].x = -1; // half a turn about +Y
  scene.instances[0].toWorld[2].z = -1;
  const auto entries = download(render(scene, makeFrontCamera(1, 3, false)));
  ASSERT_EQ(entries.size(), std::size_t{kSurfaceSide} * kSurfaceSide);
  // Normal and tangent of the turned quad are -Z and -X; the back shows them reversed, and its bitangent too (w).
  EXPECT_EQ(entries.begin()->second.normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(entries.begin()->second.tangent, glm::vec4(1, 0, 0, -1));
  scene.materials[0].doubleSided = false;
  EXPECT_EQ(render(scene, makeFrontCamera(1, 3, false)).size(), 0u);
}

TEST_F(SurfaceTest, MirroringTransformKeepsTheFrontAndFlipsTheBitangent) {
  scenes::Scene scene = makeQuadScene();
  scene.materials[0].doubleSided = false;
  scene.instances[0].toWorld[0].x = -1;
  const auto entries = download(render(scene, makeFrontCamera(1, 3, false)));
  ASSERT_EQ(entries.size(), std::size_t{kSurfaceSide} * kSurfaceSide) << "a mirrored front face is still a front face";
  // cross(n, t) of (0,0,1) and (-1,0,0) is -Y; the quad's v still grows along +Y, so w is -1.
  EXPECT_EQ(entries.begin()->second.normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(entries.begin()->second.tangent, glm::vec4(-1, 0, 0, -1));
}

TEST_F(SurfaceTest, TinyScaleKeepsUnitNormals) {
  scenes::Scene scene = makeQuadScene();
  for (int c = 0; c < 3; ++c) scene.instances[0].toWorld[c] *= 1e-12f;
  const auto entries = download(render(scene, [] {
    scenes::Camera camera = makeFrontCamera(1e-12f, 3e-12f, true);
    camera.zNear = 1e-13f;
    return camera;
  }()));
  ASSERT_EQ(entries.size(), std::size_t{kSurfaceSide} * kSurfaceSide);
  EXPECT_EQ(entries.begin()->second.normal, glm::vec3(0, 0, 1));
}

TEST_F(SurfaceTest, AlphaMaskCutsByTheTextureItself) {
  scenes::Scene scene = makeQuadScene();
  scenes::TextureImage image{"half", base::Image8(2, 1, 4, 255)};
  image.pixels.pixels[3] = 0; // the left texel is transparent
  scene.images = {image};
  scenes::Material& material = scene.materials[0];
  material.alphaMode = scenes::AlphaMode::mask;
  material.baseColorTexture.image = 0;
  material.baseColorTexture.sampler.magFilter = scenes::Filter::nearest;
  const Surface surface = render(scene, makeFrontCamera(1, 3, false));
  EXPECT_EQ(surface.size(), std::size_t{kSurfaceSide} * kSurfaceSide / 2);
  for (const std::uint32_t pixel : surface.pixels) ASSERT_GE(pixel % kSurfaceSide, kSurfaceSide / 2);
}

// A texture with mips on many small triangles: at the edges of one, too, it is read at the level that the pixels have.
TEST_F(SurfaceTest, AlphaMaskIsNotTornAtTheEdgesOfTriangles) {
  scenes::Scene scene = makeQuadScene();
  constexpr std::uint32_t kCells = 16; // over 64 pixels, off their grid
  scenes::Mesh& mesh = scene.meshes[0];
  mesh = {};
  for (std::uint32_t y = 0; y <= kCells; ++y)
    for (std::uint32_t x = 0; x <= kCells; ++x) {
      const glm::vec2 uv(static_cast<float>(x) / kCells, static_cast<float>(y) / kCells);
      mesh.positions.emplace_back(2.2f * uv.x - 1.1f, 2.2f * uv.y - 1.1f, 0.f);
      mesh.normals.emplace_back(0, 0, 1);
      mesh.uv0.push_back(uv);
    }
  for (std::uint32_t y = 0; y < kCells; ++y)
    for (std::uint32_t x = 0; x < kCells; ++x) {
      const std::uint32_t i = y * (kCells + 1) + x;
      mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + kCells + 2, i, i + kCells + 2, i + kCells + 1});
    }
  scenes::TextureImage image{"half", base::Image8(256, 256, 4, 255)};
  for (int y = 0; y < 256; ++y)
    for (int x = 128; x < 256; ++x) image.pixels.at(x, y)[3] = 0; // the mean is between the two cutoffs
  scene.images = {image};
  scene.materials[0].alphaMode = scenes::AlphaMode::mask;
  scene.materials[0].baseColorTexture.image = 0;
  for (const float cutoff : {0.3f, 0.7f}) {
    scene.materials[0].alphaCutoff = cutoff;
    const Surface surface = render(scene, makeFrontCamera(1, 3, false));
    std::vector<int> shownInColumn(kSurfaceSide, 0);
    for (const std::uint32_t pixel : surface.pixels) ++shownInColumn[pixel % kSurfaceSide];
    for (std::uint32_t x = 0; x < kSurfaceSide; ++x) {
      if (x + 2 >= kSurfaceSide / 2 && x <= kSurfaceSide / 2 + 1) continue; // the cut itself
      ASSERT_EQ(shownInColumn[x], x < kSurfaceSide / 2 ? static_cast<int>(kSurfaceSide) : 0)
          << "column " << x << ", " << cutoff;
    }
  }
}

TEST_F(SurfaceTest, NearerSurfaceHidesTheOther) {
  scenes::Scene scene = makeQuadScene();
  scene.instances.push_back({0, translation(0.5f, 0, -1), "behind"});
  const Surface surface = render(scene, makeFrontCamera(2, 6, true));
  std::size_t front = 0, behind = 0;
  for (const std::uint32_t instance : surface.instances) ++(instance == 0 ? front : behind);
  EXPECT_EQ(front, std::size_t{kSurfaceSide} * kSurfaceSide / 4);
  EXPECT_EQ(behind, std::size_t{kSurfaceSide} * kSurfaceSide / 16);
}

TEST_F(SurfaceTest, TilesOfALargePictureFitTogether) {
  const std::uint32_t width = 1200, height = 1100;
  const auto tiles = makeTiles(width, height);
  ASSERT_EQ(tiles.size(), 2u);
  EXPECT_LE(width * tiles[0].rows, kMaxTilePixels);
  const scenes::Scene scene = makeQuadScene();
  const SceneBuffers buffers(device(), scene);
  const SurfacePass pass(device(), buffers, width, height);
  const scenes::Camera camera = makeFrontCamera(0.9f, 3, false);
  std::size_t total = 0;
  for (const Tile& tile : tiles)
    for (const auto& [pixel, e] : download(pass.render(camera, tile, glm::vec2(0.5f)).front())) {
      ASSERT_GE(pixel / width, tile.firstRow);
      ASSERT_LT(pixel / width, tile.firstRow + tile.rows);
      ASSERT_NEAR(e.position.y, 0.9 * (1 - 2 * (pixel / width + 0.5) / height), 3e-6);
      ++total;
    }
  EXPECT_EQ(total, std::size_t{width} * height);
}

TEST_F(SurfaceTest, SamplePositionsMoveWhatAPixelSees) {
  const scenes::Scene scene = makeQuadScene();
  const SceneBuffers buffers(device(), scene);
  const SurfacePass pass(device(), buffers, kSurfaceSide, kSurfaceSide);
  const scenes::Camera camera = makeFrontCamera(1, 3, true);
  for (const glm::vec2& sample : samplePositions(4)) {
    const auto entries = download(pass.render(camera, {0, kSurfaceSide}, sample).front());
    const auto& e = entries.at(10 * kSurfaceSide + 20);
    EXPECT_NEAR(e.position.x, 2 * (20 + sample.x) / kSurfaceSide - 1, 2e-6);
    EXPECT_NEAR(e.position.y, 1 - 2 * (10 + sample.y) / kSurfaceSide, 2e-6);
  }
}

TEST(SamplePositions, AverageToThePixelCentreAndStayInside) {
  for (const int count : {1, 2, 4, 16, 64}) {
    glm::vec2 sum(0);
    for (const glm::vec2& p : samplePositions(count)) {
      EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
      sum += p;
    }
    // A low-discrepancy set: the mean is off by no more than half a stratum.
    EXPECT_NEAR(sum.x / static_cast<float>(count), 0.5f, 0.5f / static_cast<float>(count) + 0.02f) << count;
    EXPECT_NEAR(sum.y / static_cast<float>(count), 0.5f, 0.5f / static_cast<float>(count) + 0.02f) << count;
  }
}

TEST(SamplePositions, LieOverTheFiltersBox) {
  for (const float width : {0.5f, 2.f}) {
    const std::vector<glm::vec2> all = samplePositions(64, width), unit = samplePositions(64);
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_NEAR(glm::distance(all[i] - 0.5f, width * (unit[i] - 0.5f)), 0, 1e-6);
  }
}

} // namespace
} // namespace parity::gpu

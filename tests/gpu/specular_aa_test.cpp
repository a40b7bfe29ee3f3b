// The roughness that every path's shader begins with, with specular anti-aliasing.
#include "support/bumpy_quad.h"
#include "support/device.h"

#include "gpu/surface/material_pass.h"

namespace parity::gpu {
namespace {

constexpr int kTexels = 64;

class SpecularAaMaterialTest : public tests::DeviceTest {
protected:
  // The quad seen straight on: pixel (x, y) from the top left sees texels [x, x + 1) kTexels / size of the map.
  std::vector<ResolvedMaterial> resolve(const scenes::Scene& scene, std::uint32_t size, SpecularAa specularAa) const {
    const SceneBuffers buffers(device(), scene, specularAa);
    const SurfacePass surfaces(device(), buffers, size, size);
    const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
    const std::vector<Surface> layers = surfaces.render(camera, {0, size}, glm::vec2(0.5f));
    const Surface& surface = layers.front();
    EXPECT_EQ(surface.size(), std::size_t{size} * size);
    const auto inOrder = MaterialPass(device(), buffers, surfaces.binKinds(), surface.size()).resolve(surface, camera);
    std::vector<ResolvedMaterial> byPixel(inOrder.size());
    for (std::size_t i = 0; i < inOrder.size(); ++i) byPixel[surface.pixels[i]] = inOrder[i];
    return byPixel;
  }
};

// The root of alpha^2's growth over one block of texels, from their unit normals; v runs up in the picture.
double rootOfGrowth(const base::Image8& map, int blocks, int column, int rowFromTop, double scale) {
  const int block = kTexels / blocks, row = blocks - 1 - rowFromTop;
  glm::dvec3 sum(0);
  for (int y = row * block; y < (row + 1) * block; ++y)
    for (int x = column * block; x < (column + 1) * block; ++x) {
      const std::uint8_t* t = map.at(x, y);
      sum += glm::normalize(glm::dvec3(t[0], t[1], t[2]) / 127.5 - 1.0);
    }
  const double length = glm::length(sum) / (block * block);
  return scale * std::sqrt(2 * (1 - length) / length);
}

TEST_F(SpecularAaMaterialTest, MinifiedBumpsAreRoughAsTheirMeanNormalsSay) {
  for (const float scale : {1.f, 0.5f})
    for (const int size : {8, 16}) {
      scenes::Scene scene = tests::makeBumpyQuad(kTexels, 0.2, 0.3f);
      scene.materials[0].normalScale = scale;
      const auto off = resolve(scene, size, SpecularAa::off), on = resolve(scene, size, SpecularAa::toksvig);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const std::size_t p = static_cast<std::size_t>(y) * size + x;
          const double root = rootOfGrowth(scene.images[0].pixels, size, x, y, scale);
          const double alpha2 = std::pow(0.3, 4), step = 0.6 / 255; // of 8 bits
          EXPECT_GT(on[p].roughness, std::pow(alpha2 + std::pow(root - step, 2), 0.25)) << x << ' ' << y;
          EXPECT_LT(on[p].roughness, std::pow(alpha2 + std::pow(root + step, 2), 0.25)) << x << ' ' << y;
          EXPECT_EQ(off[p].roughness, 0.3f);
          EXPECT_EQ(on[p].normal, off[p].normal);
          EXPECT_EQ(on[p].baseColor, off[p].baseColor);
        }
    }
  // Slopes of deviation 0.2 along each axis: alpha^2 grows by 0.08 or a little less, as normals are spread less.
  const auto on = resolve(tests::makeBumpyQuad(kTexels, 0.2, 0.3f), 8, SpecularAa::toksvig);
  double mean = 0;
  for (const ResolvedMaterial& m : on) mean += (std::pow(m.roughness, 4) - std::pow(0.3, 4)) / 64;
  EXPECT_NEAR(mean, 0.074, 0.008);
}

TEST_F(SpecularAaMaterialTest, MagnifiedBumpsAndFlatMapsKeepTheirRoughnessToTheBit) {
  const scenes::Scene bumpy = tests::makeBumpyQuad(8, 0.3, 0.37f), flat = tests::makeBumpyQuad(64, 0, 0.37f);
  for (const auto& [scene, size] : {std::pair(&bumpy, 32u), std::pair(&bumpy, 8u), std::pair(&flat, 8u)})
    for (const ResolvedMaterial& m : resolve(*scene, size, SpecularAa::toksvig)) ASSERT_EQ(m.roughness, 0.37f);
}

// An image may hold normals in RGB and specular in A: only the normal slot's copy gives up its alpha.
TEST_F(SpecularAaMaterialTest, OtherSlotsOfTheSameImageKeepItsAlpha) {
  scenes::Scene scene = tests::makeBumpyQuad(kTexels, 0.2, 0.3f);
  for (std::size_t t = 0; t < scene.images[0].pixels.pixelCount(); ++t) scene.images[0].pixels.pixels[4 * t + 3] = 51;
  scene.materials[0].specularTexture.image = 0;
  for (const ResolvedMaterial& m : resolve(scene, 8, SpecularAa::toksvig)) {
    ASSERT_NEAR(m.F90, 0.2f, 1e-6f);
    ASSERT_GT(m.roughness, 0.45f);
  }
}

TEST_F(SpecularAaMaterialTest, MaterialsWithoutNormalMapAreAsTheyWere) {
  scenes::Scene scene = tests::makeBumpyQuad(kTexels, 0.2, 0.3f);
  scene.materials[0].normalTexture = {};
  EXPECT_EQ(resolve(scene, 8, SpecularAa::toksvig).front().roughness, 0.3f);
  scene = tests::makeBumpyQuad(kTexels, 0.2, 0.3f);
  scene.materials[0].unlit = true;
  EXPECT_EQ(resolve(scene, 8, SpecularAa::toksvig).front().roughness, 0.3f);
}

} // namespace
} // namespace parity::gpu

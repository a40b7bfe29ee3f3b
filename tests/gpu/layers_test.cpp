// Blended surfaces layer by layer, against the composite of each pixel in closed form.
#include "support/device.h"
#include "support/small_scenes.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/surface/coverage_builder.h"
#include "gpu/surface/frame_builder.h"
#include "gpu/surface/material_pass.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t kLayersSide = 32;
const glm::vec3 kBackground(0.125f, 0.25f, 0.5f);

// A square of half side 1 in its own plane; opacity 1: not blended.
struct Pane {
  glm::mat4 toWorld{1.f};
  glm::vec3 color{1.f};
  float opacity = 0.5f;
  bool doubleSided = true;
};

scenes::Scene sceneOf(const std::vector<Pane>& panes) {
  scenes::Scene scene;
  for (std::uint32_t i = 0; i < panes.size(); ++i) {
    scenes::Material& material = scene.materials.emplace_back();
    material.name = "pane " + std::to_string(i);
    material.baseColor = glm::vec4(panes[i].color, panes[i].opacity);
    material.alphaMode = panes[i].opacity < 1 ? scenes::AlphaMode::blend : scenes::AlphaMode::opaque;
    material.doubleSided = panes[i].doubleSided;
    scene.meshes.push_back(tests::makeQuad(i));
    scene.instances.push_back({i, panes[i].toWorld, material.name});
  }
  return scene;
}

struct Seen {
  std::size_t pane;
  double z;
};

// What the ray through a pixel's centre meets in front of the first opaque pane, that one included, the nearest first.
std::vector<Seen> seenBy(const std::vector<Pane>& panes, std::uint32_t pixel) {
  const double x = (pixel % kLayersSide + 0.5) * 2 / kLayersSide - 1,
               y = 1 - (pixel / kLayersSide + 0.5) * 2 / kLayersSide;
  std::vector<Seen> seen;
  for (std::size_t i = panes.size(); i-- > 0;) {
    const glm::dmat4 m(panes[i].toWorld);
    const double determinant = m[0].x * m[1].y - m[1].x * m[0].y;
    const double a = ((x - m[3].x) * m[1].y - (y - m[3].y) * m[1].x) / determinant,
                 b = ((y - m[3].y) * m[0].x - (x - m[3].x) * m[0].y) / determinant;
    if (!(std::abs(a) <= 1 && std::abs(b) <= 1) || (determinant < 0 && !panes[i].doubleSided)) continue;
    seen.push_back({i, a * m[0].z + b * m[1].z + m[3].z});
  }
  // The later one is in front of those at its depth, and what is blended in front of what is opaque.
  std::stable_sort(seen.begin(), seen.end(), [&](const Seen& a, const Seen& b) {
    return a.z != b.z ? a.z > b.z : panes[a.pane].opacity < 1 && panes[b.pane].opacity == 1;
  });
  const auto opaque = std::find_if(seen.begin(), seen.end(), [&](const Seen& s) { return panes[s.pane].opacity == 1; });
  if (opaque != seen.end()) seen.erase(opaque + 1, seen.end());
  return seen;
}

glm::dvec3 compositeOf(const std::vector<Pane>& panes, std::uint32_t pixel) {
  glm::dvec3 color(kBackground);
  const std::vector<Seen> seen = seenBy(panes, pixel);
  for (auto s = seen.rbegin(); s != seen.rend(); ++s) {
    const double opacity = panes[s->pane].opacity;
    color = color * (1 - opacity) + glm::dvec3(panes[s->pane].color) * opacity;
  }
  return color;
}

class LayersTest : public tests::DeviceTest {
protected:
  struct Rendered {
    base::Image color;
    std::vector<base::PixelList> coverage;
    std::vector<std::size_t> layerSizes; // of all tiles, the opaque ones first
    std::size_t cutPixels = 0;
  };
  // In two tiles; what is seen is the resolved base colour.
  Rendered render(const scenes::Scene& scene) const {
    const SceneBuffers buffers(device(), scene);
    const SurfacePass pass(device(), buffers, kLayersSide, kLayersSide);
    const MaterialPass materials(device(), buffers, pass.binKinds(), kLayersSide * kLayersSide);
    const scenes::Camera camera = tests::makeFrontCamera(1, 8, true);
    FrameBuilder frame(kLayersSide, kLayersSide, 1, {}, kBackground);
    CoverageBuilder coverage(buffers, 1);
    Rendered rendered;
    for (const Tile& tile : {Tile{0, kLayersSide / 2}, Tile{kLayersSide / 2, kLayersSide / 2}}) {
      frame.begin(tile);
      coverage.begin(tile);
      const VisibleLayers visible = pass.rasterise(camera, tile, glm::vec2(0.5f));
      rendered.cutPixels += visible.cutPixels.size();
      for (std::size_t k = 0; k < visible.layers.size(); ++k) {
        const Surface surface = pass.resolve(visible, k, camera);
        std::vector<glm::vec4> colors;
        for (const ResolvedMaterial& m : materials.resolve(surface, camera))
          colors.emplace_back(m.baseColor, m.opacity);
        const ShadedSurface shaded{std::move(colors), {}};
        frame.lay(surface, shaded);
        coverage.lay(surface, shaded);
        rendered.layerSizes.push_back(surface.size());
      }
      frame.end();
      coverage.end();
    }
    rendered.color = frame.take().color;
    rendered.coverage = coverage.take();
    return rendered;
  }

  static void expectComposite(const Rendered& rendered, const std::vector<Pane>& panes, const std::string& what) {
    for (std::uint32_t pixel = 0; pixel < kLayersSide * kLayersSide; ++pixel) {
      const glm::dvec3 expected = compositeOf(panes, pixel);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(rendered.color.pixels[3 * pixel + c], expected[c], 1e-6)
            << what << ", pixel " << pixel << ", channel " << c;
    }
  }
};

glm::mat4 turned(float degrees, const glm::vec3& axis, const glm::vec3& at = glm::vec3(0)) {
  return glm::rotate(glm::translate(glm::mat4(1.f), at), glm::radians(degrees), axis);
}

TEST_F(LayersTest, StackedPanesComposeByDepthInWhateverOrderTheyCome) {
  std::vector<Pane> panes = {{tests::translation(0.5f, 0, 1), {1, 0, 0}, 0.5f},
                             {tests::translation(0, 0.5f, 2), {0, 1, 0}, 0.25f},
                             {tests::translation(-0.5f, 0.25f, 3), {0, 0, 1}, 0.75f}};
  std::vector<int> order = {0, 1, 2};
  do {
    const std::vector<Pane> shuffled = {panes[order[0]], panes[order[1]], panes[order[2]]};
    expectComposite(render(sceneOf(shuffled)), shuffled, testing::PrintToString(order));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_F(LayersTest, PanesThatCrossAreSortedInEachPixel) {
  // Around +Y, around +X, and askew, through one another, before a wall: the order changes across the picture.
  const std::vector<Pane> panes = {{turned(50, {0, 1, 0}), {0.9f, 0.1f, 0.2f}, 0.3f},
                                   {turned(-40, {0, 1, 0}), {0.1f, 0.8f, 0.3f}, 0.6f},
                                   {tests::translation(0, 0, -3), {0.7f, 0.7f, 0.6f}, 1},
                                   {turned(35, {1, 0, 0}), {0.2f, 0.3f, 0.9f}, 0.45f},
                                   {turned(30, glm::normalize(glm::vec3(1, 1, 0))), {0.8f, 0.7f, 0.1f}, 0.2f}};
  expectComposite(render(sceneOf(panes)), panes, "crossed");
}

TEST_F(LayersTest, PanesAtTheSameDepthAreAllShownTheLaterOneInFront) {
  const std::vector<Pane> panes = {{glm::mat4(1.f), {1, 0, 0}, 0.5f},
                                   {glm::mat4(1.f), {0, 1, 0}, 0.25f},
                                   {tests::translation(0, 0, 1), {1, 1, 1}, 0.125f},
                                   {glm::mat4(1.f), {0, 0, 1}, 0.75f}};
  expectComposite(render(sceneOf(panes)), panes, "coplanar");
  EXPECT_GT(compositeOf(panes, 0).z, 0.6) << "the last one lies in front";
}

TEST_F(LayersTest, TrianglesOfOneMeshAtTheSameDepthAreAllShown) {
  const std::vector<Pane> once = {{glm::mat4(1.f), {1, 0.5f, 0}, 0.5f}};
  scenes::Scene scene = sceneOf(once);
  scene.meshes[0].indices = {0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3};
  expectComposite(render(scene), {once[0], once[0], once[0]}, "three times the same");
}

TEST_F(LayersTest, BackFacesAreLayersWhereTheirMaterialIsDoubleSided) {
  const glm::vec3 up(0, 1, 0);
  // The sides of an open box, seen from the front: its own back wall shows through where it is double-sided.
  std::vector<Pane> panes = {{turned(180, up, {0.25f, 0, -1}), {1, 0, 0}, 0.5f},
                             {turned(0, up, {0, 0.25f, 1}), {0, 1, 0}, 0.5f}};
  expectComposite(render(sceneOf(panes)), panes, "double-sided");
  panes[0].doubleSided = false;
  expectComposite(render(sceneOf(panes)), panes, "back face culled");
  EXPECT_EQ(seenBy(panes, kLayersSide - 1).size(), 1u);
}

TEST_F(LayersTest, OpaqueSurfacesHideWhatLiesBehindAndNothingAtTheirDepth) {
  const std::vector<Pane> panes = {{tests::translation(0, 0, -1), {1, 0, 0}, 0.5f},
                                   {tests::translation(0.5f, 0, 0), {0.5f, 0.5f, 0.5f}, 1},
                                   {tests::translation(0.5f, 0, 0), {0, 1, 0}, 0.25f}};
  expectComposite(render(sceneOf(panes)), panes, "a pane behind, another at the wall's depth");
}

TEST_F(LayersTest, LayersAreAsBigAsTheirPixels) {
  const std::vector<Pane> panes = {{glm::scale(tests::translation(-0.5f, 0.5f, 1), glm::vec3(0.5f)), {1, 0, 0}, 0.5f},
                                   {glm::scale(tests::translation(-0.75f, 0.75f, 2), glm::vec3(0.25f)), {}, 0.5f},
                                   {glm::mat4(1.f), {1, 1, 1}, 1}};
  // The lower tile shows the wall alone.
  EXPECT_EQ(render(sceneOf(panes)).layerSizes, (std::vector<std::size_t>{512, 64, 256, 512}));
}

TEST_F(LayersTest, APixelCountsForEachMaterialByItsContribution) {
  const std::vector<Pane> panes = {{turned(50, {0, 1, 0}), {1, 0, 0}, 0.3f},
                                   {turned(-40, {0, 1, 0}), {0, 1, 0}, 0.6f},
                                   {tests::translation(1, 0, -3), {1, 1, 1}, 1},
                                   {turned(35, {1, 0, 0}), {0, 0, 1}, 0.45f}};
  const std::vector<base::PixelList> coverage = render(sceneOf(panes)).coverage;
  ASSERT_EQ(coverage.size(), panes.size());
  std::vector<std::vector<double>> weights(panes.size(), std::vector<double>(kLayersSide * kLayersSide, 0.0));
  for (std::size_t m = 0; m < coverage.size(); ++m)
    for (std::size_t i = 0; i < coverage[m].pixels.size(); ++i)
      weights[m][coverage[m].pixels[i]] = coverage[m].weights.empty() ? 1 : coverage[m].weights[i];
  for (std::uint32_t pixel = 0; pixel < kLayersSide * kLayersSide; ++pixel) {
    std::vector<double> expected(panes.size(), 0.0);
    double throughput = 1, sum = 0;
    for (const Seen& s : seenBy(panes, pixel)) {
      expected[s.pane] = throughput * panes[s.pane].opacity;
      throughput *= 1 - panes[s.pane].opacity;
    }
    for (std::size_t m = 0; m < panes.size(); ++m) {
      ASSERT_NEAR(weights[m][pixel], expected[m], 1e-6) << "pixel " << pixel << ", material " << m;
      sum += weights[m][pixel];
    }
    ASSERT_NEAR(sum, 1 - throughput, 1e-6) << "pixel " << pixel;
    if (pixel % kLayersSide >= kLayersSide / 2) {
      ASSERT_NEAR(sum, 1, 1e-6) << "before the wall";
    }
  }
}

TEST_F(LayersTest, LayersOfOneMaterialCountTogether) {
  scenes::Scene scene = sceneOf({{tests::translation(0, 0, 1), {1, 0, 0}, 0.5f}});
  scene.instances.push_back({0, tests::translation(0, 0, 2), "again"});
  const std::vector<base::PixelList> coverage = render(scene).coverage;
  ASSERT_EQ(coverage[0].pixels.size(), kLayersSide * kLayersSide);
  for (const float weight : coverage[0].weights) ASSERT_EQ(weight, 0.75f);
}

TEST_F(LayersTest, BeyondTheLimitTheFarthestAreLeftOutAndTheirPixelsNamed) {
  std::vector<Pane> panes;
  for (std::uint32_t i = 0; i < kMaxBlendedLayers + 2; ++i) // the last one is the farthest
    panes.push_back(
        {tests::translation(i < kMaxBlendedLayers ? 0.f : 1.f, 0, 2 - 0.125f * i), {i % 2, i % 3 / 2.f, 1}, 0.125f});
  const Rendered rendered = render(sceneOf(panes));
  EXPECT_EQ(rendered.cutPixels, kLayersSide * kLayersSide / 2);
  EXPECT_EQ(rendered.layerSizes.size(), 2 * (1 + kMaxBlendedLayers));
  panes.resize(kMaxBlendedLayers);
  expectComposite(rendered, panes, "the nearest");
  EXPECT_EQ(render(sceneOf(panes)).cutPixels, 0u);
}

TEST_F(LayersTest, NothingIsPeeledWhereNothingIsBlended) {
  base::Timings timings;
  Device ownDevice({.name = "", .validation = true});
  ownDevice.setTimings(&timings);
  const auto peels = [&](const scenes::Scene& scene) {
    const SceneBuffers buffers(ownDevice, scene);
    const SurfacePass pass(ownDevice, buffers, kLayersSide, kLayersSide);
    pass.render(tests::makeFrontCamera(1, 8, true), {0, kLayersSide}, glm::vec2(0.5f));
    const auto stages = timings.stages();
    return std::any_of(stages.begin(), stages.end(), [](const auto& s) { return s.first == "device: surface peel"; });
  };
  scenes::Scene scene = tests::makeQuadScene();
  scene.materials.push_back(scene.materials[0]); // blended, but placed nowhere
  scene.materials[1].alphaMode = scenes::AlphaMode::blend;
  EXPECT_FALSE(peels(scene));
  scene.materials[0].alphaMode = scenes::AlphaMode::blend;
  EXPECT_TRUE(peels(scene));
}

} // namespace
} // namespace parity::gpu

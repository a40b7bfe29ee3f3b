// Surfaces of two sides, and emitters with holes: what the integrator makes of both.
#include "bake/light/integrate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bake/bake_scenes.h"

namespace parity::bake {
namespace {

using namespace tests;
using std::numbers::pi;

scenes::Material twoSided(const std::string& name, float albedo, float emitted = 0) {
  scenes::Material material = matte(name, albedo, emitted);
  material.doubleSided = true;
  return material;
}

TEST(TwoSides, BothSidesOfADoubleSidedObjectAreLit) {
  scenes::Scene scene;
  addObject(scene, square(0.5f), twoSided("leaf", 0));
  const Baked baked(scene, {{pointLight({0, -2, 0}, glm::vec3(8, 4, 4))}, {}, {}});
  baked.forWhole([&](const SurfacePoint& point, const TexelLight& direct, const TexelLight&) {
    const double d = glm::length(glm::dvec3(0, -2, 0) - glm::dvec3(point.position));
    EXPECT_EQ(direct.irradiance, glm::vec3(0));
    EXPECT_NEAR(direct.back.x, 8 * 2 / (d * d * d), 0.01 * 8 / 4);
    EXPECT_LT(direct.sh.z, -0.75 * kY1);
  });
  // A page holds what comes from everywhere, without a normal: S(n)/l0 of the lower side gives its irradiance back.
  for (const IntegratedPage& page : makePages(scene, baked.atlas, baked.grid, baked.light, true))
    for (std::size_t i = 0; i < page.page.owner.pixelCount(); ++i) {
      if (page.page.owner.pixels[i] == kNoInstance) continue;
      const float *sh = page.page.sh.pixels.data() + 4 * i, *E = page.page.irradiance.pixels.data() + 3 * i;
      EXPECT_EQ(page.page.normal.pixels[3 * i + 1], 0);
      EXPECT_NEAR(E[0] / E[1], 2, 1e-3);
      EXPECT_NEAR(lightmapLuminance({E[0], E[1], E[2]}), pi * kY0 * sh[0], 1e-3 * E[0]);
    }
}

TEST(TwoSides, SealedDoubleSidedBoxIsDarkWithin) {
  scenes::Scene scene;
  scenes::Mesh box = insideOfBox(1);
  addObject(scene, box, twoSided("box", 0.7f));
  addObject(scene, square(0.5f), matte("floor within", 0.5f), glm::translate(glm::mat4(1.f), glm::vec3(0, -0.9f, 0)));
  scenes::Light sun;
  sun.kind = scenes::LightKind::directional;
  sun.direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
  sun.color = glm::vec3(100);
  const Baked baked(scene, {{sun}, 0, evenSky(glm::vec3(1))}, {.bounces = 2, .error = 0.1, .maxSamples = 512}, 4);
  baked.forWhole([&](const SurfacePoint& point, const TexelLight&, const TexelLight& gathered) {
    EXPECT_LT(gathered.irradiance.x, 1e-5) << point.instance; // its fronts look inwards
    if (point.instance == 0) {
      EXPECT_GT(gathered.back.x, 1) << "the sky, on the outside";
    }
  });
}

TEST(TwoSides, SunCastsShadowsOnBacksOfDoubleSidedObjects) {
  for (const bool turned : {false, true}) {
    scenes::Scene scene;
    addObject(scene, square(2), twoSided("ground", 0.5f),
              glm::rotate(glm::mat4(1.f), turned ? glm::radians(180.f) : 0.f, glm::vec3(1, 0, 0)));
    addObject(scene, square(0.5f), twoSided("roof", 0.5f), glm::translate(glm::mat4(1.f), glm::vec3(0, 1, 0)));
    scenes::Light sun;
    sun.kind = scenes::LightKind::directional;
    sun.direction = glm::vec3(0, -1, 0);
    const Baked baked(scene, {{sun}, 0, {}}, {.bounces = 0});
    int shadowed = 0;
    for (std::size_t i = 0; i < baked.light.sunLit.size(); ++i)
      shadowed += baked.grid.texels()[i].instance == 0 && baked.light.sunLit[i] == 0;
    EXPECT_NEAR(shadowed, 64, 2) << turned; // 1 m at 8 texels a metre
  }
}

// A panel of which the left half is cut out is one of half the size.
TEST(MaskedEmitters, DoNotShineFromTheirHoles) {
  const auto lit = [](bool masked) {
    scenes::Scene scene;
    addObject(scene, square(1), matte("floor", 0));
    scenes::Mesh panel = scenes::makeCard(1, 0.5);
    scenes::Material material = matte("panel", 0, 10);
    if (masked) {
      material.alphaMode = scenes::AlphaMode::mask;
      material.baseColorTexture.image = 0;
      scenes::TextureImage image{"half", base::Image8(2, 1, 4, 255)};
      image.pixels.at(0, 0)[3] = 0;
      material.baseColorTexture.sampler.magFilter = scenes::Filter::nearest;
      scene.images.push_back(image);
    } else {
      panel = scenes::makeCard(0.5, 0.5);
    }
    addObject(scene, panel, material, glm::translate(glm::mat4(1.f), glm::vec3(masked ? 0 : 0.25f, 0.2f, -0.5f)));
    double sum = 0;
    const Baked baked(scene, {}, {.bounces = 0});
    for (std::size_t i = 0; i < baked.light.gathered.size(); ++i)
      if (baked.grid.texels()[i].instance == 0) sum += baked.light.gathered[i].irradiance.x;
    return sum;
  };
  const double wanted = lit(false);
  EXPECT_GT(wanted, 1);
  EXPECT_NEAR(lit(true), wanted, 0.01 * wanted);
}

} // namespace
} // namespace parity::bake

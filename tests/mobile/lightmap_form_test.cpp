// The lightmap of high quality: what the high-end path reads and as it reads it, by the mobile path's formulas.
#include <cmath>

#include "support/baked_quads.h"

#include "highend/options.h"
#include "highend/path.h"
#include "mobile/path.h"
#include "mobile/presets.h"
#include "mobile/views.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::ShadedPixel;
namespace f32 = shading::f32;

constexpr int kFormSide = 4; // texels
constexpr float kFormMetallic = 0.25f;
const glm::vec3 kFormBase(0.8f, 0.5f, 0.2f);

std::uint8_t codeOf(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::min(std::max(value, 0.f), 1.f)));
}

// One light in both forms: its colour changes from texel to texel, its direction leans. alpha 0: the high-end form is
// that of a double-sided object.
lighting::BakedLight makeBothForms(float alpha) {
  lighting::BakedLight baked;
  baked.uvs = tests::wholePage();
  auto& halves = baked.halfPages.emplace_back(kFormSide, 2 * kFormSide, 4);
  base::Image8& codes = baked.lqPages.emplace_back(kFormSide, 2 * kFormSide, 4, std::uint8_t{255});
  baked.lqScales = {{1.5f, 1.5f, 1.5f, 0}, {0, 0, 0, 0}, {2, 2, 2, 0}, {-1, -1, -1, 0.282095f}};
  const f32::real32x3 l1{0.5f, -0.3f, 0.9f}, N0{0, 0, 1};
  const f32::real32x3 r = f32::encodeLightmapDirection(1, l1);
  const f32::LightmapSh sh = f32::encodeLightmapSh(1, l1);
  const float scale = f32::flatNormalScale(sh, N0);
  for (int y = 0; y < kFormSide; ++y)
    for (int x = 0; x < kFormSide; ++x) {
      const glm::vec3 color(0.2f + 0.3f * static_cast<float>(x), 0.5f + 0.2f * static_cast<float>(y),
                            1.1f - 0.1f * static_cast<float>(x + y));
      const f32::real32x3 log = f32::encodeLightmapLogRgb({color.x * scale, color.y * scale, color.z * scale});
      const float above[] = {color.x, color.y, color.z, alpha}, below[] = {r.x, r.y, r.z, 0},
                  logRgb[] = {log.x, log.y, log.z}, direction[] = {sh.x, sh.y, sh.z};
      for (int c = 0; c < 4; ++c) {
        halves.at(x, y)[c] = glm::packHalf1x16(above[c]);
        halves.at(x, y + kFormSide)[c] = glm::packHalf1x16(below[c]);
        if (c == 3) continue;
        codes.at(x, y)[c] = codeOf(logRgb[c] / 1.5f);
        codes.at(x, y + kFormSide)[c] = codeOf(0.5f * direction[c] + 0.5f);
      }
    }
  return baked;
}

scenes::Scene makeLitQuad() {
  scenes::Scene scene = tests::makeQuadScene();
  scene.materials[0].baseColor = glm::vec4(kFormBase, 1);
  scene.materials[0].metallic = kFormMetallic;
  tests::leanByNormalMap(scene, 204, 150, 230);
  return scene;
}

// What is made of a path, as shadeQuads asks for it.
struct MadeRenderer {
  std::unique_ptr<paths::Renderer> renderer;
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const {
    return renderer->shade(surface, camera);
  }
};

class LightmapFormTest : public tests::DeviceTest {
protected:
  struct Look {
    bool wide = false;
    std::uint32_t view = kViewLit;
  };
  // Pages are uploaded through the store, as in a run.
  std::vector<ShadedPixel> shade(const paths::Path& path, const paths::Options& options, const scenes::Scene& scene,
                                 const lighting::BakedLight& baked, paths::Store& store, const Look& look) {
    const base::Cache cache = base::Cache::disabled();
    const std::string buildId;
    const paths::Light light;
    const gpu::ShadowOptions shadowMaps;
    return tests::shadeQuads(device(), scene, &baked.uvs, [&](const auto& buffers, const auto& kinds) {
      MadeRenderer made{path.makeRenderer({.device = device(),
                                           .buffers = buffers,
                                           .binKinds = kinds,
                                           .light = light,
                                           .baked = &baked,
                                           .shadowMaps = shadowMaps,
                                           .terms = look.view == kViewLit,
                                           .wide = look.wide,
                                           .intermediate = look.view,
                                           .services = {nullptr, cache, buildId, store},
                                           .store = store},
                                          options)};
      m_notes = made.renderer->notes();
      return made;
    });
  }
  std::vector<ShadedPixel> shadeMobile(const Options& own, const scenes::Scene& scene,
                                       const lighting::BakedLight& baked, paths::Store& store, const Look& look) {
    paths::Options options;
    options.of<Options>() = own;
    return shade(mobile::path(), options, scene, baked, store, look);
  }
  std::vector<ShadedPixel> shadeHighend(const scenes::Scene& scene, const lighting::BakedLight& baked,
                                        paths::Store& store) {
    paths::Options options;
    options.of<highend::Options>() = {.model = {.diffuse = highend::DiffuseLobe::lambert},
                                      .compensation = highend::Compensation::none};
    return shade(highend::path(), options, scene, baked, store, {});
  }
  bool hasHalf() const { return device().report().float16; }

  std::vector<std::string> m_notes; // of the last renderer
};

Options inForm(const char* preset, LightmapForm form) {
  Options options = tests::inFp32(preset);
  options.lightmap = form;
  return options;
}

TEST_F(LightmapFormTest, OfHighQualityIsReadAsTheHighEndPathReadsIt) {
  const scenes::Scene scene = makeLitQuad();
  for (const float alpha : {1.f, 0.f}) {
    const lighting::BakedLight baked = makeBothForms(alpha);
    paths::Store store;
    const std::vector<ShadedPixel> exact = shadeHighend(scene, baked, store);
    for (const char* preset : {"karis2014", "ue4-2020"})
      for (const Precision precision : {Precision::fp32, Precision::fp16})
        for (const bool wide : {false, true}) {
          if (precision == Precision::fp16 && !hasHalf()) continue;
          const auto ofForm = [&](LightmapForm form) {
            Options options = inForm(preset, form);
            options.precision = precision;
            return shadeMobile(options, scene, baked, store, {.wide = wide});
          };
          const std::vector<ShadedPixel> hq = ofForm(LightmapForm::hq), lq = ofForm(LightmapForm::lq);
          double ofHq = 0, ofLq = 0;
          for (std::size_t i = 0; i < exact.size(); ++i) {
            const glm::vec3 light = exact[i][Term::lightmap];
            ASSERT_GT(light.z, 0.02f);
            tests::expectNear(hq[i][Term::lightmap], light, precision == Precision::fp16 ? 6e-3f : 1e-4f, preset);
            ofHq += glm::length(hq[i][Term::lightmap] - light);
            ofLq += glm::length(lq[i][Term::lightmap] - light);
          }
          EXPECT_GT(ofLq, 4 * ofHq) << preset << ", alpha " << alpha;
        }
  }
}

// What the mixing weight of captures is made from.
TEST_F(LightmapFormTest, OfHighQualityGivesTheLuminanceOfItsIrradiance) {
  const scenes::Scene scene = makeLitQuad();
  const lighting::BakedLight baked = makeBothForms(1);
  paths::Store store;
  const std::vector<ShadedPixel> exact = shadeHighend(scene, baked, store),
                                 shown = shadeMobile(inForm("ue4-2020", LightmapForm::hq), scene, baked, store,
                                                     {.view = kViewIndirectIrradiance});
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const glm::vec3 overPi = exact[i][Term::lightmap] / (kFormBase * (1 - kFormMetallic));
    tests::expectNear(shown[i].color, glm::vec3(f32::luminanceUE4({overPi.x, overPi.y, overPi.z})), 1e-4f,
                      "IndirectIrradiance");
  }
}

// The high-end path's has no light of stationary lights, which nothing else of the mobile path has.
TEST_F(LightmapFormTest, WithStationaryLocalLightsTheLowQualityStays) {
  lighting::BakedLight baked = makeBothForms(1);
  baked.localLights = lighting::LocalLights::isStationary;
  for (const bool hasLamp : {false, true}) {
    scenes::Scene scene = makeLitQuad();
    scene.lights.push_back(tests::makeDirectional({0, 0, 1}, glm::vec3(1)));
    if (hasLamp) scene.lights.emplace_back().kind = scenes::LightKind::point;
    paths::Store store;
    const std::vector<ShadedPixel> lq = shadeMobile(inForm("ue4-2020", LightmapForm::lq), scene, baked, store, {});
    EXPECT_TRUE(m_notes.empty());
    const std::vector<ShadedPixel> hq = shadeMobile(inForm("ue4-2020", LightmapForm::hq), scene, baked, store, {});
    EXPECT_EQ(m_notes.size(), hasLamp ? 1u : 0u);
    bool isSame = true;
    for (std::size_t i = 0; i < lq.size(); ++i) isSame &= lq[i].color == hq[i].color;
    EXPECT_EQ(isSame, hasLamp);
  }
}

} // namespace
} // namespace parity::mobile

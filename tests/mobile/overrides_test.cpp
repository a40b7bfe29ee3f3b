// The overrides of material quality: a material under them is shaded as one that says so itself, bit for bit, for the
// same price.
#include "support/path_quad.h"

#include "gpu/spirv/spirv_cost.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using tests::ShadedPoint;

class MobileOverridesTest : public tests::DeviceTest {
protected:
  ShadedPoint shade(const scenes::Scene& scene, const Options& options) {
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs(), options);
    });
  }
  Inputs inputs() const {
    return {.environment = &*m_sky, .lights = {tests::makeDirectional({0.5f, 0.2f, 1}, {2, 1, 0.5f})}, .terms = true};
  }
  gpu::ShaderCost costOf(const scenes::Scene& scene, const Options& options) {
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, 8, 8);
    const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
    Inputs plain = inputs();
    plain.terms = false;
    const Renderer renderer(device(), buffers, pass.binKinds(), plain, options);
    renderer.shade(pass.render(camera, {0, 8}, glm::vec2(0.5f)).front(), camera);
    const gpu::CompiledPermutation& compiled = renderer.pass().compiled().at(0);
    const gpu::ShaderCost cost = gpu::costOf(renderer.pass().spirv(), compiled.constants);
    EXPECT_EQ(cost.samplers(), renderer.countSamplers(compiled.permutation));
    return cost;
  }
  void SetUp() override {
    DeviceTest::SetUp();
    if (!IsSkipped()) m_sky.emplace(tests::makeRedTowardsX(device()));
  }

private:
  std::optional<gpu::EnvironmentMaps> m_sky;
};

scenes::Scene makeMetal() {
  scenes::Scene scene = tests::makeLeaningQuad(0.6f);
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.9f, 0.6f, 0.3f, 1);
  m.metallic = 0.7f;
  m.roughness = 0.3f;
  m.coat = 0.8f;
  m.transmission = 0.3f;
  m.anisotropy = 0.5f;
  return scene;
}

void expectSame(const ShadedPoint& a, const ShadedPoint& b) {
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.terms, b.terms);
}

TEST_F(MobileOverridesTest, FullyRoughIsTheMaterialsOwnFlagInLookAndPrice) {
  for (const auto& [preset, precision] : {std::pair{"ue4-2020", Precision::fp32}, {"refit", Precision::fp16}}) {
    Options plain = tests::inFp32(preset), override = plain;
    plain.precision = override.precision = precision;
    override.fullyRough = true;
    scenes::Scene flagged = makeMetal();
    flagged.materials[0].fullyRough = true;
    expectSame(shade(makeMetal(), override), shade(flagged, plain));
    const gpu::ShaderCost a = costOf(makeMetal(), override), b = costOf(flagged, plain);
    EXPECT_EQ(a.operations(), b.operations()) << preset;
    EXPECT_EQ(a.fetches(), b.fetches()) << preset;
    EXPECT_LT(a.operations(), costOf(makeMetal(), plain).operations());
  }
}

TEST_F(MobileOverridesTest, NonmetalIsAMaterialWithoutMetalInLookAndPrice) {
  for (const auto& [preset, precision] : {std::pair{"ue4-2020", Precision::fp32}, {"refit", Precision::fp16}}) {
    Options plain = tests::inFp32(preset), override = plain;
    plain.precision = override.precision = precision;
    override.nonmetal = true;
    scenes::Scene metal = makeMetal(), none = makeMetal();
    for (scenes::Scene* scene : {&metal, &none}) {
      scene->materials[0].coat = scene->materials[0].transmission = scene->materials[0].anisotropy = 0;
    }
    metal.materials[0].specular = 0.5f; // its F0 is overridden, too
    none.materials[0].metallic = 0;
    ASSERT_TRUE(none.materials[0].isNonmetal());
    expectSame(shade(metal, override), shade(none, plain));
    EXPECT_LE(costOf(metal, override).operations(), costOf(none, plain).operations() + 3) << preset;
    EXPECT_LT(costOf(metal, override).operations(), costOf(metal, plain).operations()) << preset;
  }
}

} // namespace
} // namespace parity::mobile

// What the mobile path's shaders cost on the built-in scenes: the article's 8 samplers, whatever the preset.
#include <cstdio>
#include <map>

#include "support/path_quad.h"

#include "gpu/spirv/spirv_cost.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "mobile/sampler_rule.h"
#include "scenes/builtin/builtin.h"
#include "scenes/view.h"

namespace parity::mobile {
namespace {

using MobileCostTest = tests::DeviceTest;

// The widest permutation, which serves all materials of a scene, reads whatever an exact one would.
TEST_F(MobileCostTest, EveryPermutationOfEveryBuiltInSceneHasAtMostEightSamplers) {
  constexpr std::uint32_t kSize = 16;
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  std::map<std::vector<std::uint32_t>, gpu::ShaderCost> costs; // scenes share permutations
  std::size_t count = 0;
  for (const std::string& name : scenes::builtinSceneNames()) {
    const scenes::Scene scene = scenes::makeBuiltinScene(name);
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kSize, kSize);
    const scenes::Camera camera = scenes::makeCamera(scene, {}, 1);
    const std::vector<gpu::Surface> layers = pass.render(camera, {0, kSize}, glm::vec2(0.5f));
    const gpu::Surface& surface = layers.front();
    std::vector<scenes::Light> lights = scene.lights;
    lights.push_back(tests::makeDirectional({1, 1, 1}, glm::vec3(1)));
    for (const std::string& preset : presetNames()) {
      Inputs inputs;
      inputs.environment = &environment;
      inputs.lights = lights;
      const Renderer renderer(device(), buffers, pass.binKinds(), inputs, tests::inFp32(preset.c_str()));
      renderer.shade(surface, camera);
      for (const gpu::CompiledPermutation& each : renderer.pass().compiled()) {
        if (!costs.contains(each.constants))
          costs[each.constants] = gpu::costOf(renderer.pass().spirv(), each.constants);
        const gpu::ShaderCost& cost = costs[each.constants];
        EXPECT_EQ(cost.samplers(), renderer.countSamplers(each.permutation)) << name << ", " << preset;
        EXPECT_LE(cost.samplers(), kMaxSamplers) << name << ", " << preset;
        EXPECT_EQ(cost.openLoops, 0u) << name << ", " << preset;
        EXPECT_GT(cost.operations(), (each.permutation.mustFeatures & gpu::kFeatureUnlit) != 0 ? 0u : 100u) << name;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 0u);
  EXPECT_GT(costs.size(), presetNames().size());
}

// The preset refit against the base pass, permutation by permutation, each with and without sun, lamp and environment.
// Under an environment alone the base pass has no mixing weight to compute: a skylight's reflection has none.
TEST_F(MobileCostTest, RefitTakesNoMoreFetchesAndAboutAQuarterMoreOperationsThanUe4) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
  for (const bool nonmetal : {false, true})
    for (const int light : {1, 2, 3, 7}) {
      scenes::Scene scene = tests::makeQuadScene();
      scene.materials[0].metallic = nonmetal ? 0.f : 0.5f;
      const gpu::SceneBuffers buffers(device(), scene);
      const gpu::SurfacePass pass(device(), buffers, 8, 8);
      const std::vector<gpu::Surface> layers = pass.render(camera, {0, 8}, glm::vec2(0.5f));
      const gpu::Surface& surface = layers.front();
      Inputs inputs;
      if (light & 1) inputs.environment = &environment;
      if (light & 2) inputs.lights.push_back(tests::makeDirectional({1, 1, 1}, glm::vec3(1)));
      if (light & 4) {
        scenes::Light& lamp = inputs.lights.emplace_back();
        lamp.position = {0, 0, 2};
      }
      const auto costOf = [&](const char* preset) {
        const Renderer renderer(device(), buffers, pass.binKinds(), inputs, tests::inFp32(preset));
        renderer.shade(surface, camera);
        return gpu::costOf(renderer.pass().spirv(), renderer.pass().compiled().at(0).constants);
      };
      const gpu::ShaderCost ue4 = costOf("ue4-2020"), refit = costOf("refit");
      std::printf("%s, lights %d: %.0f %.0f\n", nonmetal ? "nonmetals" : "any", light,
                  static_cast<double>(ue4.operations()), static_cast<double>(refit.operations()));
      EXPECT_LE(static_cast<double>(refit.operations()), 1.25 * static_cast<double>(ue4.operations()))
          << "nonmetal " << nonmetal << ", light " << light << ": " << refit.operations() << " / " << ue4.operations();
      EXPECT_LE(refit.fetches(), ue4.fetches());
      EXPECT_LE(refit.samplers(), ue4.samplers());
    }
}

// The environment is bound by the others, and read by none of these.
TEST_F(MobileCostTest, AFullyRoughMaterialPaysForNoEnvironmentFetch) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  const auto costOf = [&](bool fullyRough) {
    scenes::Scene scene = tests::makeQuadScene();
    scene.materials[0].metallic = 0.5f;
    scene.materials[0].fullyRough = fullyRough;
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, 8, 8);
    const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
    Inputs inputs;
    inputs.environment = &environment;
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, tests::inFp32("ue4-2020"));
    renderer.shade(pass.render(camera, {0, 8}, glm::vec2(0.5f)).front(), camera);
    EXPECT_EQ(renderer.pass().compiled().size(), 1u);
    EXPECT_EQ(renderer.pass().compiled().at(0).entries, 64u);
    return gpu::costOf(renderer.pass().spirv(), renderer.pass().compiled().at(0).constants);
  };
  const gpu::ShaderCost plain = costOf(false), rough = costOf(true);
  EXPECT_EQ(plain.fetches(), 1u);
  EXPECT_EQ(plain.samplers(), 1u);
  EXPECT_EQ(rough.fetches(), 0u);
  EXPECT_LT(rough.operations(), plain.operations());
}

} // namespace
} // namespace parity::mobile

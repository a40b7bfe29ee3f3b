// Lists of lights leave out nothing that a pixel sees, and nearly all that it does not.
#include "support/device.h"
#include "support/shaded_values.h"
#include "support/small_scenes.h"

#include <cmath>
#include <random>
#include <set>

#include "gpu/surface/surface_pass.h"
#include "highend/light_culling.h"
#include "highend/renderer.h"
#include "scenes/builtin/shapes.h"

namespace parity::highend {
namespace {

constexpr std::uint32_t kCulledSide = 128;

// Spheres of two materials over a plane, seen in perspective from above.
struct Field {
  scenes::Scene scene;
  scenes::Camera camera = tests::makeFrontCamera(5, 12, false);
  Field() {
    scene.meshes = {tests::makeQuad(0), scenes::makeSphere(0.5, 24, 12)};
    scene.meshes[1].material = 1;
    scene.materials.resize(2);
    scene.materials[0].doubleSided = true;
    scene.materials[0].roughness = 0.6f;
    scene.materials[1].metallic = 1;
    scene.materials[1].roughness = 0.3f;
    scene.materials[1].unlit = false;
    scene.instances.push_back(
        {0, glm::mat4(glm::vec4(6, 0, 0, 0), glm::vec4(0, 6, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1)),
         "plane"});
    for (int i = 0; i < 25; ++i)
      scene.instances.push_back(
          {1, tests::translation(2.f * static_cast<float>(i % 5) - 4, 2.f * static_cast<float>(i / 5) - 4, 0.3f),
           "ball"});
    scene.name = "field";
  }
};

// A mix of all kinds, ranges and cones about the field; the first ones reach everything.
std::vector<scenes::Light> makeLights(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1), side(-6, 6);
  std::vector<scenes::Light> lights(count);
  for (std::size_t i = 0; i < count; ++i) {
    scenes::Light& light = lights[i];
    light.color = glm::vec3(unit(random), unit(random), unit(random)) + 0.1f;
    light.position = {side(random), side(random), 3 * unit(random)};
    light.range = i % 7 == 3 ? 0.f : 0.2f + 1.5f * unit(random);
    light.direction = glm::normalize(glm::vec3(side(random), side(random), -0.1f - 6 * unit(random)));
    light.kind = i % 3 == 1    ? scenes::LightKind::spot
                 : i % 50 == 2 ? scenes::LightKind::directional
                               : scenes::LightKind::point;
    light.outerConeAngle = 0.02f + 1.5f * unit(random);
    light.innerConeAngle = light.outerConeAngle * unit(random) * 0.99f;
  }
  return lights;
}

class LightCullingTest : public tests::DeviceTest {
protected:
  gpu::ShadedSurface shade(const std::vector<scenes::Light>& lights, bool cull, const gpu::PermutationBudget& budget) {
    const gpu::SceneBuffers buffers(device(), m_field.scene);
    const gpu::SurfacePass pass(device(), buffers, kCulledSide, kCulledSide);
    const auto surfaces = pass.render(m_field.camera, {0, kCulledSide}, glm::vec2(0.5f));
    Inputs inputs;
    inputs.lights = lights;
    inputs.terms = true;
    inputs.cullLights = cull;
    inputs.compilation.budget = budget;
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, m_options);
    return renderer.shade(surfaces.front(), m_field.camera);
  }
  void expectSame(const gpu::ShadedSurface& a, const gpu::ShadedSurface& b) {
    ASSERT_EQ(a.color.size(), b.color.size());
    EXPECT_GT(a.color.size(), 10000u);
    EXPECT_TRUE(tests::haveSameBits(a.color, b.color));
    for (std::size_t t = 0; t < a.terms.size(); ++t) EXPECT_TRUE(tests::haveSameBits(a.terms[t], b.terms[t])) << t;
  }
  Field m_field;
  Options m_options{.model = {.diffuse = DiffuseLobe::lambert}, .compensation = Compensation::none};
};

TEST_F(LightCullingTest, LeavesThePictureAsItIsToTheLastBit) {
  for (const auto& budget : {gpu::PermutationBudget{}, gpu::PermutationBudget{.own = 0, .shares = true}})
    for (const std::size_t count : {9u, 70u, 500u}) {
      const auto lights = makeLights(count, static_cast<std::uint32_t>(count));
      expectSame(shade(lights, true, budget), shade(lights, false, budget));
    }
}

TEST_F(LightCullingTest, LeavesThePictureOfOneKindOfLightAsItIs) {
  for (const auto kind : {scenes::LightKind::point, scenes::LightKind::spot}) {
    auto lights = makeLights(40, 5);
    for (scenes::Light& light : lights) light.kind = kind;
    expectSame(shade(lights, true, {}), shade(lights, false, {}));
  }
}

// Lights are reordered on their way to the device: each kind is left out by its place in the list that was given,
// with lists of lights and, of few, without.
TEST_F(LightCullingTest, ALightThatIsLeftOutIsTheOneAskedForAndComesBack) {
  const gpu::SceneBuffers buffers(device(), m_field.scene);
  const gpu::SurfacePass pass(device(), buffers, kCulledSide, kCulledSide);
  const auto surfaces = pass.render(m_field.camera, {0, kCulledSide}, glm::vec2(0.5f));
  for (const std::size_t count : {6u, 70u}) {
    std::vector<scenes::Light> lights = makeLights(count, 3);
    lights[1].position = {0, 0, 3}; // the spot, where it is seen
    lights[1].direction = {0, 0, -1};
    lights[1].range = 10;
    Inputs inputs;
    inputs.lights = lights;
    inputs.terms = true;
    Renderer renderer(device(), buffers, pass.binKinds(), inputs, m_options);
    const auto shadeAll = [&] { return renderer.shade(surfaces.front(), m_field.camera); };
    const gpu::ShadedSurface whole = shadeAll();
    std::set<scenes::LightKind> kinds;
    for (const std::size_t off : std::array<std::size_t, 4>{0, 1, 2, 3}) { // 2 is directional, 3 has no range
      kinds.insert(lights[off].kind);
      std::vector<scenes::Light> others = lights;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(off));
      const gpu::ShadedSurface wanted = shade(others, true, {});
      renderer.leaveOut(std::span(&off, 1));
      const gpu::ShadedSurface without = shadeAll();
      ASSERT_EQ(without.color.size(), wanted.color.size());
      double differs = 0, worst = 0; // from all lights; from the renderer without it
      for (std::size_t i = 0; i < wanted.color.size(); ++i)
        for (int c = 0; c < 3; ++c) {
          differs = std::max(differs, std::abs(1.0 * without.color[i][c] - whole.color[i][c]));
          worst = std::max(worst, std::abs(1.0 * without.color[i][c] - wanted.color[i][c]) / (wanted.color[i][c] + 1));
        }
      EXPECT_GT(differs, 1e-4) << off;
      EXPECT_LT(worst, 1e-6) << off; // another loop may be rounded otherwise
    }
    renderer.leaveOut({});
    EXPECT_EQ(kinds.size(), 3u);
    expectSame(shadeAll(), whole);
  }
}

// Compiling shades nothing, so it lists no lights and counts no entries.
TEST_F(LightCullingTest, CompilingMakesNoListsAndChangesNoPicture) {
  const gpu::SceneBuffers buffers(device(), m_field.scene);
  const gpu::SurfacePass pass(device(), buffers, kCulledSide, kCulledSide);
  const auto surfaces = pass.render(m_field.camera, {0, kCulledSide}, glm::vec2(0.5f));
  const auto entriesOf = [](const Renderer& renderer) {
    std::uint64_t entries = 0;
    for (const gpu::CompiledPermutation& each : renderer.pass().compiled()) entries += each.entries;
    return entries;
  };
  const Inputs inputs{.lights = makeLights(70, 3), .terms = true};
  const Renderer renderer(device(), buffers, pass.binKinds(), inputs, m_options),
      other(device(), buffers, pass.binKinds(), inputs, m_options);
  renderer.pass().compile(surfaces.front(), m_field.camera);
  EXPECT_FALSE(renderer.pass().compiled().empty());
  EXPECT_EQ(entriesOf(renderer), 0u);
  EXPECT_EQ(renderer.work().lightLists, 0u);
  expectSame(renderer.shade(surfaces.front(), m_field.camera), other.shade(surfaces.front(), m_field.camera));
  EXPECT_EQ(entriesOf(renderer), surfaces.front().size());
  EXPECT_GT(renderer.work().lightLists, 0u);
  EXPECT_EQ(renderer.work().lightLists, other.work().lightLists);
}

TEST_F(LightCullingTest, ListsWhatReachesAPixelAndLittleElse) {
  const gpu::SceneBuffers buffers(device(), m_field.scene);
  const gpu::SurfacePass pass(device(), buffers, kCulledSide, kCulledSide);
  const auto surfaces = pass.render(m_field.camera, {0, kCulledSide}, glm::vec2(0.5f));
  const gpu::Surface& surface = surfaces.front();
  std::vector<scenes::Light> lights = makeLights(600, 11);
  std::erase_if(lights, [](const auto& l) { return l.kind == scenes::LightKind::directional || l.range == 0; });
  std::vector<gpu::GpuLight> packed;
  for (const scenes::Light& light : lights) packed.push_back(gpu::packLight(light));
  constexpr std::uint32_t kOthers = 2; // that reach everything, before them
  packed.insert(packed.begin(), kOthers, gpu::GpuLight{});

  const LightCulling culling(device(), packed, kOthers);
  const gpu::Buffer lists = culling.listsFor(surface, {1, static_cast<std::uint32_t>(packed.size()) - 1, 0, 0});
  const auto words = lists.downloadAs<std::uint32_t>(lists.size() / sizeof(std::uint32_t));
  EXPECT_EQ(words[1], kOthers - 1) << "local lights that are not listed";
  const std::span<const std::uint32_t> data = std::span(words).subspan(4);
  EXPECT_EQ(data[0], 1u);

  const auto positions = surface.position.downloadAs<glm::vec4>(surface.size());
  std::size_t group = 0, listed = 0, reached = 0;
  for (const gpu::Bin& bin : surface.bins)
    for (std::uint32_t first = 0; first < bin.count; first += gpu::kGroupSize, ++group) {
      const auto list = data.subspan(data[1 + group], data[2 + group] - data[1 + group]);
      ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));
      const std::uint32_t end = std::min(bin.count, first + gpu::kGroupSize);
      listed += list.size() * (end - first);
      for (std::uint32_t i = bin.first + first; i < bin.first + end; ++i)
        for (std::uint32_t k = 0; k < lights.size(); ++k) {
          const glm::dvec3 d = glm::dvec3(lights[k].position) - glm::dvec3(positions[i]);
          const double angle = std::acos(glm::dot(-glm::normalize(d), glm::dvec3(lights[k].direction)));
          if (glm::length(d) >= lights[k].range) continue;
          if (lights[k].kind == scenes::LightKind::spot && angle >= lights[k].outerConeAngle) continue;
          ++reached;
          ASSERT_TRUE(std::binary_search(list.begin(), list.end(), k + kOthers)) << "light " << k << " at entry " << i;
        }
    }
  EXPECT_EQ(data[1 + group], data.size()) << "the lists fill the buffer";
  EXPECT_GT(reached, surface.size());
  EXPECT_LT(listed, 3 * reached) << "of " << lights.size() * surface.size();
}

TEST_F(LightCullingTest, TakesAHundredThousandLightsAndSaysWhereTooManyReachAPixel) {
  const gpu::SceneBuffers buffers(device(), m_field.scene);
  const gpu::SurfacePass pass(device(), buffers, kCulledSide, kCulledSide);
  const auto surfaces = pass.render(m_field.camera, {0, kCulledSide}, glm::vec2(0.5f));
  scenes::Light light;
  light.color = glm::vec3(1);
  light.range = 0.05f;
  std::vector<gpu::GpuLight> lights(140000);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    light.position = {static_cast<float>(i % 400) / 40 - 5, static_cast<float>(i / 400) / 40 - 5, 0.f};
    lights[i] = gpu::packLight(light);
  }
  const std::array<std::uint32_t, 4> counts = {0, static_cast<std::uint32_t>(lights.size()), 0, 0};
  const gpu::Buffer lists = LightCulling(device(), lights, 0).listsFor(surfaces.front(), counts);
  EXPECT_LT(lists.size(), std::size_t{4} << 20);
  const auto words = lists.downloadAs<std::uint32_t>(lists.size() / sizeof(std::uint32_t));
  EXPECT_GT(*std::max_element(words.begin() + 300, words.end()), 120000u) << "the last lights are asked, too";

  const auto refusal = [&](const gpu::GpuLight& each, std::size_t count) {
    try {
      const std::vector<gpu::GpuLight> many(count, each);
      LightCulling(device(), many, 0).listsFor(surfaces.front(), {0, static_cast<std::uint32_t>(count), 0, 0});
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::failed);
      return std::string(error.what());
    }
    return std::string();
  };
  light.range = 1000;
  EXPECT_NE(refusal(gpu::packLight(light), 60001).find("60001 of them reach the same pixels"), std::string::npos);
  EXPECT_EQ(refusal(gpu::packLight(light), 1000), "");
}

TEST_F(LightCullingTest, RefusesMoreLightsThatReachEverythingThanALoopMayHave) {
  const gpu::SceneBuffers buffers(device(), m_field.scene);
  const gpu::SurfacePass pass(device(), buffers, kCulledSide, kCulledSide);
  Inputs inputs;
  inputs.lights.resize(60001); // points without a range
  EXPECT_THROW(Renderer(device(), buffers, pass.binKinds(), inputs, m_options), base::Error);
}

} // namespace
} // namespace parity::highend

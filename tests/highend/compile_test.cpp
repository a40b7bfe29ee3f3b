// What the driver compiles: ahead of shading, and for a shader without terms.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>
#include <tuple>

#include "base/temp_folder.h"
#include "highend/highend_quad.h"
#include "support/shaded_values.h"

namespace parity::highend {
namespace {

using tests::makeConstantEnvironment, tests::makeQuadScene;

class CompileTest : public tests::DeviceTest {
protected:
  void SetUp() override {
    setenv("MESA_SHADER_CACHE_DIR", m_folder.path().c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
    DeviceTest::SetUp();
    if (!IsSkipped() && device().report().kind != "cpu") GTEST_SKIP() << "counts what Mesa's software driver keeps";
  }
  // The driver writes its files from another thread: until half a second has brought none.
  std::size_t countCompiled() const {
    std::size_t before = 0;
    for (int round = 0; round < 40; ++round) {
      std::size_t files = 0;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(m_folder.path()))
        files += entry.is_regular_file() && entry.path().filename() != "index";
      if (round > 0 && files == before) return files;
      before = files;
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
    ADD_FAILURE() << "the driver goes on writing";
    return before;
  }

  base::TempFolder m_folder;
};

TEST_F(CompileTest, AheadIsWhatShadingNeedsAndRunsNothing) {
  constexpr std::uint32_t kSize = 8;
  const scenes::Scene scene = makeQuadScene();
  const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
  const gpu::SceneBuffers buffers(device(), scene, gpu::SpecularAa::off);
  const gpu::SurfacePass pass(device(), buffers, kSize, kSize);
  const gpu::Surface surface = std::move(pass.render(camera, {0, kSize}, glm::vec2(0.5f)).back());
  const gpu::EnvironmentMaps sky = makeConstantEnvironment(device(), 1);
  const base::Image lut = constantLut(0.5f, 0.1f);
  Inputs inputs{.environment = &sky, .lut = &lut, .lights = {}};
  inputs.compilation.store = &pipelines();
  const Renderer ahead(device(), buffers, pass.binKinds(), inputs, {});
  const std::size_t before = countCompiled();
  ahead.pass().compile(surface, camera);
  const std::size_t compiled = countCompiled();
  EXPECT_EQ(compiled, before + 1);

  inputs.compilation.plan = ahead.pass().plan();
  const Renderer renderer(device(), buffers, pass.binKinds(), inputs, {});
  const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
  ASSERT_EQ(shaded.color.size(), surface.size());
  EXPECT_GT(shaded.color[0].x, 0);
  EXPECT_EQ(countCompiled(), compiled) << "it was compiled already";
  EXPECT_EQ(pipelines().keys().size(), 1u);
}

// A quad that is rasterised.
struct QuadView {
  explicit QuadView(const gpu::Device& device, scenes::Scene s = makeQuadScene(), std::uint32_t size = 8)
      : scene(std::move(s)), buffers(device, scene, gpu::SpecularAa::off), pass(device, buffers, size, size),
        surface(std::move(pass.render(camera, {0, size}, glm::vec2(0.5f)).back())) {}
  scenes::Scene scene;
  scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
  gpu::SceneBuffers buffers;
  gpu::SurfacePass pass;
  gpu::Surface surface;
};

TEST_F(CompileTest, ConstantsWithoutTermsAreThoseOfAShaderThatWritesNone) {
  const QuadView quad(device());
  const auto compiledBy = [&](bool terms) {
    Inputs inputs{.lights = {tests::makeDirectional(glm::vec3(0, 0, 1), glm::vec3(1))}, .terms = terms};
    const Renderer renderer(device(), quad.buffers, quad.pass.binKinds(), inputs, kPlain);
    renderer.shade(quad.surface, quad.camera);
    return renderer.pass().compiled().front();
  };
  const gpu::CompiledPermutation with = compiledBy(true), without = compiledBy(false);
  EXPECT_NE(with.constants, without.constants);
  EXPECT_EQ(with.constantsWithoutTerms(), without.constants);
  EXPECT_EQ(without.constantsWithoutTerms(), without.constants);
}

// Two halves of the picture: on the right a textured material, on the left glass without a texture.
scenes::Scene makeGlassBesideTexture(int side, scenes::Wrap wrap) {
  scenes::Scene scene = makeQuadScene();
  scene.instances[0].toWorld = tests::translation(1, 0, 0);
  scene.meshes.push_back(tests::makeQuad(1));
  scene.instances.push_back({1, tests::translation(-1, 0, 0), "glass"});
  scene.images.emplace_back().pixels = base::Image8(side, side, 4, 255);
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[0].baseColorTexture.sampler.wrapU = scene.materials[0].baseColorTexture.sampler.wrapV = wrap;
  scenes::Material& glass = scene.materials.emplace_back();
  glass.name = "glass";
  glass.metallic = 0;
  glass.transmission = 1;
  return scene;
}

// lavapipe compiles a shader anew for each kind of image: what stands for a texture or for the picture behind is of the
// kind of what may stand in its place.
TEST_F(CompileTest, OneShaderServesMaterialsWithTexturesAndWithoutBehindGlassAndBefore) {
  const base::Image lut = constantLut(0.5f, 0.1f);
  for (const auto& [side, wrap, pictureSize] :
       {std::tuple(4, scenes::Wrap::repeat, 8u), std::tuple(6, scenes::Wrap::clampToEdge, 6u)}) {
    const QuadView view(device(), makeGlassBesideTexture(side, wrap), pictureSize);
    Inputs inputs{.lut = &lut, .transmits = true, .lights = {tests::makeDirectional({0, 0, 1}, glm::vec3(1))}};
    inputs.compilation.store = &pipelines();
    Renderer renderer(device(), view.buffers, view.pass.binKinds(), inputs, {});
    ASSERT_EQ(view.surface.bins.size(), 2u) << "both are seen";
    const std::size_t before = countCompiled();
    renderer.shade(view.surface, view.camera);
    gpu::BackdropBuilder behind(pictureSize, pictureSize, 1);
    behind.lay(view.surface, view.camera, std::vector<glm::vec4>(view.surface.size(), glm::vec4(1)));
    const gpu::Backdrop backdrop = behind.take(device());
    renderer.setBackdrop(&backdrop);
    renderer.shade(view.surface, view.camera);
    EXPECT_EQ(countCompiled(), before + 1) << side;
  }
}

// A lobe is hidden by the shader that shows it where other materials of the shader lack it.
TEST_F(CompileTest, LobesAreHiddenByShadersThatAreThere) {
  const base::Image lut = constantLut(0.5f, 0.1f), sheen(2, 2, 1, 0.3f);
  const gpu::EnvironmentMaps sky = makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeQuadScene();
  scene.materials.push_back(scene.materials[0]);
  scene.materials[0].sheenColor = {0.8f, 0.4f, 0.2f};
  scene.materials[0].coat = scene.materials[1].coat = 0.5f;
  scenes::Scene alone = scene; // every material has the sheen
  alone.materials.pop_back();
  scene.meshes.push_back(tests::makeQuad(1)); // beside the other
  scene.instances[0].toWorld = tests::translation(1, 0, 0);
  scene.instances.push_back({1, tests::translation(-1, 0, 0), "other"});
  scenes::Scene bare = scene;
  bare.materials[0].sheenColor = glm::vec3(0);

  struct Shaded {
    std::vector<glm::vec4> color;
    std::shared_ptr<gpu::PermutationPlan> plan;
    std::size_t shaders = 0; // that the run has, all told
  };
  const auto shade = [&](const QuadView& view, std::uint32_t hidden, const Shaded& plain, bool terms) {
    Inputs inputs{.environment = &sky,
                  .lut = &lut,
                  .sheenTable = &sheen,
                  .lights = {tests::makeDirectional({0.5f, 0.3f, 1}, glm::vec3(2))},
                  .terms = terms,
                  .hiddenFeatures = hidden};
    inputs.compilation = {.budget = {}, .store = &pipelines(), .plan = plain.plan, .planWritesTerms = hidden != 0};
    const Renderer renderer(device(), view.buffers, view.pass.binKinds(), inputs, {});
    const gpu::ShadedSurface shaded = renderer.shade(view.surface, view.camera);
    EXPECT_EQ(shaded.terms.empty(), !terms);
    return Shaded{tests::valuesOf(shaded.color), renderer.pass().plan(), pipelines().keys().size()};
  };
  const QuadView view(device(), scene);
  ASSERT_EQ(view.surface.bins.size(), 2u) << "both are seen";
  const Shaded plain = shade(view, 0, {}, true);
  EXPECT_EQ(plain.plan->of(view.buffers.classOfMaterial()[0]).mustFeatures & gpu::kFeatureLobes, gpu::kFeatureCoat);
  const Shaded hidden = shade(view, gpu::kFeatureSheen, plain, false);
  EXPECT_EQ(hidden.shaders, plain.shaders) << "that of the picture with terms";
  const Shaded expected = shade(QuadView(device(), bare), 0, {}, false);
  EXPECT_GT(expected.shaders, hidden.shaders);
  EXPECT_EQ(hidden.color, expected.color);
  EXPECT_NE(plain.color, expected.color);

  const QuadView aloneView(device(), alone);
  const Shaded plainAlone = shade(aloneView, 0, {}, true),
               hiddenAlone = shade(aloneView, gpu::kFeatureSheen, plainAlone, false);
  EXPECT_EQ(hiddenAlone.color.front(), expected.color.front()) << "by a shader without the sheen, and without terms";
  EXPECT_EQ(hiddenAlone.shaders, plainAlone.shaders) << "that of the bare scene";
}

// A bit for each term in the constant of path.glsl: others are 0 everywhere, and nobody reads what is not written.
TEST_F(CompileTest, ShadersWriteTheTermsThatTheSceneMayHave) {
  const QuadView quad(device());
  constexpr std::size_t kConstantTerms = 6;
  const auto bitsOf = [](std::initializer_list<shading::Term> terms) {
    std::uint32_t bits = 0;
    for (const shading::Term term : terms) bits |= 1u << static_cast<std::uint32_t>(term);
    return bits;
  };
  using shading::Term;
  const std::uint32_t ofLobes = bitsOf({Term::coatSpecular, Term::sheen, Term::transmission});
  const auto expectWritten = [&](const std::vector<scenes::Light>& lights, std::uint32_t expected) {
    const Renderer renderer(device(), quad.buffers, quad.pass.binKinds(), {.lights = lights, .terms = true}, kPlain);
    const gpu::ShadedSurface shaded = renderer.shade(quad.surface, quad.camera);
    EXPECT_EQ(renderer.pass().compiled().front().constants.at(kConstantTerms), expected | ofLobes);
    ASSERT_EQ(shaded.terms.size(), shading::kBaseTermCount);
    for (std::size_t i = 0; i < quad.surface.size(); ++i) { // a term that is missing would be missing in the sum
      glm::vec4 sum(0);
      for (const gpu::ShadedPlane& term : shaded.terms) sum += term[i];
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], shaded.color[i][c], 1e-6f) << i;
    }
  };
  const scenes::Light sun = tests::makeDirectional(glm::vec3(0, 0, 1), glm::vec3(1));
  scenes::Light lamp;
  lamp.kind = scenes::LightKind::point;
  lamp.position = {0, 0, 1};
  lamp.color = glm::vec3(1);
  const std::uint32_t ofSun = bitsOf({Term::sunDiffuse, Term::sunSpecular}),
                      ofLamp = bitsOf({Term::localDiffuse, Term::localSpecular}), always = bitsOf({Term::emissive});
  expectWritten({}, always);
  expectWritten({sun}, ofSun | always);
  expectWritten({lamp}, ofLamp | always);
  expectWritten({sun, lamp}, ofSun | ofLamp | always);
}

} // namespace
} // namespace parity::highend

// Pictures that lack a light each, shaded at once, are those that are shaded one by one.
#include "support/device.h"
#include "support/path_quad.h"
#include "support/small_scenes.h"

#include <set>

#include "gpu/surface/other_terms.h"
#include "gpu/surface/surface_pass.h"
#include "highend/renderer.h"
#include "scenes/builtin/shapes.h"

namespace parity::highend {
namespace {

constexpr std::uint32_t kLeftOutSide = 96;

// Balls over a plane in fog: a plain one, an unlit one, one that is seen through; with lobes a coated one with fibres,
// and one that light passes.
struct Balls {
  scenes::Scene scene;
  scenes::Camera camera = tests::makeFrontCamera(5, 12, false);
  explicit Balls(bool withLobes) {
    scene.meshes = {tests::makeQuad(0)};
    scene.materials.resize(withLobes ? 6 : 4);
    scene.materials[0].roughness = 0.6f;
    scene.materials[1].metallic = 1;
    scene.materials[1].roughness = 0.3f;
    scene.materials[2].unlit = true;
    scene.materials[3].alphaMode = scenes::AlphaMode::blend;
    scene.materials[3].baseColor.w = 0.4f;
    if (withLobes) {
      scene.materials[4].coat = 0.8f;
      scene.materials[4].sheenColor = glm::vec3(0.4f, 0.3f, 0.9f);
      scene.materials[4].sheenRoughness = 0.4f;
      scene.materials[5].transmission = 0.5f;
      scene.materials[5].diffuseTransmission = 0.5f;
    }
    scene.instances.push_back(
        {0, glm::mat4(glm::vec4(6, 0, 0, 0), glm::vec4(0, 6, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1)),
         "plane"});
    for (std::uint32_t m = 1; m < scene.materials.size(); ++m) {
      scene.meshes.push_back(scenes::makeSphere(0.9, 24, 12));
      scene.meshes.back().material = m;
      scene.instances.push_back({m, tests::translation(2.f * static_cast<float>(m) - 5, 0, 1), "ball"});
    }
    scene.fog = scenes::Fog{.density = 0.02f, .heightFalloff = 0.1f};
    scene.name = "balls";
  }
};

// A sun and local lights of all kinds about the balls.
std::vector<scenes::Light> makeLightsAbout(std::size_t count) {
  std::vector<scenes::Light> lights(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float turn = 2.4f * static_cast<float>(i);
    lights[i].kind = i == 1       ? scenes::LightKind::directional
                     : i % 3 == 2 ? scenes::LightKind::spot
                                  : scenes::LightKind::point;
    lights[i].color = glm::vec3(1, 0.5f + 0.1f * static_cast<float>(i % 5), 0.4f);
    lights[i].position = {3 * std::cos(turn), 3 * std::sin(turn), 2.5f - static_cast<float>(i % 2)};
    lights[i].range = i % 4 == 0 ? 0.f : 6.f;
    lights[i].direction = glm::normalize(-glm::vec3(lights[i].position) * glm::vec3(1, 1, 0.5f));
    lights[i].innerConeAngle = 0.5f;
    lights[i].outerConeAngle = 1.2f;
  }
  return lights;
}

class LeftOutTest : public tests::DeviceTest {};

void expectSamePicture(const gpu::ShadedPlane& a, const gpu::ShadedPlane& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 4; ++c)
      worst = std::max(worst, std::abs(double{a[i][c]} - double{b[i][c]}) / (std::abs(double{b[i][c]}) + 1e-3));
  EXPECT_LT(worst, 2e-6) << what; // another shader may be rounded otherwise
}

double largestDifference(const gpu::ShadedPlane& a, const gpu::ShadedPlane& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(double{a[i][c]} - double{b[i][c]}));
  return most;
}

TEST_F(LeftOutTest, EachPictureLacksItsLightAndNothingElse) {
  base::Image lut(2, 2, 4), sheen(2, 2, 1);
  for (int i = 0; i < 4; ++i) {
    const float texel[] = {0.7f, 0.05f, 0.5f, 1};
    std::copy_n(texel, 4, lut.pixels.data() + 4 * i);
    sheen.pixels[i] = 0.4f;
  }
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 0.3f);
  for (const bool withLobes : {false, true})
    for (const std::size_t count :
         withLobes ? std::vector{24u} : std::vector{6u, 24u}) { // with and without lists of them
      SCOPED_TRACE(std::to_string(count) + (withLobes ? " lights, lobes" : " lights"));
      const Balls balls(withLobes);
      const gpu::SceneBuffers buffers(device(), balls.scene);
      const gpu::SurfacePass pass(device(), buffers, kLeftOutSide, kLeftOutSide);
      const auto surfaces = pass.render(balls.camera, {0, kLeftOutSide}, glm::vec2(0.5f));
      Inputs inputs;
      inputs.environment = &sky;
      inputs.lut = &lut;
      inputs.sheenTable = withLobes ? &sheen : nullptr;
      inputs.transmits = withLobes;
      inputs.lights = makeLightsAbout(count);
      inputs.compilation.budget = {.own = 1}; // one shader for all materials
      Renderer plain(device(), buffers, pass.binKinds(), inputs, {});
      inputs.leftOut = gpu::kMaxLeftOut;
      Renderer many(device(), buffers, pass.binKinds(), inputs, {});
      std::set<std::uint32_t> seen;
      bool isSeenThrough = false;
      std::vector<double> most(gpu::kMaxLeftOut, 0); // what each light changes
      // A point, the sun, one of no range, a spot, and others for the planes of the second buffer.
      const std::vector<std::size_t> out =
          count > 6 ? std::vector<std::size_t>{3, 1, 0, 5, 2, 23, 4, 9} : std::vector<std::size_t>{3, 1, 0, 5, 2, 4};
      for (const gpu::Surface& surface : surfaces) {
        seen.insert(surface.instances.begin(), surface.instances.end());
        isSeenThrough |= surface.blended;
        const auto pictureOf = [&](std::span<const std::size_t> light) {
          plain.leaveOut(light);
          return plain.shade(surface, balls.camera).color;
        };
        const gpu::ShadedPlane whole = pictureOf({});
        many.leaveOut(out);
        const gpu::ShadedSurface shaded = many.shade(surface, balls.camera);
        EXPECT_TRUE(shaded.color.empty());
        ASSERT_EQ(shaded.terms.size(), out.size());
        for (std::size_t k = 0; k < out.size(); ++k) {
          const gpu::ShadedPlane wanted = pictureOf(std::span(out).subspan(k, 1));
          most[k] = std::max(most[k], largestDifference(wanted, whole));
          expectSamePicture(shaded.terms[k], wanted, std::to_string(out[k]));
        }
        // What was left out before is there again.
        many.leaveOut(std::span(out).subspan(1, 1));
        const gpu::ShadedSurface fewer = many.shade(surface, balls.camera);
        ASSERT_EQ(fewer.terms.size(), 1u);
        expectSamePicture(fewer.terms[0], shaded.terms[1], "one alone");
      }
      EXPECT_EQ(seen.size(), balls.scene.instances.size());
      EXPECT_TRUE(isSeenThrough);
      for (std::size_t k = 0; k < out.size(); ++k) EXPECT_GT(most[k], 1e-3) << out[k];
    }
}

// Lights alone, and the other terms of the same view: without fog the bits of the picture that was shaded whole.
TEST_F(LeftOutTest, LightsAloneAndTheOtherTermsAreTheWholePicture) {
  Balls balls(false);
  balls.scene.fog.reset();
  balls.scene.materials[0].emissive = {0.02f, 0.3f, 0.1f};
  balls.scene.materials[3].emissive = {0.4f, 0.01f, 0.03f};
  const gpu::SceneBuffers buffers(device(), balls.scene);
  const gpu::SurfacePass pass(device(), buffers, kLeftOutSide, kLeftOutSide);
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 0.3f);
  base::Image lut(2, 2, 4);
  std::ranges::fill(lut.pixels, 0.3f);
  const std::vector<std::size_t> out = {3, 1, 0, 5, 2, 4};
  for (const bool everyScene : {false, true}) {
    Inputs inputs;
    inputs.environment = &sky;
    inputs.lut = &lut;
    inputs.lights = makeLightsAbout(6);
    inputs.compilation.budget = {.own = 1, .shares = everyScene};
    inputs.terms = true;
    const Renderer byTerms(device(), buffers, pass.binKinds(), inputs, {});
    inputs.terms = false;
    inputs.leftOut = gpu::kMaxLeftOut;
    Renderer whole(device(), buffers, pass.binKinds(), inputs, {});
    inputs.lightsAlone = true;
    Renderer alone(device(), buffers, pass.binKinds(), inputs, {});
    whole.leaveOut(out);
    alone.leaveOut(out);
    double most = 0; // what the other terms add
    for (const gpu::Surface& surface : pass.render(balls.camera, {0, kLeftOutSide}, glm::vec2(0.5f))) {
      const std::vector<gpu::ShadedPlane> terms = byTerms.shade(surface, balls.camera).terms,
                                          wanted = whole.shade(surface, balls.camera).terms,
                                          lights = alone.shade(surface, balls.camera).terms;
      const std::vector<const gpu::ShadedPlane*> others = gpu::otherTerms(terms);
      EXPECT_EQ(others.size(), 2u) << "the reflected sky and emitted light: there is no map of irradiance";
      ASSERT_EQ(lights.size(), out.size());
      for (std::size_t k = 0; k < out.size(); ++k) {
        const gpu::ShadedPlane sum = gpu::withOtherTerms(lights[k], others);
        most = std::max(most, largestDifference(lights[k], wanted[k]));
        if (device().properties().deviceType == vk::PhysicalDeviceType::eCpu) {
          for (std::size_t e = 0; e < sum.size(); ++e) ASSERT_EQ(sum[e], wanted[k][e]) << out[k] << ", entry " << e;
        }
        expectSamePicture(sum, wanted[k], std::to_string(out[k]));
      }
    }
    EXPECT_GT(most, 0.1);
  }
}

} // namespace
} // namespace parity::highend

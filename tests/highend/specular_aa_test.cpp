// Specular anti-aliasing against what a picture of many more pixels shows on average.
#include <numeric>

#include "support/bumpy_quad.h"
#include "support/device.h"
#include "support/path_quad.h"

#include "highend/renderer.h"

namespace parity::highend {
namespace {

constexpr int kTexels = 256;

class SpecularAaTest : public tests::DeviceTest {
protected:
  // The quad's specular light of a sun, averaged to 8 x 8 pixels from `size` x `size`.
  std::vector<double> render(const scenes::Scene& scene, const scenes::Light& sun, std::uint32_t size,
                             gpu::SpecularAa specularAa) const {
    const gpu::SceneBuffers buffers(device(), scene, specularAa);
    const gpu::SurfacePass pass(device(), buffers, size, size);
    const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
    const std::vector<gpu::Surface> layers = pass.render(camera, {0, size}, glm::vec2(0.5f));
    const gpu::Surface& surface = layers.front();
    EXPECT_EQ(surface.size(), std::size_t{size} * size);
    Inputs inputs;
    inputs.lights = {sun};
    inputs.terms = true;
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs,
                            {.model = {.diffuse = DiffuseLobe::lambert}, .compensation = Compensation::none});
    const gpu::ShadedSurface shaded = renderer.shade(surface, camera);
    std::vector<double> means(64);
    const std::uint32_t block = size / 8;
    for (std::size_t i = 0; i < surface.size(); ++i)
      means[surface.pixels[i] / size / block * 8 + surface.pixels[i] % size / block] +=
          double(shaded.terms[static_cast<std::size_t>(shading::Term::sunSpecular)][i].x) / (block * block);
    return means;
  }
};

double relMse(const std::vector<double>& test, const std::vector<double>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double d = test[i] - truth[i];
    sum += d * d / (truth[i] * truth[i] + 1e-4) / static_cast<double>(truth.size());
  }
  return sum;
}

// From the middle of the highlight to its flank, over slopes that are as wide as the lobe or wider.
TEST_F(SpecularAaTest, PicturesOfFewPixelsComeCloserToThoseOfMany) {
  for (const double deviation : {0.15, 0.3})
    for (const float degrees : {0.f, 20.f, 45.f}) {
      const scenes::Scene scene = tests::makeBumpyQuad(kTexels, deviation, 0.4f);
      const float a = glm::radians(degrees);
      const scenes::Light sun = tests::makeDirectional({std::sin(a), 0, std::cos(a)}, glm::vec3(1));
      const std::vector<double> truth = render(scene, sun, kTexels, gpu::SpecularAa::off);
      const std::vector<double> off = render(scene, sun, 8, gpu::SpecularAa::off);
      const std::vector<double> on = render(scene, sun, 8, gpu::SpecularAa::toksvig);
      EXPECT_LT(relMse(on, truth), 0.25 * relMse(off, truth)) << deviation << ' ' << degrees;
      const auto sum = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
      EXPECT_NEAR(sum(on) / sum(truth), 1, 0.3) << deviation << ' ' << degrees;
    }
}

// What the path shows of two tilts in turn is a smooth surface of the widened roughness.
TEST_F(SpecularAaTest, PathSeesTheWidenedRoughness) {
  scenes::Scene checker = tests::makeQuadScene(), smooth = checker;
  checker.images = {tests::makeChecker(kTexels)};
  checker.materials[0].normalTexture.image = 0;
  checker.materials[0].roughness = 0.25f;
  const double tilt = 39.5 / 120.5, length = 1 / std::sqrt(1 + tilt * tilt); // codes 88, 167; 248
  smooth.materials[0].roughness = static_cast<float>(std::pow(std::pow(0.25, 4) + 2 * (1 - length) / length, 0.25));
  const Inputs inputs{.lights = {tests::makeDirectional({0.3f, 0.2f, 1}, glm::vec3(1))}, .terms = true};
  const auto shade = [&](const scenes::Scene& scene, gpu::SpecularAa specularAa) {
    return tests::shadeQuad(
        device(), scene,
        [&](const auto& buffers, const auto& kinds) {
          return Renderer(device(), buffers, kinds, inputs,
                          {.model = {.diffuse = DiffuseLobe::lambert}, .compensation = Compensation::none});
        },
        specularAa);
  };
  const glm::vec3 expected = shade(smooth, gpu::SpecularAa::off).color;
  tests::expectNear(shade(checker, gpu::SpecularAa::toksvig).color, expected, 0.03f, "widened");
  EXPECT_GT(std::abs(shade(checker, gpu::SpecularAa::off).color.x / expected.x - 1), 0.2);
}

} // namespace
} // namespace parity::highend

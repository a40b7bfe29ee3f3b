// Several captures on the device: each path reads the one that is meant, in every encoding.
#include "highend/environment_upload.h"
#include "lighting/environment/irradiance_cube.h"

#include "support/baked_quads.h"

#include "highend/renderer.h"
#include "mobile/environment_upload.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::paths {
namespace {

using shading::Term;

// The same radiance in all directions, at every level.
lighting::CubeMap makeCube(const glm::vec3& radiance) {
  lighting::CubeMap cube;
  cube.faceSize = lighting::kMinFaceSize;
  for (int m = 0; m <= shading::f32::kPrefilterRoughestMip; ++m) {
    const int side = cube.faceSize >> m;
    cube.mips.emplace_back(static_cast<std::size_t>(lighting::layersOfMip(m, lighting::PrefilterLevels::captures)) * 6 *
                               side * side,
                           glm::vec4(radiance, 1));
  }
  return cube;
}

class CaptureUploadTest : public tests::DeviceTest {
protected:
  CaptureUploadTest() { m_scene.materials[0].baseColor = glm::vec4(1); }
  // A white metal whose every object takes capture 2.
  scenes::Scene m_scene = tests::makeQuadScene();
  const glm::vec3 m_radiance[3] = {{1, 2, 4}, {0.5f, 0.25f, 8}, {3, 1, 0.125f}};
  const lighting::CubeMap m_cubes[3] = {makeCube(m_radiance[0]), makeCube(m_radiance[1]), makeCube(m_radiance[2])};
  const lighting::CubeMap* const m_pointers[3] = {&m_cubes[0], &m_cubes[1], &m_cubes[2]};
  const lighting::EnvironmentLight m_sky = {
      .prefiltered = {},
      .irradianceSh = {glm::vec3(0.5f)},
      .irradianceCube = std::vector<glm::vec4>(
          std::size_t{6} * lighting::kIrradianceFaceSize * lighting::kIrradianceFaceSize, glm::vec4(0.5f, 1, 2, 1)),
      .lamps = {}};
  // Only the third reaches the quad.
  const gpu::GpuCapture m_captures[3] = {{{50, 0, 0, 1}, glm::vec4(-99, -99, -99, 1), glm::vec4(99)},
                                         {{0, 50, 0, 1}, glm::vec4(-99, -99, -99, 1), glm::vec4(99)},
                                         {{0, 0, 1, 5}, glm::vec4(-99, -99, -99, 1), glm::vec4(99)}};
};

TEST_F(CaptureUploadTest, TheHighEndPathReadsTheLevelsOfTheCaptureThatReachesAPoint) {
  const gpu::EnvironmentMaps maps = highend::uploadCaptures(device(), m_pointers, m_sky);
  EXPECT_EQ(maps.cube.shape().arraySize, 3u * shading::f32::kPrefilterLayers);
  const gpu::BakedMaps baked = gpu::makeBakedMaps(device(), {.captures = m_captures});
  base::Image lut(2, 2, 4);
  for (std::size_t i = 0; i < lut.pixels.size(); ++i) lut.pixels[i] = i % 4 == 1 ? 0.f : 1.f; // A = 1, B = 0
  for (const float roughness : {0.f, 0.3f, 0.7f, 1.f}) {
    m_scene.materials[0].roughness = roughness;
    const auto pixels = tests::shadeQuads(device(), m_scene, nullptr, [&](const auto& buffers, const auto& kinds) {
      return highend::Renderer(device(), buffers, kinds,
                               {.environment = &maps, .lut = &lut, .baked = &baked, .terms = true},
                               {.model = {.diffuse = highend::DiffuseLobe::lambert},
                                .compensation = highend::Compensation::none,
                                .offSpecular = highend::OffSpecular::none});
    });
    tests::expectNear(pixels[0][Term::skySpecular], m_radiance[2], 1e-5f, "radiance");
  }
  m_scene.materials[0].metallic = 0;
  const auto pixels = tests::shadeQuads(device(), m_scene, nullptr, [&](const auto& buffers, const auto& kinds) {
    return highend::Renderer(device(), buffers, kinds,
                             {.environment = &maps, .lut = &lut, .baked = &baked, .terms = true},
                             {.model = {.diffuse = highend::DiffuseLobe::lambert}});
  });
  tests::expectNear(pixels[0][Term::skyDiffuse], {0.5f, 1, 2}, 1e-5f, "irradiance of the sky");
}

TEST_F(CaptureUploadTest, TheMobilePathReadsTheCaptureOfTheObjectInEveryEncoding) {
  const gpu::BakedMaps baked = gpu::makeBakedMaps(device(), {.captures = m_captures});
  const scenes::LightmapUvs uvs{{}, {{.page = -1, .capture = 1}}};
  using enum mobile::CaptureEncoding;
  for (const mobile::CaptureEncoding encoding : {rgbm, rgb9e5, fp16}) {
    const gpu::EnvironmentMaps maps = mobile::uploadCaptures(device(), m_pointers, m_sky, encoding);
    EXPECT_EQ(maps.cube.shape().arraySize, 3u);
    mobile::Options options = tests::inFp32("ue4-2020");
    options.capture = encoding;
    options.captureScale = mobile::CaptureScale::sky;
    const auto pixels = tests::shadeQuads(device(), m_scene, &uvs, [&](const auto& buffers, const auto& kinds) {
      return mobile::Renderer(device(), buffers, kinds,
                              {.environment = &maps, .baked = &baked, .view = mobile::kViewSpecularIBL}, options);
    });
    tests::expectNear(pixels[0].color, m_radiance[1], encoding == rgbm ? 0.02f : 1e-3f, "radiance");
  }
}

TEST_F(CaptureUploadTest, TheMobilePathHasTheSkysIrradianceInItsOwnForm) {
  lighting::EnvironmentLight sky = m_sky;
  for (std::size_t i = 0; i < 9; ++i) sky.irradianceSh[i] = glm::vec3(i == 0 ? 9.f : 0.3f * static_cast<float>(i));
  const gpu::EnvironmentMaps maps =
      mobile::uploadCaptures(device(), {m_pointers, 1}, sky, mobile::CaptureEncoding::rgb9e5);
  mobile::Options options = tests::inFp32("refit");
  const auto shade = [&] {
    return tests::shadeQuads(device(), m_scene, nullptr,
                             [&](const auto& buffers, const auto& kinds) {
                               return mobile::Renderer(device(), buffers, kinds,
                                                       {.environment = &maps, .view = mobile::kViewSkyDiffuseLighting},
                                                       options);
                             })[0]
        .color;
  };
  const glm::vec3 tinted = shade();
  options.sky = mobile::SkyForm::sh9; // of a grey sky both are the same
  tests::expectNear(tinted, shade(), 1e-5f, "irradiance over pi");
  EXPECT_GT(tinted.x, 0.1f);
}

} // namespace
} // namespace parity::paths

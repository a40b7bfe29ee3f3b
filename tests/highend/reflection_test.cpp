// What the high-end path's specular lobe reflects of an environment: levels, the panorama's cells, lamps.
#include "highend_quad.h"

#include <random>

#include "lighting/environment/panorama_cells.h"
#include "shading/shading.h"

namespace parity::highend {
namespace {

using shading::Term;
using tests::makeDirectional;
using tests::makeLeaningQuad;
using tests::ShadedPoint;
namespace f64 = shading::f64;

TEST_F(HighendTest, SkyIsFetchedAroundTheReflection) {
  const gpu::EnvironmentMaps environment = tests::makeRedTowardsX(device());
  const base::Image lut = constantLut(0.5f, 0.1f);
  const Inputs inputs{.environment = &environment, .lut = &lut};
  EXPECT_NEAR(shade(makeLeaningQuad(0.7853982f), inputs, kPlain)[Term::skySpecular].x, 0.6f, 1e-4f);
  EXPECT_EQ(shade(makeLeaningQuad(0), inputs, kPlain)[Term::skySpecular].x, 0);
}

// A cube array whose level l is of radiance l: what is read is the level itself, between mips too.
TEST_F(HighendTest, SkyIsBlendedFromTheTwoNearestLevels) {
  constexpr int kLayers = shading::f32::kPrefilterLayers, kMips = shading::f32::kPrefilterRoughestMip + 1;
  std::vector<std::vector<glm::vec4>> texels(kMips);
  std::vector<std::span<const std::byte>> mips;
  for (int mip = 0; mip < kMips; ++mip) {
    const int n = 32 >> mip;
    for (int layer = 0; layer < kLayers; ++layer)
      texels[mip].insert(texels[mip].end(), static_cast<std::size_t>(6) * n * n, glm::vec4(mip * kLayers + layer));
    mips.push_back(std::as_bytes(std::span{texels[mip]}));
  }
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0);
  environment.cube = gpu::DeviceImage(device(),
                                      {.format = vk::Format::eR32G32B32A32Sfloat,
                                       .width = 32,
                                       .height = 32,
                                       .mips = kMips,
                                       .cube = true,
                                       .arraySize = kLayers},
                                      mips);
  vk::SamplerCreateInfo sampler({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
  sampler.maxLod = VK_LOD_CLAMP_NONE;
  environment.sampler = vk::raii::Sampler(device().handle(), sampler);
  const base::Image lut = constantLut(0.f, 1.f);
  scenes::Scene scene = makeLeaningQuad(0.5f);
  for (const float roughness : {0.f, 0.08f, 0.1f, 0.3f, 0.5f, 0.77f, 1.f}) {
    scene.materials[0].roughness = roughness;
    const ShadedPoint point = shade(scene, {.environment = &environment, .lut = &lut}, kPlain);
    EXPECT_NEAR(point[Term::skySpecular].x, kLayers * shading::f64::mipFromRoughness(roughness), 1e-3f) << roughness;
  }
}

// Under black levels what is left is the panorama's own share: the cell for a mirror, the mean over a box for what is
// nearly one. A lamp beside the cell that is read must not show.
TEST_F(HighendTest, MirrorsReadThePanoramasCells) {
  scenes::Environment panorama;
  panorama.name = "noise";
  panorama.radiance = base::Image(512, 256, 3); // interpolated to cells
  panorama.rotationDeg = 77;
  std::mt19937 random(2);
  for (float& value : panorama.radiance.pixels) value = static_cast<float>(std::exp(random() % 12));
  const lighting::PanoramaCells cells = lighting::makePanoramaCells(panorama);
  std::vector<std::span<const std::byte>> mips;
  for (const std::vector<glm::vec4>& mip : cells.mips) mips.push_back(std::as_bytes(std::span{mip}));
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0);
  environment.panorama.emplace(device(),
                               gpu::DeviceImage::Shape{.format = vk::Format::eR32G32B32A32Sfloat,
                                                       .width = static_cast<std::uint32_t>(cells.width),
                                                       .height = static_cast<std::uint32_t>(cells.height),
                                                       .mips = static_cast<std::uint32_t>(mips.size())},
                               mips);
  environment.panoramaTurns = cells.turns;
  const base::Image lut = constantLut(0.f, 1.f);
  for (const float angle : {0.f, 0.1f, 0.35f, -0.8f, 1.3f})
    for (const float roughness : {0.f, 0.02f, 0.045f, 0.06f}) {
      scenes::Scene scene = makeLeaningQuad(angle);
      scene.materials[0].roughness = roughness;
      const glm::vec3 actual = shade(scene, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular];
      const f64::SharpLobe lobe = f64::sharpLobe(f64::unclampedMip(roughness));
      const glm::dvec3 mirrored(std::sin(2 * angle), 0, std::cos(2 * angle));
      const glm::vec3 expected = lighting::readCells(cells, mirrored, lobe.width) * static_cast<float>(1 - lobe.tail);
      // The box's borders: single precision of the place, of 1024 cells a row.
      tests::expectNear(actual, expected, roughness == 0 ? 1e-6f : 2e-3f, "radiance");
    }
}

// Nodes as highend/shaders/reflection.glsl walks them: `next` has the first node that is not below, and kLampIs...
// bits.
gpu::GpuLamp makeNode(const glm::vec3& direction, float spread, const glm::vec3& light, std::uint32_t next,
                      std::uint32_t bits) {
  return {glm::vec4(direction, spread), glm::vec4(light, static_cast<float>(4 * next + bits))};
}

gpu::Buffer uploadLamps(const gpu::Device& device, std::vector<gpu::GpuLamp> lamps) {
  lamps.resize(gpu::kMaxLamps);
  return gpu::Buffer(device, std::span<const gpu::GpuLamp>(lamps));
}

// What no level holds is reflected as a directional light of that illuminance.
TEST_F(HighendTest, CompactLampsAreReflectedAsDirectionalLights) {
  // A + B is a cubic of the cosine.
  const auto albedo = [](float x) { return 0.3f + x * (0.5f + x * (-0.7f + 0.5f * x)); };
  base::Image lut(64, 2, 4);
  for (int i = 0; i < 128; ++i) {
    const float texel[] = {albedo(static_cast<float>(i % 64) / 63) - 0.1f, 0.1f, 0.5f, 1};
    std::copy_n(texel, 4, lut.pixels.data() + 4 * i);
  }
  const glm::vec3 towards = glm::normalize(glm::vec3(0.3f, 0.5f, 0.9f)), lux(4, 3, 2);
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0);
  environment.lamps = uploadLamps(device(), {makeNode(towards, 1e-9f, lux, 0, gpu::kLampIsLeaf | gpu::kLampIsCompact)});
  for (const Compensation compensation : {Compensation::none, Compensation::kullaConty, Compensation::turquin})
    for (const float roughness : {0.1f, 0.3f, 0.7f, 1.f})
      for (const float angle : {0.f, 0.7f, -0.9f, 1.4f}) {
        Options options = kPlain;
        options.compensation = compensation;
        scenes::Scene scene = makeLeaningQuad(angle);
        scene.materials[0].metallic = 1;
        scene.materials[0].roughness = roughness;
        const ShadedPoint lamp = shade(scene, {.environment = &environment, .lut = &lut}, options);
        const ShadedPoint sun = shade(scene, {.lut = &lut, .lights = {makeDirectional(towards, lux)}}, options);
        // What scatters more than once has its light from the irradiance, black here, and from lamps its lobe's excess.
        const float NoL = std::max(0.f, glm::dot(glm::vec3(std::sin(angle), 0, std::cos(angle)), towards));
        ASSERT_GT(NoL, 0.1f); // from where on the cubic is used
        const double multiple = compensation == Compensation::kullaConty
                                    ? f64::kullaContyAlbedo({1, 1, 1}, albedo(std::cos(angle)), 0.5).x
                                    : 0;
        const glm::vec3 expected =
            glm::max(sun[Term::sunSpecular] - static_cast<float>(multiple * NoL / 3.14159265358979) * lux, 0.f);
        // The cubic goes through what linear filtering makes of the table.
        const float tolerance = compensation == Compensation::kullaConty ? 4e-3f : 1e-3f;
        tests::expectNear(lamp[Term::skySpecular], expected, tolerance, "lamp");
      }
}

// What a level holds is taken off again: under a level of light L that is all of one lamp, the true lobe is left.
TEST_F(HighendTest, WideLampsAddTheDifferenceOfTheLobes) {
  const base::Image lut = constantLut(0.4f, 0.1f);
  const glm::vec3 towards = glm::normalize(glm::vec3(0.3f, 0.1f, 0.9f)), lux(4, 3, 2);
  const float spread = 1e-4f;
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1000);
  environment.lamps = uploadLamps(device(), {makeNode(towards, spread, lux, 0, gpu::kLampIsLeaf)});
  for (const float roughness : {0.3f, 0.5f, 1.f})
    for (const float angle : {0.f, 0.4f, -0.8f}) {
      scenes::Scene scene = makeLeaningQuad(angle);
      scene.materials[0].metallic = 1;
      scene.materials[0].roughness = roughness;
      const glm::vec3 actual = shade(scene, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular];
      const glm::dvec3 N(std::sin(angle), 0, std::cos(angle)), V(0, 0, 1),
          R(std::sin(2 * angle), 0, std::cos(2 * angle)), L(towards), H = glm::normalize(V + L);
      const double alpha = std::pow(double{roughness}, 2), a2 = alpha * alpha, NoL = glm::dot(N, L),
                   NoV = glm::dot(N, V), NoH2 = std::pow(glm::dot(N, H), 2), VoH2 = std::pow(glm::dot(V, H), 2),
                   u = glm::dot(R - L, R - L) / 4;
      const f64::PrefilterBlend blend = f64::finePrefilterBlend(f64::unclampedMip(roughness));
      const auto levelLobe = [&](int level) {
        const double b2 = std::pow(f64::roughnessFromMip(level / 4.0), 4);
        return f64::prefilteredLobe(b2, f64::prefilteredLobeIntegral(b2), u, 0.0);
      };
      const double held = levelLobe(blend.lower) * (1 - blend.upperShare) + levelLobe(blend.upper) * blend.upperShare;
      const double lower2 = std::pow(f64::roughnessFromMip(blend.lower / 4.0), 4);
      const double share = f64::lampShare(std::min({f64::lobeScale(a2, NoH2, VoH2), 1.0, 4 * (u + lower2)}), spread);
      const double lobe = f64::D_GGX(alpha, std::sqrt(NoH2)) * f64::V_SmithGGXCorrelated(alpha, NoV, NoL) * NoL;
      // Metal of base colour 1: F = 1, single = A + B.
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(actual[c], 1000 * 0.5 + lux[c] * share * (lobe - 0.5 * held), 2e-3) << roughness << " " << angle;
    }
}

// A node far from the lobe stands for its leaves; where the lobe is near, the leaves are seen. Padded nodes are never
// read.
TEST_F(HighendTest, LampsAreAskedOneByOneOnlyWhereTheyAreNear) {
  const base::Image lut = constantLut(0.4f, 0.1f);
  const glm::vec3 a = glm::normalize(glm::vec3(0.02f, 0, 1)), b = glm::normalize(glm::vec3(-0.02f, 0, 1));
  const glm::vec3 lightOfLeaves(1, 2, 0), lightOfRoot(0, 0, 5); // by which it is seen who was asked
  constexpr std::uint32_t kLeaf = gpu::kLampIsLeaf | gpu::kLampIsCompact, kInner = gpu::kLampIsCompact;
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1e-3f);
  environment.lamps =
      uploadLamps(device(), {makeNode({0, 0, 1}, 4e-4f, lightOfRoot, 0, kInner),
                             makeNode(a, 1e-9f, lightOfLeaves, 2, kLeaf), makeNode(b, 1e-9f, lightOfLeaves, 0, kLeaf)});
  gpu::EnvironmentMaps one = tests::makeConstantEnvironment(device(), 1e-3f);
  scenes::Scene near = makeLeaningQuad(0), far = makeLeaningQuad(0.6f);
  for (scenes::Scene* scene : {&near, &far}) scene->materials[0].metallic = 1;
  near.materials[0].roughness = 0.15f;
  far.materials[0].roughness = 0.6f;
  const glm::vec3 byLeaves = shade(near, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular],
                  byRoot = shade(far, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular];
  const float sky = 0.5e-3f;
  glm::vec3 expected(sky);
  for (const glm::vec3& towards : {a, b}) {
    one.lamps = uploadLamps(device(), {makeNode(towards, 1e-9f, lightOfLeaves, 0, kLeaf)});
    expected += shade(near, {.environment = &one, .lut = &lut}, kPlain)[Term::skySpecular] - sky;
  }
  tests::expectNear(byLeaves, expected, 1e-4f, "leaves");
  EXPECT_NEAR(byRoot.x, sky, 1e-6f);
  EXPECT_GT(byRoot.z, 10 * sky);
}

TEST_F(HighendTest, LampsUnderTheHorizonGiveNothing) {
  const base::Image lut = constantLut(0.4f, 0.1f);
  gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeLeaningQuad(0.3f);
  scene.materials[0].metallic = 1;
  const glm::vec3 none = shade(scene, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular];
  const glm::vec3 below = glm::normalize(glm::vec3(-0.1f, 0.2f, -1)), above = glm::normalize(glm::vec3(0, 0.2f, 1));
  // The second node is reached over the first, which is left with all below it.
  environment.lamps = uploadLamps(device(), {makeNode(below, 1e-4f, glm::vec3(100), 2, 0),
                                             makeNode(above, 1e-9f, glm::vec3(100), 2, gpu::kLampIsLeaf),
                                             makeNode(below, 1e-4f, glm::vec3(100), 0, gpu::kLampIsLeaf)});
  EXPECT_EQ(shade(scene, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular], none);
  // A node whose middle is below, but whose light reaches above: its leaf is seen as if it were alone.
  const glm::vec3 N(std::sin(0.3f), 0, std::cos(0.3f)), along = glm::normalize(glm::vec3(N.z, 0, -N.x)),
                                                        under = glm::normalize(along - 0.05f * N),
                                                        leaf = glm::normalize(along + 0.05f * N);
  const auto shadeLamps = [&](const std::vector<gpu::GpuLamp>& lamps) {
    environment.lamps = uploadLamps(device(), lamps);
    return shade(scene, {.environment = &environment, .lut = &lut}, kPlain)[Term::skySpecular];
  };
  constexpr std::uint32_t kLeaf = gpu::kLampIsLeaf | gpu::kLampIsCompact;
  scene.materials[0].roughness = 0.3f;
  const glm::vec3 alone = shadeLamps({makeNode(leaf, 1e-9f, glm::vec3(1e4f), 0, kLeaf)}),
                  reached = shadeLamps({makeNode(under, 0.02f, glm::vec3(1e4f), 0, gpu::kLampIsCompact),
                                        makeNode(leaf, 1e-9f, glm::vec3(1e4f), 0, kLeaf)});
  EXPECT_GT(alone.x, 2 * none.x);
  EXPECT_EQ(reached, alone);
}

} // namespace
} // namespace parity::highend

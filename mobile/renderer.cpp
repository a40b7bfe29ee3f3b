#include "mobile/renderer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "mobile/light_choice.h"
#include "mobile/programs.h"
#include "scenes/brightest_light.h"
#include "shading/shading.h"

namespace parity::mobile {

namespace {

// The shader is given the enumerators' numbers.
constexpr bool is(auto enumerator, int value) { return static_cast<int>(enumerator) == value; }
namespace numbers = shading::f32;
static_assert(is(EnvironmentBrdf::karis2014, numbers::kEnvironmentBrdfKaris2014) &&
              is(EnvironmentBrdf::ue4, numbers::kEnvironmentBrdfUE4) &&
              is(EnvironmentBrdf::refit, numbers::kEnvironmentBrdfRefit));
static_assert(is(DirectLobe::dApprox, numbers::kSunDApprox) &&
              is(DirectLobe::calcSpecular, numbers::kSunCalcSpecular) && is(DirectLobe::refit, numbers::kSunRefit) &&
              is(DirectLobe::phongApprox, numbers::kSunPhongApprox));
// `automatic` stands before them.
static_assert(is(CaptureScale::sky, numbers::kCaptureScaleSky + 1) &&
              is(CaptureScale::mixing, numbers::kCaptureScaleMixing + 1) &&
              is(CaptureScale::full, numbers::kCaptureScaleFull + 1) &&
              is(CaptureScale::occlusion, numbers::kCaptureScaleOcclusion + 1));
static_assert(is(CoatForm::none, numbers::kCoatNone) && is(CoatForm::ue4, numbers::kCoatUE4) &&
              is(CoatForm::refit, numbers::kCoatRefit));
static_assert(is(SheenForm::none, numbers::kSheenNone) && is(SheenForm::fit, numbers::kSheenFit));
static_assert(is(AnisotropyForm::none, numbers::kAnisotropyNone) && is(AnisotropyForm::bent, numbers::kAnisotropyBent));
static_assert(is(IridescenceForm::none, numbers::kIridescenceNone) &&
              is(IridescenceForm::tint, numbers::kIridescenceTint));
static_assert(is(TransmissionForm::none, numbers::kTransmissionNone) &&
              is(TransmissionForm::alpha, numbers::kTransmissionAlpha) &&
              is(TransmissionForm::refracted, numbers::kTransmissionRefracted) &&
              is(TransmissionForm::mixed, numbers::kTransmissionMixed));
static_assert(is(DiffuseTransmissionForm::none, numbers::kDiffuseTransmissionNone) &&
              is(DiffuseTransmissionForm::lambert, numbers::kDiffuseTransmissionLambert));
// The engine's defaults, which the high-end path has too.
constexpr Mixing kEngineMixing;
static_assert(kEngineMixing.begin == numbers::kMixingBegin && kEngineMixing.end == numbers::kMixingEnd &&
              kEngineMixing.largest == numbers::kMixingLargest);

// The shader's kKnobWords with PARITY_WIDE: the constants, at the head of pathData.
constexpr std::size_t kKnobWords = 22;

// Bits of the shader's kShadowMaps.
constexpr std::uint32_t kShadowOfSpot = 1, kShadowOfSun = 2;

std::vector<std::uint32_t> constantsOf(const Options& options, std::uint32_t view, std::uint32_t shadowMaps,
                                       std::uint32_t baked, std::uint32_t falloffs) {
  const CaptureScale scale = captureScaleOf(options, (baked & gpu::kBakedCaptures) != 0);
  return {numberOf(options.environmentBrdf),
          numberOf(options.directLobe),
          static_cast<std::uint32_t>(scale) - 1,
          static_cast<std::uint32_t>(options.sky),
          options.capture == CaptureEncoding::rgbm ? 1u : 0u,
          std::bit_cast<std::uint32_t>(options.roughnessFloor),
          view,
          shadowMaps,
          baked,
          falloffs,
          static_cast<std::uint32_t>(options.coat),
          static_cast<std::uint32_t>(options.sheen),
          static_cast<std::uint32_t>(options.anisotropy),
          static_cast<std::uint32_t>(options.iridescence),
          static_cast<std::uint32_t>(options.transmission),
          static_cast<std::uint32_t>(options.diffuseTransmission),
          options.fullyRough ? 1u : 0u,
          options.nonmetal ? 1u : 0u,
          options.parallax ? 1u : 0u,
          options.lightCap ? 1u : 0u,
          options.pixelFog ? 1u : 0u,
          static_cast<std::uint32_t>(options.lightmap)};
}

// kBaked... bits of what is read.
std::uint32_t bakedPartsOf(const Inputs& inputs, const gpu::SceneBuffers& scene, bool hasSun) {
  if (!inputs.baked) return 0;
  std::uint32_t parts = inputs.baked->parts;
  if ((scene.vertexData() & gpu::kVertexLightmap) == 0) parts &= ~(gpu::kBakedLightmap | gpu::kBakedSunShadow);
  if (!hasSun) parts &= ~gpu::kBakedSunShadow;
  if (!inputs.environment) parts &= ~gpu::kBakedCaptures;
  assert((parts & gpu::kBakedLightmap) == 0 || inputs.baked->scaleCount == scene.scene().instances.size());
  return parts;
}

// The sky light, in the form that is chosen; of the capture its average brightness, which is the luminance of its mean
// radiance in SkyLightColor, as its texels are read; and the mixing weight.
std::array<glm::vec4, gpu::kPathNumbers> numbersOf(const gpu::EnvironmentMaps& environment, const Options& options,
                                                   const glm::vec3& skyLightColor) {
  std::array<glm::vec4, gpu::kPathNumbers> result{};
  shading::f32::IrradianceSh sh;
  for (std::size_t i = 0; i < environment.sh.size(); ++i)
    sh.c[i] = {environment.sh[i].x, environment.sh[i].y, environment.sh[i].z};
  const bool ownSky = options.own && options.own->defines("presetSkyDiffuse");
  const bool isTinted = options.sky == SkyForm::tinted && !ownSky;
  const shading::f32::SkySh sky = shading::f32::packSkySh(sh, options.sky == SkyForm::sh4 ? 4 : 9);
  for (int i = 0; i < 9; ++i) result[gpu::kPathSkySh + i] = glm::vec4(sky.c[i].x, sky.c[i].y, sky.c[i].z, 0);
  if (isTinted) std::copy(environment.tintedSky.begin(), environment.tintedSky.end(), result.begin() + gpu::kPathSkySh);
  const shading::f32::real32x3 mean = shading::f32::skyMeanRadiance(sh);
  result[gpu::kPathAverageBrightness].x =
      shading::f32::luminanceUE4({mean.x * skyLightColor.x, mean.y * skyLightColor.y, mean.z * skyLightColor.z});
  const Mixing& mixing = options.mixing;
  const shading::f32::MixingRange range = shading::f32::mixingRange(mixing.begin, mixing.end, mixing.largest);
  result[gpu::kPathMixing] = glm::vec4(range.scale, range.bias, range.largest, 0);
  return result;
}

// Of the shadow maps: how the sun's fades with the distance, and the spot light's sharpen and fade.
glm::vec4 shadowNumbersOf(const Options& options) {
  const shading::f32::DistanceFade MAD =
      shading::f32::distanceFadeMAD(options.sunShadowDistance, options.sunShadowFade);
  return {MAD.x, MAD.y, options.spotShadowSharpen, options.spotShadowFade};
}

} // namespace

Precision precisionOn(const gpu::DeviceReport& device, const Options& options) {
  return device.float16 ? options.precision : Precision::fp32;
}

Renderer::Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
                   const Inputs& inputs, const Options& options) {
  gpu::PathProgram program;
  program.name = "mobile";
  program.termsFollowLight = true;
  const Precision precision = precisionOn(device.report(), options);
  program.spirv = programOf(options, {.precision = precision, .lobes = false, .wide = inputs.wide});
  program.spirvOfLobes = !scene.hasLobes()
                             ? program.spirv // not asked for
                             : programOf(options, {.precision = precision, .lobes = true, .wide = inputs.wide});
  if (precision != options.precision)
    m_notes.push_back(fmt::format("fp32 replaces fp16: {} has no shaderFloat16", device.report().name));

  // The sun comes first, the local lights keep their order; pathData holds indices into this list.
  std::vector<scenes::Light> lights;
  const auto sun = scenes::brightestOf(inputs.lights, scenes::LightKind::directional);
  if (sun) lights.push_back(inputs.lights[*sun]);
  const auto directional = std::count_if(inputs.lights.begin(), inputs.lights.end(),
                                         [](const auto& l) { return l.kind == scenes::LightKind::directional; });
  if (directional > 1)
    m_notes.push_back(fmt::format("{} of {} directional lights are dropped: the path shades only the brightest",
                                  directional - 1, directional));
  for (const scenes::Light& light : inputs.lights)
    if (light.kind != scenes::LightKind::directional) lights.push_back(light);
  const std::size_t localCount = lights.size() - (sun ? 1 : 0);
  if (!options.localLights) {
    if (localCount > 0)
      m_notes.push_back(fmt::format("{} local lights are dropped: the preset {} expects them in baked light",
                                    localCount, options.preset));
    lights.resize(sun ? 1 : 0);
  } else if (!options.lightCap) {
    if (localCount > gpu::kMaxLightsOfAPixel)
      throw base::Error(base::ExitCode::failed, device.report().name, fmt::format("{} local lights", localCount),
                        fmt::format("without --mobile-light-cap all of them reach every pixel, expected at most {}",
                                    gpu::kMaxLightsOfAPixel));
    m_uncappedLights = localCount;
    program.localCount = static_cast<std::uint32_t>(localCount);
  } else if (localCount > 0) {
    std::set<std::uint32_t> used;
    for (const auto& slots : chooseLocalLights(scene.scene(), lights))
      for (const std::uint32_t index : slots) {
        program.pathData.push_back(index);
        if (index != kNoLight) used.insert(index);
      }
    m_lightChoices = program.pathData.size() / kLightsPerObject;
    program.localCount = static_cast<std::uint32_t>(used.size());
    if (localCount > kLightsPerObject)
      m_notes.push_back(
          fmt::format("each object gets only the {1} brightest of {0} local lights", localCount, kLightsPerObject));
  }
  if (!options.lightCap && !options.localLights)
    m_notes.push_back(fmt::format(
        "--no-mobile-light-cap has no effect: the preset {} expects local lights in baked light", options.preset));
  const auto spots =
      std::count_if(lights.begin(), lights.end(), [](const auto& l) { return l.kind == scenes::LightKind::spot; });
  const auto spot = inputs.shadows && options.spotShadow && options.localLights
                        ? scenes::brightestOf(lights, scenes::LightKind::spot)
                        : std::nullopt;
  const bool hasSunShadow = inputs.shadows && options.sunShadow && sun;
  if (options.sunShadow && !sun) m_notes.emplace_back("--mobile-sun-shadow has no effect: the scene has no sun");
  if (options.spotShadow && !options.localLights)
    m_notes.push_back(fmt::format(
        "--mobile-spot-shadow has no effect: the preset {} expects local lights in baked light", options.preset));
  else if (options.spotShadow && spots == 0)
    m_notes.emplace_back("--mobile-spot-shadow has no effect: the scene has no spot light");
  else if (options.spotShadow && spots > 1)
    m_notes.push_back(fmt::format("{} of {} spot lights cast no shadow: only the brightest does", spots - 1, spots));
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const bool casts = k == spot || (hasSunShadow && k == 0);
    program.lights.push_back(gpu::packLight(lights[k], casts ? inputs.shadows->of(lights[k]) : gpu::ShadowOfLight()));
  }
  program.shadows = m_shadows = spot || hasSunShadow ? inputs.shadows : nullptr;
  program.directionalCount = sun ? 1 : 0;
  program.environment = inputs.environment;
  if (inputs.environment)
    program.numbers = numbersOf(*inputs.environment, options, scene.scene().lightScales.skyLightColor);
  program.textures = inputs.textures;
  program.baked = inputs.baked;
  if (inputs.baked) program.numbers[gpu::kPathAverageBrightness].y = inputs.baked->transitionScale;
  program.numbers[gpu::kPathShadows] = shadowNumbersOf(options);
  const std::uint32_t baked = bakedPartsOf(inputs, scene, sun.has_value());
  const bool shines = !options.fullyRough; // else there is neither reflection nor further lobe
  m_samplers = {
      .environment = inputs.environment != nullptr && shines,
      .shadowMap = m_shadows != nullptr,
      .lightmap = (baked & gpu::kBakedLightmap) != 0,
      .sunShadow = (baked & gpu::kBakedSunShadow) != 0,
      .coat = shines && options.coat != CoatForm::none,
      .sheen = shines && options.sheen != SheenForm::none,
      .anisotropy = shines && options.anisotropy != AnisotropyForm::none,
      .iridescence = shines && options.iridescence != IridescenceForm::none,
      .transmission = shines && options.transmission != TransmissionForm::none,
      .thickness = shines && (options.transmission == TransmissionForm::refracted ||
                              options.transmission == TransmissionForm::mixed),
      .diffuseTransmission = shines && options.diffuseTransmission != DiffuseTransmissionForm::none,
      .backdrop = shines &&
                  (options.transmission == TransmissionForm::alpha || options.transmission == TransmissionForm::mixed),
      .coatNormal = shines && (options.coat == CoatForm::refit ||
                               (options.coat != CoatForm::none && scene.specularAa() == gpu::SpecularAa::toksvig)),
      .normalVariance = scene.specularAa() == gpu::SpecularAa::toksvig};
  m_readsBackdrop = m_samplers.backdrop && (scene.lobes() & gpu::kFeatureTransmission) != 0;
  program.constants = constantsOf(options, inputs.view, (spot ? kShadowOfSpot : 0) | (hasSunShadow ? kShadowOfSun : 0),
                                  baked, gpu::falloffsOf(lights));
  program.everySceneConstants = constantsOf(options, inputs.view,
                                            (options.spotShadow && options.localLights ? kShadowOfSpot : 0) |
                                                (options.sunShadow ? kShadowOfSun : 0),
                                            baked, gpu::kFalloffsAll);
  if (inputs.wide) {
    assert(program.constants.size() == kKnobWords);
    program.pathData.insert(program.pathData.begin(), program.constants.begin(), program.constants.end());
    program.constants.clear();
    program.everySceneConstants.clear();
    program.asksForCounts = true;
  }
  program.terms = inputs.terms;
  program.premultiplied = true;
  program.expectedPixels = inputs.expectedPixels;
  program.compilation = inputs.compilation;
  m_pass = std::make_unique<gpu::ShadingPass>(device, scene, binKinds, std::move(program));
}

std::vector<scenes::Light> Renderer::needsShadowMaps(const std::vector<scenes::Light>& lights, const Options& options) {
  const auto sun = options.sunShadow ? scenes::brightestOf(lights, scenes::LightKind::directional) : std::nullopt;
  const auto spot =
      options.spotShadow && options.localLights ? scenes::brightestOf(lights, scenes::LightKind::spot) : std::nullopt;
  std::vector<scenes::Light> casting;
  for (const auto& light : {sun, spot})
    if (light) casting.push_back(lights[*light]);
  return casting;
}

} // namespace parity::mobile

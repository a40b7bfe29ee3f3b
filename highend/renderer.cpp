#include "highend/renderer.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"
#include "highend/programs.h"

namespace parity::highend {

namespace {

// sheen: goes into the fourth channel; null: none.
gpu::DeviceImage uploadLut(const gpu::Device& device, base::Image lut, const base::Image* sheen) {
  assert(lut.channels == 4 && (!sheen || sheen->pixelCount() == lut.pixelCount()));
  for (std::size_t i = 0; sheen && i < lut.pixelCount(); ++i) lut.pixels[4 * i + 3] = sheen->pixels[i];
  constexpr auto kFormat = vk::Format::eR32G32B32A32Sfloat;
  if (!device.filtersLinearly(kFormat))
    throw base::Error(base::ExitCode::failed, device.report().name, "environment BRDF table",
                      "the device cannot filter 32-bit float textures");
  const gpu::DeviceImage::Shape shape{.format = kFormat,
                                      .width = static_cast<std::uint32_t>(lut.width),
                                      .height = static_cast<std::uint32_t>(lut.height)};
  const std::span<const std::byte> mip = std::as_bytes(std::span{lut.pixels});
  return gpu::DeviceImage(device, shape, std::span{&mip, 1});
}

// As many local lights are asked for every pixel without lists, which cost more than they save.
constexpr std::ptrdiff_t kMaxUnlisted = 8;

constexpr std::size_t kConstantLocalKinds = 5, kConstantFalloffs = 8; // among the path's own

// 0: parallel light; 1: everywhere; 2: within a range or a cone.
int reachOf(const scenes::Light& light) {
  if (light.kind == scenes::LightKind::directional) return 0;
  return light.kind == scenes::LightKind::point && light.range == 0 ? 1 : 2;
}

base::Error tooMany(const gpu::Device& device, std::size_t count) {
  return {base::ExitCode::failed, device.report().name, fmt::format("{} lights", count),
          fmt::format("all of them reach every pixel, expected at most {}", gpu::kMaxLightsOfAPixel)};
}

std::uint32_t kindsOf(const std::vector<scenes::Light>& lights) {
  std::uint32_t kinds = 0;
  for (const scenes::Light& light : lights)
    if (light.kind != scenes::LightKind::directional)
      kinds |= light.kind == scenes::LightKind::spot ? gpu::kLocalSpot : gpu::kLocalPoint;
  return kinds;
}

const gpu::EnvironmentMaps* environmentOf(const Inputs& inputs) {
  return inputs.lightsAlone ? nullptr : inputs.environment;
}

// kBaked... bits of what is read.
std::uint32_t bakedPartsOf(const Inputs& inputs, const gpu::SceneBuffers& scene) {
  if (!inputs.baked) return 0;
  std::uint32_t parts = inputs.baked->parts;
  if ((scene.vertexData() & gpu::kVertexLightmap) == 0) parts &= ~(gpu::kBakedLightmap | gpu::kBakedSunShadow);
  if (inputs.shadows) parts &= ~gpu::kBakedSunShadow;
  if (!environmentOf(inputs)) parts &= ~gpu::kBakedCaptures;
  if (inputs.lightsAlone) parts &= ~gpu::kBakedLightmap;
  return parts;
}

// The shader is given the enumerators' numbers.
constexpr bool is(auto enumerator, std::uint32_t value) { return static_cast<std::uint32_t>(enumerator) == value; }
static_assert(is(GeometryTerm::schlickSmith, gpu::kGeometrySchlickSmith));
static_assert(is(FresnelCurve::sphericalGaussian, gpu::kFresnelSphericalGaussian) &&
              is(FresnelCurve::dielectric, gpu::kFresnelDielectric));
static_assert(is(DiffuseLobe::lambert, gpu::kDiffuseLambert));
static_assert(is(Compensation::turquin, gpu::kCompensationTurquin) &&
              is(Compensation::fdezAguera, gpu::kCompensationFdezAguera) &&
              is(Compensation::kullaConty, gpu::kCompensationKullaConty));
static_assert(is(OffSpecular::dominant, gpu::kOffSpecularDominant) &&
              is(OffSpecular::stretched, gpu::kOffSpecularStretched) &&
              is(OffSpecular::twoTaps, gpu::kOffSpecularTwoTaps) &&
              is(OffSpecular::threeTaps, gpu::kOffSpecularThreeTaps));

} // namespace

const std::vector<std::string>& geometryTermNames() {
  static const std::vector<std::string> names = {"height-correlated", "schlick-smith"};
  return names;
}
const std::vector<std::string>& fresnelNames() {
  static const std::vector<std::string> names = {"schlick", "spherical-gaussian", "dielectric"};
  return names;
}
const std::vector<std::string>& diffuseNames() {
  static const std::vector<std::string> names = {"balanced", "lambert"};
  return names;
}
const std::vector<std::string>& compensationNames() {
  static const std::vector<std::string> names = {"none", "turquin", "fdez-aguera", "kulla-conty"};
  return names;
}
const std::vector<std::string>& offSpecularNames() {
  static const std::vector<std::string> names = {"none", "dominant", "stretched", "two-taps", "three-taps"};
  return names;
}

Renderer::Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
                   const Inputs& inputs, const Options& options) {
  gpu::PathProgram program;
  program.name = "highend";
  program.termsFollowLight = true;
  program.spirv = programOf(options, false);
  program.spirvOfLobes = scene.hasLobes() ? programOf(options, true) : program.spirv; // where it is asked for
  // Directional ones, those that reach everything, the others: with and without lists in one order.
  std::vector<std::size_t> order(inputs.lights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return reachOf(inputs.lights[i]); });
  std::vector<scenes::Light> lights;
  m_places.resize(order.size());
  for (const std::size_t i : order) {
    m_places[i] = lights.size();
    const scenes::Light& light = lights.emplace_back(inputs.lights[i]);
    program.lights.push_back(gpu::packLight(light, inputs.shadows ? inputs.shadows->of(light) : gpu::ShadowOfLight()));
    ++(light.kind == scenes::LightKind::directional ? program.directionalCount : program.localCount);
  }
  if (needsLut(inputs, options)) {
    assert(inputs.lut != nullptr);
    m_hasLut = true;
    m_lut = uploadLut(device, *inputs.lut, inputs.sheenTable);
    program.pathTexture = &m_lut;
    ++m_ownSamplers;
  }
  const gpu::EnvironmentMaps* environment = program.environment = environmentOf(inputs);
  const bool hasPanorama = environment && environment->panorama;
  if (environment) m_ownSamplers += hasPanorama ? 3 : 2; // the prefiltered cube, the irradiance, the cells
  if (hasPanorama) program.numbers[gpu::kPathPanorama].x = environment->panoramaTurns;
  program.shadows = m_shadows = inputs.shadows;
  if (inputs.shadows) ++m_ownSamplers;
  program.baked = inputs.baked;
  const std::uint32_t baked = bakedPartsOf(inputs, scene);
  if (baked & gpu::kBakedLightmap) ++m_ownSamplers;
  if (baked & gpu::kBakedSunShadow) ++m_ownSamplers;
  program.constants = {static_cast<std::uint32_t>(options.model.geometryTerm),
                       static_cast<std::uint32_t>(options.model.fresnel),
                       static_cast<std::uint32_t>(options.model.diffuse),
                       static_cast<std::uint32_t>(options.compensation),
                       static_cast<std::uint32_t>(options.offSpecular),
                       kindsOf(lights),
                       inputs.shadows ? inputs.shadows->filter() + 1 : 0,
                       baked,
                       gpu::falloffsOf(lights),
                       inputs.view,
                       hasPanorama ? 1u : 0u,
                       environment && environment->lamps ? 1u : 0u,
                       static_cast<std::uint32_t>(inputs.leftOut),
                       inputs.lightsAlone ? 1u : 0u};
  program.everySceneConstants = program.constants;
  program.everySceneConstants[kConstantLocalKinds] = gpu::kLocalAll;
  program.everySceneConstants[kConstantFalloffs] = gpu::kFalloffsAll;
  if (program.directionalCount + program.localCount > gpu::kMaxLightsOfAPixel && !inputs.cullLights)
    throw tooMany(device, program.directionalCount + program.localCount);
  const auto bounded = std::find_if(lights.begin(), lights.end(), [](const auto& l) { return reachOf(l) == 2; });
  if (inputs.cullLights && lights.end() - bounded > kMaxUnlisted) {
    m_culling =
        std::make_unique<LightCulling>(device, program.lights, static_cast<std::uint32_t>(bounded - lights.begin()));
    program.listLights = [culling = m_culling.get()](const gpu::Surface& surface, const auto& counts) {
      return culling->listsFor(surface, counts);
    };
  } else {
    program.pathData = {0}; // no lists
  }
  if (const auto everywhere = static_cast<std::size_t>(bounded - lights.begin()); everywhere > gpu::kMaxLightsOfAPixel)
    throw tooMany(device, everywhere);
  assert(inputs.leftOut <= gpu::kMaxLeftOut);
  assert(!inputs.lightsAlone ||
         (inputs.leftOut != 0 && !scene.hasLobes() && (scene.vertexData() & gpu::kVertexFog) == 0));
  program.terms = inputs.terms;
  program.leftOut = inputs.leftOut;
  constexpr std::uint32_t kLayers = gpu::kFeatureCoat | gpu::kFeatureSheen;
  assert((scene.lobes() & kLayers & ~inputs.hiddenFeatures) == 0 || inputs.sheenTable);
  program.hiddenFeatures = inputs.hiddenFeatures;
  m_readsBackdrop = (scene.lobes() & ~inputs.hiddenFeatures & gpu::kFeatureTransmission) != 0;
  program.expectedPixels = inputs.expectedPixels;
  program.compilation = inputs.compilation;
  m_pass = std::make_unique<gpu::ShadingPass>(device, scene, binKinds, std::move(program));
}

void Renderer::leaveOut(std::span<const std::size_t> lights) {
  std::vector<std::size_t> places;
  for (const std::size_t light : lights) places.push_back(m_places[light]);
  m_pass->leaveOut(places);
}

std::size_t Renderer::countSamplers(const gpu::Permutation& permutation) const {
  const bool lit = (permutation.mustFeatures & gpu::kFeatureUnlit) == 0,
             readsBackdrop = lit && (permutation.mayFeatures & gpu::kFeatureTransmission) != 0;
  return gpu::countTextures(permutation.textures) + (lit ? m_ownSamplers : 0) + readsBackdrop;
}

paths::RendererWork Renderer::work() const {
  return {.directionalLights = m_pass->directionalCount(),
          .localLights = m_pass->localCount(),
          .lightLists = m_culling ? m_culling->listCount() : 0,
          .brdfTables = m_hasLut ? 1u : 0u};
}

std::vector<std::string> Renderer::warnings() const {
  if (!m_shadows || m_shadows->note().empty()) return {};
  return {m_shadows->note()};
}

} // namespace parity::highend

#include "job/scene/reference_path.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

#include "base/hash.h"
#include "base/member_count.h"
#include "lighting/surface/surface_hash.h"
#include "reference/fog.h"
#include "reference/layers.h"
#include "reference/sampling.h"

namespace parity::job {

namespace {

static_assert(sizeof(reference::ShadedSample) == (3 * shading::kTermCount + 3) * sizeof(float), "no padding: cached");

std::vector<reference::SurfaceSample>
samplesOf(const gpu::Surface& surface, const std::vector<gpu::ResolvedMaterial>& materials, std::uint32_t stream) {
  std::vector<reference::SurfaceSample> samples(materials.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const gpu::ResolvedMaterial& m = materials[i];
    samples[i] = {.pixel = reference::hashCombine(surface.pixels[i], stream),
                  .unlit = m.unlit ? 1u : 0u,
                  .position = m.position,
                  .normal = m.normal,
                  .geometricNormal = m.geometricNormal,
                  .view = m.view,
                  .baseColor = m.baseColor,
                  .metallic = m.metallic,
                  .roughness = m.roughness,
                  .dielectricF0 = m.F0,
                  .dielectricF90 = m.F90,
                  .occlusion = m.occlusion,
                  .emissive = m.emissive,
                  .coat = m.coat,
                  .coatRoughness = m.coatRoughness,
                  .coatNormal = m.coatNormal,
                  .sheenColor = m.sheenColor,
                  .sheenRoughness = m.sheenRoughness,
                  .anisotropy = m.anisotropy,
                  .tangent = m.tangent,
                  .iridescence = m.iridescence,
                  .filmIor = m.filmIor,
                  .filmThickness = m.filmThickness,
                  .instance = surface.instances[i],
                  .transmission = m.transmission,
                  .ior = m.ior,
                  .thickness = m.thickness,
                  .absorption = m.absorption,
                  .dispersion = m.dispersion,
                  .diffuseTransmission = m.diffuseTransmission,
                  .diffuseTransmissionColor = m.diffuseTransmissionColor};
  }
  return samples;
}

// Not in the key: names.
static_assert(base::memberCount<scenes::Light>() == 11 && base::memberCount<scenes::Environment>() == 3 &&
                  base::memberCount<reference::Options>() == 3 && base::memberCount<reference::Model>() == 2 &&
                  base::memberCount<shading::SurfaceModel>() == 3 &&
                  base::memberCount<reference::IntegralOptions>() == 4,
              "a new member goes into the key, or is named here with the reason why not");

std::string makeLightKey(const std::string& buildId, const PreparedScene& prepared, const Settings& settings) {
  const reference::Options& o = settings.reference;
  base::Hasher hasher;
  hasher.add(buildId)
      .add("reference")
      .addValue(o.model.surface.geometryTerm)
      .addValue(o.model.surface.fresnel)
      .addValue(o.model.surface.diffuse);
  hasher.addValue(o.model.scattering);
  hasher.addValue(o.integral.relativeError).addValue(o.integral.minSamples).addValue(o.integral.maxSamples);
  hasher.addValue(o.integral.seed).addValue(prepared.panorama.has_value());
  if (prepared.panorama)
    hasher.addValue(prepared.panorama->rotationDeg)
        .addValue(prepared.panorama->radiance.width)
        .addValue(prepared.panorama->radiance.height)
        .add(std::as_bytes(std::span{prepared.panorama->radiance.pixels}));
  for (const scenes::Light& light : prepared.lights)
    hasher.addValue(light.kind)
        .addValue(light.color)
        .addValue(light.position)
        .addValue(light.direction)
        .addValue(light.range)
        .addValue(light.falloff)
        .addValue(light.falloffExponent)
        .addValue(light.innerConeAngle)
        .addValue(light.outerConeAngle)
        .addValue(light.specularScale);
  hasher.addValue(settings.reference.bounces).addValue(settings.shadows);
  const bool looksThrough = letsLightThrough(prepared.scene);
  if (settings.reference.bounces > 0 || looksThrough) hasher.add(lighting::hashOfSurfaces(prepared.scene));
  if (looksThrough) // which meshes bound a body, and which are not seen behind others
    for (const scenes::Material& material : prepared.scene.materials)
      hasher.addValue(material.hasVolume()).addValue(material.hasTransmission());
  hasher.add(tracesScene(prepared) ? lighting::hashOfOccluders(prepared.scene) : "no occluders");
  return hasher.hex();
}

// From the cache, or made and kept there.
reference::DirectionalAlbedo albedoOf(Context& context, const reference::Model& model) {
  const std::string key =
      "albedo-" +
      base::Hasher().add(context.buildId()).addValue(model.surface.geometryTerm).addValue(model.surface.fresnel).hex();
  if (const auto cached = context.cache().find(key))
    if (auto table = reference::DirectionalAlbedo::fromBytes(*cached)) return std::move(*table);
  reference::DirectionalAlbedo table(model.surface.geometryTerm, model.surface.fresnel);
  context.cache().store(key, table.toBytes());
  return table;
}

} // namespace

ReferencePath::ReferencePath(Context& context, const PreparedScene& prepared, const Settings& settings,
                             const gpu::SceneBuffers& buffers, const std::vector<gpu::BinKind>& binKinds,
                             std::uint64_t expectedEntries, const gpu::Compilation& compilation)
    : m_context(context), m_prepared(prepared), m_settings(settings),
      m_materials(context.device(), buffers, binKinds, expectedEntries, compilation), m_termCount(buffers.termCount()) {
  if (context.cache().enabled()) m_lightKey = makeLightKey(context.buildId(), prepared, settings);
}

std::string ReferencePath::keyOf(const std::vector<reference::SurfaceSample>& samples) const {
  return "reference-" + base::Hasher().add(m_lightKey).add(std::as_bytes(std::span{samples})).hex();
}

std::vector<reference::ShadedSample> ReferencePath::integrate(const std::vector<reference::SurfaceSample>& samples,
                                                              const reference::Progress& progress) {
  reference::Options options = m_settings.reference;
  if (m_prepared.panorama && !m_sampler)
    m_sampler = std::make_unique<reference::EnvironmentSampler>(*m_prepared.panorama);
  const bool hasCoat = std::ranges::any_of(samples, [](const auto& sample) { return sample.coat > 0; });
  const bool looksThrough = std::ranges::any_of(samples, reference::isPassedThrough);
  const auto isBody = [](const reference::SurfaceSample& sample) {
    return sample.transmission > 0 && sample.thickness > 0;
  };
  if ((options.model.needsAlbedo() || hasCoat || looksThrough) && !m_albedo)
    m_albedo = std::make_unique<reference::DirectionalAlbedo>(albedoOf(m_context, options.model));
  if (!m_sheenAlbedo && std::ranges::any_of(samples, reference::hasSheen))
    m_sheenAlbedo = std::make_unique<reference::SheenAlbedo>();
  const bool castsShadows = m_settings.shadows || options.bounces > 0;
  if ((castsShadows || looksThrough) && !m_visibility)
    m_visibility = std::make_unique<lighting::Visibility>(m_prepared.scene);
  const bool castersTransmit = std::ranges::any_of(
      m_prepared.scene.materials, [](const auto& m) { return m.castsShadow() && m.hasTransmission(); });
  if (looksThrough && castersTransmit && !m_behind)
    m_behind = std::make_unique<lighting::Visibility>(m_prepared.scene, lighting::Visibility::Contents::behind);
  if (!m_bodies && std::ranges::any_of(samples, isBody))
    m_bodies = std::make_unique<lighting::Visibility>(m_prepared.scene, lighting::Visibility::Contents::bodies);
  if ((options.bounces > 0 || looksThrough) && !m_surfaces) {
    m_surfaces = std::make_unique<lighting::SurfaceLight>(m_prepared.scene);
    m_emitters = std::make_unique<lighting::Emitters>(m_prepared.scene, *m_surfaces);
  }
  const reference::Inputs inputs{.environment = m_sampler.get(),
                                 .albedo = m_albedo.get(),
                                 .lights = m_prepared.lights,
                                 .visibility = castsShadows ? m_visibility.get() : nullptr,
                                 .surfaces = m_surfaces.get(),
                                 .emitters = m_emitters.get(),
                                 .sheenAlbedo = m_sheenAlbedo.get(),
                                 .behind = !looksThrough ? nullptr
                                           : m_behind    ? m_behind.get()
                                                         : m_visibility.get(),
                                 .bodies = m_bodies.get()};
  return reference::shade(samples, inputs, options, progress);
}

ReferenceSurface ReferencePath::shade(const gpu::Surface& surface, const scenes::Camera& camera, std::uint32_t stream,
                                      const reference::Progress& progress) {
  const std::vector<gpu::ResolvedMaterial> materials = m_materials.resolve(surface, camera);
  const std::vector<reference::SurfaceSample> samples = samplesOf(surface, materials, stream);
  std::vector<reference::ShadedSample> points(samples.size());
  const std::size_t bytes = points.size() * sizeof(reference::ShadedSample);
  const std::string key = m_context.cache().enabled() ? keyOf(samples) : std::string();
  if (const auto cached = key.empty() ? std::nullopt : m_context.cache().find(key); cached && cached->size() == bytes) {
    std::memcpy(points.data(), cached->data(), bytes);
  } else {
    points = integrate(samples, progress);
    if (!key.empty()) m_context.cache().store(key, std::as_bytes(std::span{points}));
  }

  // After the cache: how far away a point is decides nothing else.
  if (const auto& fog = m_prepared.scene.fog)
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = reference::seenThrough(reference::fogBetween(*fog, camera, materials[i].position), points[i]);

  ReferenceSurface result;
  std::vector<glm::vec4> colors;
  std::vector<std::vector<glm::vec4>> terms(m_settings.terms ? m_termCount : 0);
  for (auto& plane : terms) plane.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    glm::vec3 color(0);
    for (const glm::vec3& term : points[i].terms) color += term;
    colors.emplace_back(color, materials[i].opacity);
    for (std::size_t t = 0; t < terms.size(); ++t) terms[t].emplace_back(points[i].terms[t], 0.f);
    result.standardErrors.push_back(points[i].standardError);
    result.samples.push_back(points[i].samples);
    result.sampledPoints += points[i].samples > 0;
    result.lightSamples += points[i].samples;
  }
  result.shaded.color = std::move(colors);
  std::ranges::move(terms, std::back_inserter(result.shaded.terms));
  return result;
}

ErrorBuilder::ErrorBuilder(int width, int height, int samples)
    : m_samples(samples), m_squares(static_cast<std::size_t>(width) * height, 0.0), m_error(width, height, 1),
      m_taken(width, height, 1) {}

void ErrorBuilder::begin(const gpu::Tile& tile) {
  const auto width = static_cast<std::size_t>(m_error.width);
  m_firstPixel = tile.firstRow * width;
  m_sample.assign(tile.rows * width, 0.0);
}

void ErrorBuilder::lay(const gpu::Surface& surface, const ReferenceSurface& shaded) {
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::uint32_t pixel = surface.pixels[i];
    const double opacity = surface.blended ? shaded.shaded.color[i].w : 1;
    const double error = opacity * shaded.standardErrors[i];
    double& square = m_sample[pixel - m_firstPixel];
    square = (1 - opacity) * (1 - opacity) * square + error * error;
    m_taken.pixels[pixel] += static_cast<float>(shaded.samples[i]);
  }
}

void ErrorBuilder::end() {
  for (std::size_t p = 0; p < m_sample.size(); ++p) m_squares[m_firstPixel + p] += m_sample[p];
}

base::Image ErrorBuilder::take(const base::Image& color) const {
  base::Image error = m_error;
  for (std::size_t p = 0; p < m_squares.size(); ++p) {
    const float* rgb = color.pixels.data() + 3 * p;
    if (m_squares[p] > 0)
      error.pixels[p] = static_cast<float>(std::sqrt(m_squares[p]) / m_samples / std::max({rgb[0], rgb[1], rgb[2]}));
  }
  return error;
}

} // namespace parity::job

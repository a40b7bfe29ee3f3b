// Two entries a result, as ccache has it: the names of the files under the key of the options, the result itself under
// that key and the content of those files.
#include "job/result_cache.h"

#include <hwy/targets.h>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "job/archive.h"
#include "job/version.h"

namespace parity::scenes {

using job::Is;

template <Is<SunRequest> T> auto fields(T& sun) {
  auto& [azimuthDeg, elevationDeg, lux] = sun;
  return std::tie(azimuthDeg, elevationDeg, lux);
}
template <Is<LightScales> T> auto fields(T& scales) {
  auto& [sky, indirect, directionalSpecular] = scales;
  return std::tie(sky, indirect, directionalSpecular);
}
template <Is<Fog> T> auto fields(T& fog) {
  auto& [density, heightFalloff, height, color, startDistance, maxOpacity] = fog;
  return std::tie(density, heightFalloff, height, color, startDistance, maxOpacity);
}
template <Is<ViewRequest> T> auto fields(T& view) {
  auto& [name, camera, orbit, target, fovYDeg] = view;
  return std::tie(name, camera, orbit, target, fovYDeg);
}
template <Is<LoadOptions> T> auto fields(T& load) {
  auto& [timeSeconds, animation, scene, variant, allMaterials, maxImageSide, maxImageTexels, maxMemoryBytes] = load;
  return std::tie(timeSeconds, animation, scene, variant, allMaterials, maxImageSide, maxImageTexels, maxMemoryBytes);
}
// All but the budgets.
template <Is<SuiteEntry> T> auto fields(T& entry) {
  auto& [name, scene, load, subject, environment, environmentRotationDeg, extractSun, sun, lightScales, fog, baked,
         captures, shadows, views, fullyRough, budgets, exposureEv] = entry;
  return std::tie(name, scene, load, subject, environment, environmentRotationDeg, extractSun, sun, lightScales, fog,
                  baked, captures, shadows, views, fullyRough, exposureEv);
}

} // namespace parity::scenes

namespace parity::mobile {

template <job::Is<Options> T> auto fields(T& options) {
  auto& [preset, environmentBrdf, directLobe, captureScale, capture, skyCoefficients, localLights, spotShadow,
         roughnessFloor, precision] = options;
  return std::tie(preset, environmentBrdf, directLobe, captureScale, capture, skyCoefficients, localLights, spotShadow,
                  roughnessFloor, precision);
}

} // namespace parity::mobile

namespace parity::highend {

template <job::Is<Options> T> auto fields(T& options) {
  auto& [geometryTerm, fresnel, diffuse, compensation, offSpecular] = options;
  return std::tie(geometryTerm, fresnel, diffuse, compensation, offSpecular);
}

} // namespace parity::highend

namespace parity::reference {

using job::Is;

template <Is<Model> T> auto fields(T& model) {
  auto& [geometryTerm, fresnel, diffuse, scattering] = model;
  return std::tie(geometryTerm, fresnel, diffuse, scattering);
}
template <Is<IntegralOptions> T> auto fields(T& options) {
  auto& [relativeError, minSamples, maxSamples, seed] = options;
  return std::tie(relativeError, minSamples, maxSamples, seed);
}
template <Is<Options> T> auto fields(T& options) {
  auto& [model, integral] = options;
  return std::tie(model, integral);
}

} // namespace parity::reference

namespace parity::gpu {

template <job::Is<ShadowOptions> T> auto fields(T& options) {
  auto& [mapSize, filter, maxBytes] = options;
  return std::tie(mapSize, filter, maxBytes);
}

} // namespace parity::gpu

namespace parity::job {

// All but the budgets and what they lead to be attributed, the cache itself, and the choice of a device, in whose place
// stands the device.
template <Is<Settings> T> auto fields(T& settings) {
  auto& [width, height, samples, exposureEv, display, background, materials, fullyRough, budgets, metrics, terms,
         coverage, attribution, droppedLights, costs, extractSun, truth, mobileOptions, mobileView, mobileTarget,
         mobileTextures, specularAa, highendOptions, referenceOptions, shadows, shadowMaps, device, cacheFolder,
         cacheBytes] = settings;
  return std::tie(width, height, samples, exposureEv, display, background, materials, fullyRough, metrics, terms,
                  coverage, droppedLights, costs, extractSun, truth, mobileOptions, mobileView, mobileTarget,
                  mobileTextures, specularAa, highendOptions, referenceOptions, shadows, shadowMaps);
}

namespace {

std::string hashOf(const std::filesystem::path& file) { return base::Hasher().add(base::readFile(file)).hex(); }

// Where a link leads is part of what a scene is: links out of its folder are refused.
std::string placeOf(const std::filesystem::path& file, const SceneRequest& request) {
  const std::filesystem::path folder = std::filesystem::path(request.scene).parent_path();
  return std::filesystem::canonical(file)
      .lexically_relative(std::filesystem::canonical(folder.empty() ? "." : folder))
      .string();
}

std::string contentKey(const std::string& key, const SceneRequest& request,
                       const std::vector<scenes::SourceFile>& sources) {
  base::Hasher hasher;
  hasher.add(key);
  for (const scenes::SourceFile& source : sources)
    hasher.add(source.file.string()).add(placeOf(source.file, request)).add(source.hash);
  return "scene-" + hasher.hex();
}

} // namespace

std::optional<std::string> resultKey(Context& context, const SceneRequest& request, const ResultWish& wish) {
  const Settings& settings = context.settings();
  if (!context.cache().enabled() || settings.device.validation) return std::nullopt;
  const gpu::DeviceReport& device = context.deviceReport();
  Writer write;
  write(std::string(kVersion));
  write(context.buildId());
  for (const std::string& text : {device.name, device.driver, device.build}) write(text);
  write(static_cast<std::int64_t>(hwy::SupportedTargets())); // what the metrics run on
  write(settings);
  write(request);
  write(wish.statistics);
  write(wish.pictures);
  write(wish.pixelData);
  write(static_cast<std::uint64_t>(wish.permutations.own));
  write(wish.permutations.shares);
  try {
    if (!request.environment.empty() && !request.environment.starts_with("builtin:"))
      write(hashOf(request.environment));
    // It names every other file of the bake, by content.
    if (!request.baked.empty()) write(hashOf(std::filesystem::path(request.baked) / bake::kManifestFile));
  } catch (const base::Error&) { // loading it will say so
    return std::nullopt;
  }
  return base::Hasher().add(write.bytes()).hex();
}

std::string attributedKey(const std::string& key, const std::vector<std::vector<std::size_t>>& materials) {
  base::Hasher hasher;
  hasher.add(key).add("attributed");
  for (std::size_t view = 0; view < materials.size(); ++view)
    for (const std::size_t material : materials[view]) hasher.add(std::to_string(view)).add(std::to_string(material));
  return hasher.hex();
}

std::optional<SceneRecord> findResult(const base::Cache& cache, const std::string& key, const SceneRequest& request) {
  const auto manifest = cache.find("files-" + key);
  if (!manifest) return std::nullopt;
  std::vector<scenes::SourceFile> sources;
  std::string wanted;
  try {
    Reader read(*manifest);
    std::vector<std::string> files;
    read(files);
    for (const std::string& file : files) sources.push_back({file, hashOf(file)});
    wanted = contentKey(key, request, sources);
  } catch (const std::exception&) { // a file is gone: loading the scene will say so, if it still needs it
    return std::nullopt;
  }
  const auto bytes = cache.find(wanted);
  return bytes ? recordFromBytes(*bytes) : std::nullopt;
}

void storeResult(const base::Cache& cache, const std::string& key, const SceneRequest& request,
                 const std::vector<scenes::SourceFile>& sources, const SceneRecord& record) {
  std::vector<std::string> files;
  for (const scenes::SourceFile& source : sources) files.push_back(source.file.string());
  std::string wanted;
  try {
    wanted = contentKey(key, request, sources);
  } catch (const std::filesystem::filesystem_error&) { // a file is gone since
    return;
  }
  Writer write;
  write(files);
  if (cache.store(wanted, toBytes(record))) cache.store("files-" + key, write.bytes());
}

} // namespace parity::job

// The rows. Each struct is taken apart by a structured binding: a member that is added later does not compile until it
// has its row, or a reason to have none.
#include "job/conditions.h"

#include <filesystem>

#include <fmt/format.h>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "job/condition_text.h"
#include "job/truth_comparison.h"
#include "mobile/renderer.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

using compare::ActsOn;
using compare::Condition;

class Rows {
public:
  template <typename T> Condition& add(const char* name, const T& value, ActsOn actsOn = ActsOn::figures) {
    return m_rows.emplace_back(Condition{name, valueText(value), actsOn});
  }
  // Decides what else the result holds, and no figure: of the cache's key alone.
  template <typename T> void addUnseen(const char* name, const T& value) { add(name, value, ActsOn::nothing); }
  std::vector<Condition> take() { return std::move(m_rows); }

private:
  std::vector<Condition> m_rows;
};

void addHighend(Rows& rows, const highend::Options& options) {
  const auto& [geometryTerm, fresnel, diffuse, compensation, offSpecular] = options;
  rows.add("highend geometry term", nameAt(highend::geometryTermNames(), geometryTerm));
  rows.add("highend fresnel", nameAt(highend::fresnelNames(), fresnel));
  rows.add("highend diffuse", nameAt(highend::diffuseNames(), diffuse));
  rows.add("highend compensation", nameAt(highend::compensationNames(), compensation));
  rows.add("highend off-specular", nameAt(highend::offSpecularNames(), offSpecular));
}

void addMobile(Rows& rows, const mobile::Options& options, const gpu::DeviceReport& device) {
  const auto& [preset, environmentBrdf, directLobe, captureScale, mixing, capture, sky, localLights, spotShadow,
               spotShadowSharpen, spotShadowFade, sunShadow, sunShadowDistance, sunShadowFade, roughnessFloor,
               precision] = options;
  rows.add("mobile preset", preset);
  rows.add("mobile environment BRDF", nameAt(mobile::environmentBrdfNames(), environmentBrdf));
  rows.add("mobile direct lobe", nameAt(mobile::directLobeNames(), directLobe));
  rows.add("mobile capture scale", nameAt(mobile::captureScaleNames(), captureScale));
  const auto& [begin, end, largest] = mixing;
  rows.add("mobile mixing weight", fmt::format("of roughness {} to {}, at most {}", begin, end, largest));
  rows.add("mobile capture", nameAt(mobile::captureEncodingNames(), capture));
  const std::string skyForm = nameAt(mobile::skyFormNames(), sky);
  rows.add("mobile sky", skyForm).words = sky == mobile::SkyForm::tinted
                                              ? "9 SH coefficients, one tint for the second band"
                                              : fmt::format("{} SH coefficients", skyForm);
  rows.add("mobile local lights", localLights);
  rows.add("mobile spot shadow",
           spotShadow ? fmt::format("on, sharpen {}, fade {}", spotShadowSharpen, spotShadowFade) : "off");
  rows.add("mobile sun shadow", !sunShadow ? "off, but the baked one"
                                           : fmt::format("by a map, gone from {} m on, over the last share of {}",
                                                         sunShadowDistance, sunShadowFade));
  rows.add("mobile roughness floor", roughnessFloor);
  const mobile::Precision taken = mobile::precisionOn(device, options);
  rows.add("mobile precision", nameAt(mobile::precisionNames(), taken)).words = describePrecision(precision, taken);
}

void addShadowMaps(Rows& rows, const gpu::ShadowOptions& options) {
  const auto& [mapSize, filter, maxBytes] = options;
  rows.add("shadow maps", fmt::format("{} texels, filter of {}", mapSize, filter));
  rows.add("memory of shadow maps", maxBytes).words = fmt::format("{} MiB at most", maxBytes >> 20);
}

// One row: of the figures against the truth, which nothing is judged by.
void addTruth(Rows& rows, const Settings& settings) {
  const auto& [model, integral, bounces] = settings.reference; // bounces: in defaultConditions
  const auto& [geometryTerm, fresnel, diffuse, scattering] = model;
  const auto& [relativeError, minSamples, maxSamples, seed] = integral;
  rows.add("truth",
           fmt::format("{}, {}, {}, {} scattering, relative error {}, {} to {} samples, seed {}",
                       nameAt(highend::geometryTermNames(), geometryTerm), nameAt(highend::fresnelNames(), fresnel),
                       nameAt(highend::diffuseNames(), diffuse),
                       scattering == reference::Scattering::multiple ? "multiple" : "single", relativeError, minSamples,
                       maxSamples, seed),
           ActsOn::truth)
      .words = describeTruth(settings);
}

// How much of a file is loaded, and what of it.
void addLoad(Rows& rows, const scenes::LoadOptions& load) {
  const auto& [timeSeconds, animation, scene, variant, allMaterials, maxImageSide, maxImageTexels, maxMemoryBytes] =
      load;
  rows.add("time", timeSeconds).words = fmt::format("{} s", timeSeconds);
  rows.add("animation", quotedOr(animation, "all"));
  rows.add("scene of the file", quotedOr(scene, "the default"));
  rows.add("variant", quotedOr(variant, "none"));
  rows.addUnseen("unused materials", allMaterials);
  rows.addUnseen("limit of an image's side", maxImageSide);
  rows.addUnseen("limit of all images", maxImageTexels);
  rows.addUnseen("limit of memory", maxMemoryBytes);
}

void addLight(Rows& rows, const scenes::LightScales& scales, const std::optional<scenes::Fog>& fog) {
  const auto& [skyLightColor, indirectColorScale, directionalSpecularScale] = scales;
  rows.add("sky light color", skyLightColor);
  rows.add("indirect color scale", indirectColorScale);
  rows.add("directional specular scale", directionalSpecularScale);
  const auto& [density, heightFalloff, height, color, startDistance, maxOpacity] = fog.value_or(scenes::Fog());
  rows.add("fog", !fog || !fog->isSeen()
                      ? "none"
                      : fmt::format("density {}, falloff {}, height {}, color {}, start {}, opacity {}", density,
                                    heightFalloff, height, valueText(color), startDistance, maxOpacity));
}

std::string contentOf(const std::filesystem::path& file) {
  try {
    return base::Hasher().add(base::readFile(file)).hex();
  } catch (const base::Error&) { // loading it will say so
    return "not readable";
  }
}

// A file or folder by its content, and for people by its name, too; from an absolute path no more than that is said.
void addContent(Rows& rows, const char* name, const std::string& path, const std::filesystem::path& file) {
  const std::filesystem::path given(path), own = given.has_filename() ? given : given.parent_path(); // "folder/"
  const std::string content = contentOf(file);
  rows.add(name, content).words =
      fmt::format("{} (content {})", scenes::cleanName(own.filename().string()), content.substr(0, 12));
}

void addEnvironment(Rows& rows, const std::string& environment) {
  if (environment.empty() || environment.starts_with("builtin:"))
    rows.add("environment", environment.empty() ? "not given" : environment);
  else
    addContent(rows, "environment", environment, environment);
}

void addBaked(Rows& rows, const std::string& folder) {
  if (folder.empty())
    rows.add("baked light", "none");
  else // the manifest names every other file of the bake by content
    addContent(rows, "baked light", folder, std::filesystem::path(folder) / bake::kManifestFile);
}

std::vector<Condition> sceneConditions(const Settings& settings, const SceneRequest& request) {
  Rows rows;
  // Not here: views have lists of their own; extractSun, shadows, interreflection, fullyRough and exposureEv are in
  // defaultConditions;
  // budgets judge afterwards.
  const auto& [name, scene, load, subject, environment, environmentRotationDeg, extractSun, sun, lightScales, falloff,
               fog, baked, captures, shadows, interreflection, views, fullyRough, budgets, exposureEv] = request;
  rows.addUnseen("name", name);
  rows.addUnseen("file", scene); // its content is looked at when it is known which files are read
  addLoad(rows, load);
  rows.add("subject", subject == scenes::Subject::ball ? "ball" : "scene");
  addEnvironment(rows, environment);
  rows.addUnseen("file of the environment", environment); // as warnings name it
  rows.add("environment rotation", environmentRotationDeg);
  if (sun) {
    const auto& [azimuthDeg, elevationDeg, lux] = *sun;
    rows.add("sun", fmt::format("{},{},{}", azimuthDeg, elevationDeg, lux));
  } else {
    rows.add("sun", "none");
  }
  addLight(rows, lightScales, fog);
  rows.add("falloff", nameAt(scenes::falloffNames(), falloff));
  addBaked(rows, baked);
  rows.addUnseen("folder of the baked light", baked);
  rows.addUnseen("places of captures", captures); // `parity bake` alone reads them
  std::vector<Condition> conditions = rows.take(), defaults = defaultConditions(settings, request);
  conditions.insert(conditions.end(), defaults.begin(), defaults.end());
  return conditions;
}

std::vector<Condition> viewConditions(const scenes::ViewRequest& view) {
  Rows rows;
  const auto& [name, camera, orbit, target, fovYDeg] = view;
  rows.addUnseen("view", name);
  rows.add("camera", camera == "auto" ? "automatic" : quotedOr(camera, "automatic"));
  rows.add("orbit", orbit ? valueText(*orbit) : "not given");
  rows.add("target", target ? valueText(*target) : "not given");
  rows.add("field of view", fovYDeg);
  return rows.take();
}

} // namespace

std::vector<Condition> runConditions(const Settings& settings, const gpu::DeviceReport& device) {
  Rows rows;
  // Not here: exposureEv, fullyRough, extractSun and shadows are in defaultConditions; budgets and attribution judge
  // afterwards; the report names the device, and the cache's key holds it; the cache decides nothing.
  const auto& [width, height, samples, exposureEv, display, background, materials, fullyRough, budgets, metrics, terms,
               coverage, attribution, droppedLights, costs, extractSun, truth, mobileOptions, highendView, mobileView,
               mobileTarget, mobileTextures, specularAa, highendOptions, referenceOptions, shadows, shadowMaps,
               deviceOptions, cacheFolder, cacheBytes] = settings;
  rows.add("size", fmt::format("{}x{}", width, height));
  rows.add("samples", samples);
  rows.add("display", display);
  rows.add("background", background);
  rows.add("materials", listOr(materials, "all"), ActsOn::wholes).words = wordsOf(materials, "all");
  rows.add("specular anti-aliasing", specularAa == gpu::SpecularAa::toksvig ? "Toksvig" : "off");
  addShadowMaps(rows, shadowMaps);
  addHighend(rows, highendOptions);
  addMobile(rows, mobileOptions, device);
  rows.add("high-end view", highend::kViews.at(highendView).name);
  rows.add("mobile view", mobile::kViews.at(mobileView).name);
  rows.add("mobile target", nameAt(gpu::outputTargetNames(), mobileTarget)).words = describeTarget(mobileTarget);
  rows.add("mobile textures", nameAt(base::textureBlockNames(), mobileTextures)).words =
      describeTextures(mobileTextures);
  rows.addUnseen("metrics", metrics);
  rows.addUnseen("terms", terms);
  rows.addUnseen("coverage", coverage);
  rows.addUnseen("dropped lights", droppedLights);
  rows.addUnseen("costs", costs);
  if (truth) addTruth(rows, settings); // else none of referenceOptions acts
  return rows.take();
}

std::vector<Condition> defaultConditions(const Settings& settings, const SceneRequest& request) {
  Rows rows;
  const float exposureEv = request.exposureEv.value_or(settings.exposureEv);
  rows.add("exposure", exposureEv).words = fmt::format("{} EV", exposureEv);
  rows.add("sun extraction", request.extractSun && settings.extractSun);
  rows.add("shadows", request.shadows.value_or(settings.shadows));
  const int bounces = request.interreflection.value_or(settings.reference.bounces);
  if (settings.truth && bounces > 0) rows.add("interreflection", bounces, ActsOn::truth);
  std::vector<std::string> fullyRough = request.fullyRough;
  fullyRough.insert(fullyRough.end(), settings.fullyRough.begin(), settings.fullyRough.end());
  rows.add("fully rough", listOr(fullyRough, "none")).words = wordsOf(fullyRough, "none");
  return rows.take();
}

Conditions conditionsOf(const Settings& settings, const SceneRequest& request, const gpu::DeviceReport& device) {
  Conditions conditions{runConditions(settings, device), sceneConditions(settings, request), {}};
  for (const scenes::ViewRequest& view : request.views) conditions.views.push_back(viewConditions(view));
  return conditions;
}

std::vector<Condition> reported(const std::vector<Condition>& conditions) {
  std::vector<Condition> some;
  for (const Condition& condition : conditions)
    if (condition.actsOn != ActsOn::nothing) some.push_back(condition);
  return some;
}

std::string hashOf(const Conditions& conditions) {
  base::Hasher hasher;
  const auto add = [&](const std::vector<Condition>& list) {
    hasher.addValue(list.size());
    for (const Condition& condition : list) hasher.add(condition.name).add(condition.value);
  };
  add(conditions.run);
  add(conditions.scene);
  for (const std::vector<Condition>& view : conditions.views) add(view);
  return hasher.hex();
}

} // namespace parity::job

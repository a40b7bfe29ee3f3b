#include "job/prepared_scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/component_wise.hpp>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/glob.h"
#include "base/parallel.h"
#include "job/baked_scene.h"
#include "lighting/sun_extraction.h"
#include "mobile/light_choice.h"
#include "scenes/load.h"
#include "scenes/material_balls.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

void applyFullyRough(scenes::Scene& scene, const std::vector<std::string>& globs) {
  for (const std::string& glob : globs) {
    bool matched = false;
    for (scenes::Material& material : scene.materials)
      if (base::matchesGlob(glob, material.name)) material.fullyRough = matched = true;
    if (!matched)
      throw base::Error(base::ExitCode::usage, scene.name, fmt::format("fully rough '{}'", glob),
                        "no material has such a name");
  }
}

bool givesLight(const scenes::Material& m) {
  return m.unlit || std::max({m.emissive.x, m.emissive.y, m.emissive.z}) > 0;
}

// What the request says about the scene's light as a whole.
void applySceneLight(PreparedScene& prepared, const SceneRequest& request) {
  prepared.scene.lightScales = request.lightScales;
  if (request.fog && request.fog->isSeen()) prepared.scene.fog = request.fog;
  for (auto* lights : {&prepared.lights, &prepared.mobileLights})
    for (scenes::Light& light : *lights)
      if (light.kind == scenes::LightKind::directional)
        light.specularScale *= request.lightScales.directionalSpecularScale;
  if (!prepared.panorama || request.lightScales.skyLightColor == glm::vec3(1)) return;
  std::vector<float>& pixels = prepared.panorama->radiance.pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] *= request.lightScales.skyLightColor[static_cast<int>(i % 3)];
}

// Whether any texel of the lightmap or any capture gives light.
bool isLitByBake(const bake::BakedLight& baked) {
  const auto isLit = [](const auto& page) {
    for (std::size_t i = 0; i < page.pixelCount() / 2; ++i) // the upper half: irradiance, and 1 as alpha
      for (std::size_t c = 0; c < 3; ++c)
        if (page.pixels[4 * i + c] != 0) return true;
    return false;
  };
  return std::any_of(baked.highend.begin(), baked.highend.end(), isLit) ||
         std::any_of(baked.captures.begin(), baked.captures.end(),
                     [](const auto& capture) { return capture.averageBrightness() > 0; });
}

// Black pictures are alike by any metric: a scene that nothing lights is refused, not passed.
void requireLight(PreparedScene& prepared, const std::string& file) {
  if (prepared.baked && isLitByBake(*prepared.baked)) return;
  // Band 0 of the irradiance is the environment's mean: a black one gives no light.
  const glm::vec3 scale = prepared.scene.lightScales.skyLightColor;
  const auto shines = [&](const auto& environment) {
    return environment && glm::compMax(environment->irradianceSh[0] * scale) > 0;
  };
  const bool sky = shines(prepared.environment) || shines(prepared.mobileEnvironment) ||
                   (prepared.panorama &&
                    std::any_of(prepared.panorama->radiance.pixels.begin(), prepared.panorama->radiance.pixels.end(),
                                [](float value) { return value > 0; }));
  const bool lit = sky || std::any_of(prepared.lights.begin(), prepared.lights.end(), [](const scenes::Light& l) {
                     return std::max({l.color.x, l.color.y, l.color.z}) > 0;
                   });
  if (lit) return;
  if (std::none_of(prepared.scene.materials.begin(), prepared.scene.materials.end(), givesLight))
    throw base::fileError(file, "light",
                          "the scene has neither light nor environment (or a black one); give --env or --sun");
  prepared.scene.warnings.emplace_back(
      "no light and no environment (or a black one): only emissive and unlit materials are seen");
}

float luminanceOf(const glm::vec3& c) { return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

std::string describe(const lighting::SunExtraction& extraction) {
  const scenes::Light& sun = extraction.suns.front().light;
  const glm::vec3 towards = -sun.direction;
  std::string text = fmt::format("extracted from {}: azimuth {:.2f}, elevation {:.2f}, {:.4g} lux",
                                 extraction.environment.name, glm::degrees(std::atan2(towards.z, towards.x)),
                                 glm::degrees(std::asin(std::clamp(towards.y, -1.f, 1.f))), luminanceOf(sun.color));
  if (extraction.suns.size() > 1) text += fmt::format(", and {} fainter", extraction.suns.size() - 1);
  return text;
}

bool isLit(const scenes::Scene& scene) {
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const scenes::Instance& instance) {
    return !scene.materials[scene.meshes[instance.mesh].material].unlit;
  });
}

lighting::SunExtraction extractSuns(Context& context, const SceneRequest& request, scenes::Environment environment,
                                    Work& work) {
  if (!request.extractSun || !context.settings().extractSun) return {.environment = std::move(environment), .suns = {}};
  const base::Stopwatch watch(&context.timings(), "sun extraction");
  ++work.sunSearches;
  return lighting::extractSuns(std::move(environment));
}

// To `lights`, which all paths have, come what was extracted, and the environments that go with them.
void addEnvironment(Context& context, lighting::SunExtraction extraction, const Paths& paths, PreparedScene& prepared) {
  const std::vector<lighting::ExtractedSun>& suns = extraction.suns;
  const std::size_t own = prepared.lights.size();
  for (const lighting::ExtractedSun& sun : suns) prepared.lights.push_back(sun.light);
  std::optional<std::size_t> mobileSun;
  if (const auto brightest = mobile::chooseSun(prepared.lights); brightest >= own) {
    mobileSun = *brightest - own;
    prepared.mobileLights.push_back(prepared.lights[*brightest]);
  }
  const bool isReplaced = paths.bakes || (prepared.baked && !prepared.baked->captures.empty());
  if (paths.highend && !isReplaced) {
    ++prepared.work.prefilteredMaps;
    prepared.environment = context.environmentLight(extraction.environment, lighting::kFinePrefilter);
    prepared.cells =
        std::make_shared<const lighting::PanoramaCells>(lighting::makePanoramaCells(extraction.environment));
  }
  if (paths.mobile && !isReplaced) {
    ++prepared.work.prefilteredMaps;
    prepared.mobileEnvironment = context.environmentLight(lighting::putBackSuns(extraction, mobileSun),
                                                          {.levels = lighting::PrefilterLevels::first});
  }
  if (!suns.empty()) {
    const std::string text = describe(extraction);
    prepared.sunText = prepared.sunText == "none" ? text : prepared.sunText + "; " + text;
  }
  if (paths.reference || paths.bakes || prepared.baked) prepared.panorama = std::move(extraction.environment);
}

scenes::Scene loadSubject(const SceneRequest& request) {
  if (request.subject == scenes::Subject::scene) return scenes::loadScene(request.scene, request.load);
  scenes::LoadOptions options = request.load;
  options.allMaterials = true;
  return scenes::makeMaterialBalls(scenes::loadScene(request.scene, options));
}

} // namespace

PreparedScene prepareScene(Context& context, const SceneRequest& request, const Paths& paths) {
  PreparedScene prepared;
  prepared.exposureEv = request.exposureEv.value_or(context.settings().exposureEv);
  prepared.shadows = request.shadows.value_or(context.settings().shadows);
  prepared.bounces = request.interreflection.value_or(context.settings().reference.bounces);
  std::optional<scenes::Environment> panorama;
  std::vector<std::string> warnings;
  base::parallelInvoke({
      [&] {
        const base::Stopwatch watch(&context.timings(), "load scene");
        prepared.scene = loadSubject(request);
      },
      [&] {
        if (request.environment.empty()) return;
        const auto loaded = context.environment(request.environment, request.environmentRotationDeg, request.load);
        panorama = loaded->environment;
        warnings = loaded->warnings;
      },
  });
  if (!request.baked.empty() && !paths.bakes) {
    if (paths.reference)
      throw base::Error(base::ExitCode::usage, "--baked", request.baked, "the reference knows of no baked light");
    const base::Stopwatch watch(&context.timings(), "read baked light");
    prepared.baked = std::make_shared<const bake::BakedLight>(bake::readBaked(request.baked));
  }
  scenes::Scene& scene = prepared.scene;
  for (scenes::Light& light : scene.lights)
    if (light.falloff != scenes::Falloff::exponent) light.falloff = request.falloff;
  if (!request.name.empty()) scene.name = request.name;
  scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  if (scene.instances.empty() || scene.triangleCount() == 0)
    throw base::fileError(request.scene, "scene", "it shows no triangles");

  if (!panorama && scene.environment) {
    // A built-in scene's own environment; the request's goes first.
    scene.environment->rotationDeg = request.environmentRotationDeg;
    panorama = std::move(scene.environment);
  }
  if (!request.environment.empty())
    prepared.environmentName = scenes::cleanName(std::filesystem::path(request.environment).filename().string());
  else
    prepared.environmentName = panorama ? panorama->name : "none";
  scene.environment.reset(); // its pixels are not needed any more

  prepared.lights = scene.lights;
  prepared.sunText = "none";
  if (request.sun) {
    prepared.lights.push_back(scenes::makeSun(*request.sun));
    prepared.sunText = fmt::format("{},{},{}", request.sun->azimuthDeg, request.sun->elevationDeg, request.sun->lux);
  }
  prepared.mobileLights = prepared.lights;
  prepared.isLit = isLit(scene);
  const bool hasSky = panorama.has_value();
  if (hasSky && prepared.isLit)
    addEnvironment(context, extractSuns(context, request, std::move(*panorama), prepared.work), paths, prepared);
  applySceneLight(prepared, request);
  applyFullyRough(scene, request.fullyRough);
  applyFullyRough(scene, context.settings().fullyRough);
  if (prepared.baked) {
    requireFresh(prepared, request.baked);
    takeBaked(prepared, prepared.baked);
    if (prepared.baked->localLights == bake::LocalLights::isStationary && !prepared.shadows)
      scene.warnings.emplace_back("the high-end path shades stationary lights without shadows; give --shadows");
    prepared.panorama.reset();
  }
  if (prepared.isLit || !hasSky) requireLight(prepared, request.scene); // an unlit scene's sky was not filtered
  return prepared;
}

std::function<void(int)> imageRelease(PreparedScene& prepared, const Paths& paths) {
  if (paths.reference && (prepared.shadows || prepared.bounces > 0)) return {};
  return [&prepared](int image) { prepared.scene.images[static_cast<std::size_t>(image)].pixels = {}; };
}

} // namespace parity::job

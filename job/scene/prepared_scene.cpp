#include "job/scene/prepared_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/component_wise.hpp>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/text/glob.h"
#include "job/scene/baked_scene.h"
#include "job/scene/material_choice.h"
#include "lighting/environment/sun_extraction.h"
#include "scenes/brightest_light.h"
#include "scenes/builtin/material_balls.h"
#include "scenes/load.h"
#include "scenes/luminance.h"
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
                        describeUnmatched(scene, glob));
  }
}

bool givesLight(const scenes::Material& m) {
  return m.unlit || std::max({m.emissive.x, m.emissive.y, m.emissive.z}) > 0;
}

// What the request says about the scene's light as a whole.
void applySceneLight(PreparedScene& prepared, const SceneRequest& request) {
  const scenes::SceneSettings& settings = request.settings.scene;
  prepared.scene.lightScales = settings.lightScales;
  if (settings.fog.isSeen()) prepared.scene.fog = settings.fog;
  const auto scale = [&](std::vector<scenes::Light>& lights) {
    for (scenes::Light& light : lights)
      if (light.kind == scenes::LightKind::directional) light.specularScale *= settings.lightScales.sunSpecularScale;
  };
  scale(prepared.lights);
  for (auto& [name, light] : prepared.lightOfPath) scale(light.lights);
  if (!prepared.panorama || settings.lightScales.skyLightColor == glm::vec3(1)) return;
  std::vector<float>& pixels = prepared.panorama->radiance.pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] *= settings.lightScales.skyLightColor[static_cast<int>(i % 3)];
}

// Whether any texel of the lightmap or any capture gives light.
bool isLitByBake(const bake::BakedLight& baked) {
  const auto isLit = [](const auto& page) {
    for (std::size_t i = 0; i < page.pixelCount() / 2; ++i) // the upper half: irradiance, and 1 as alpha
      for (std::size_t c = 0; c < 3; ++c)
        if (page.pixels[4 * i + c] != 0) return true;
    return false;
  };
  return std::any_of(baked.halfPages.begin(), baked.halfPages.end(), isLit) ||
         std::any_of(baked.captures.begin(), baked.captures.end(),
                     [](const auto& capture) { return capture.averageBrightness() > 0; });
}

// Black pictures are alike by any metric: a scene that nothing lights is refused, not passed.
void requireLight(PreparedScene& prepared, const std::string& file) {
  if (prepared.baked && isLitByBake(*prepared.baked)) return;
  // Band 0 of the irradiance is the environment's mean: a black one gives no light.
  const glm::vec3 scale = prepared.scene.lightScales.skyLightColor;
  const auto shines = [&](const auto& light) {
    const auto& environment = light.second.environment;
    return environment && glm::compMax(environment->irradianceSh[0] * scale) > 0;
  };
  const bool sky = std::ranges::any_of(prepared.lightOfPath, shines) ||
                   (prepared.panorama &&
                    std::any_of(prepared.panorama->radiance.pixels.begin(), prepared.panorama->radiance.pixels.end(),
                                [](float value) { return value > 0; }));
  const bool lit = sky || std::any_of(prepared.lights.begin(), prepared.lights.end(), [](const scenes::Light& l) {
                     return std::max({l.color.x, l.color.y, l.color.z}) > 0;
                   });
  if (lit) return;
  if (std::none_of(prepared.scene.materials.begin(), prepared.scene.materials.end(), givesLight))
    throw base::fileError(file, "light",
                          "the scene has no light and no environment, or only black ones; give --env or --sun");
  prepared.scene.warnings.emplace_back(
      "the scene has no light and no environment, or only black ones: only emissive and unlit materials are visible");
}

std::string describe(const lighting::SunExtraction& extraction) {
  const scenes::Light& sun = extraction.suns.front().light;
  const glm::vec3 towards = -sun.direction;
  std::string text =
      fmt::format("extracted from {}: azimuth {:.2f}, elevation {:.2f}, {:.4g} lux", extraction.environment.name,
                  glm::degrees(std::atan2(towards.z, towards.x)),
                  glm::degrees(std::asin(std::clamp(towards.y, -1.f, 1.f))), scenes::luminanceOf(sun.color));
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
  if (!request.settings.scene.extractSun) return {.environment = std::move(environment), .suns = {}};
  const base::Stopwatch watch(&context.timings(), "sun extraction");
  ++work.sunSearches;
  return lighting::extractSuns(std::move(environment));
}

// To `lights`, which all paths have, come what was extracted, and the environments that go with them.
// Another thread prepares them, if there is more than one.
void addEnvironment(Context& context, lighting::SunExtraction&& found, const PathChoice& paths,
                    PreparedScene& prepared) {
  const auto extraction = std::make_shared<lighting::SunExtraction>(std::move(found));
  const std::vector<lighting::ExtractedSun>& suns = extraction->suns;
  const std::size_t own = prepared.lights.size();
  for (const lighting::ExtractedSun& sun : suns) prepared.lights.push_back(sun.light);
  std::optional<std::size_t> oneSun;
  if (const auto brightest = scenes::brightestOf(prepared.lights, scenes::LightKind::directional); brightest >= own)
    oneSun = *brightest - own;
  std::vector<std::pair<std::string, paths::LightNeeds>> wanted;
  const bool isReplaced = paths.bakes || (prepared.baked && !prepared.baked->captures.empty());
  for (const paths::Path* path : paths.chosen) {
    const paths::LightNeeds needs = path->lightNeeds(prepared.settings.options);
    paths::Light& light = prepared.lightOfPath[path->name()];
    if (!needs.hasOneSun)
      light.lights = prepared.lights;
    else if (oneSun)
      light.lights.push_back(prepared.lights[own + *oneSun]);
    if (isReplaced) continue;
    ++prepared.work.prefilteredMaps;
    wanted.push_back({path->name(), needs});
    if (needs.cells)
      light.cells =
          std::make_shared<const lighting::PanoramaCells>(lighting::makePanoramaCells(extraction->environment));
  }
  if (!suns.empty()) {
    const std::string text = describe(*extraction);
    prepared.sunText = prepared.sunText == "none" ? text : prepared.sunText + "; " + text;
  }
  if (!wanted.empty())
    prepared.pendingEnvironments =
        decltype(prepared.pendingEnvironments)::begin([&context, extraction, oneSun, wanted] {
          std::map<std::string, std::shared_ptr<const lighting::EnvironmentLight>> made;
          for (const auto& [path, needs] : wanted)
            made[path] = needs.hasOneSun
                             ? context.environmentLight(lighting::putBackSuns(*extraction, oneSun), needs.prefilter)
                             : context.environmentLight(extraction->environment, needs.prefilter);
          return made;
        });
  if (!paths.truth && !paths.bakes && !prepared.baked) return;
  prepared.panorama = wanted.empty() ? std::move(extraction->environment) : extraction->environment;
}

scenes::Scene loadSubject(const SceneRequest& request) {
  if (request.settings.scene.subject == scenes::Subject::scene)
    return scenes::loadScene(request.scene, request.settings.scene.load);
  scenes::LoadOptions options = request.settings.scene.load;
  options.allMaterials = true;
  return scenes::makeMaterialBalls(scenes::loadScene(request.scene, options));
}

} // namespace

PreparedScene prepareScene(Context& context, const SceneRequest& request, const PathChoice& paths) {
  PreparedScene prepared = beginScene(context, request, paths);
  finishLight(prepared);
  return prepared;
}

bool isLightReady(const PreparedScene& prepared) {
  return !prepared.pendingEnvironments.isValid() || prepared.pendingEnvironments.isIdle();
}

void finishLight(PreparedScene& prepared) {
  if (const auto pending = std::exchange(prepared.pendingEnvironments, {}); pending.isValid())
    for (const auto& [path, environment] : pending.get()) prepared.lightOfPath[path].environment = environment;
  if (!prepared.pendingFile.empty()) requireLight(prepared, std::exchange(prepared.pendingFile, {}));
}

PreparedScene beginScene(Context& context, const SceneRequest& request, const PathChoice& paths) {
  PreparedScene prepared;
  prepared.settings = request.settings;
  const scenes::SceneSettings& settings = request.settings.scene;
  std::optional<scenes::Environment> panorama;
  std::vector<std::string> warnings;
  base::parallelInvoke({
      [&] {
        const base::Stopwatch watch(&context.timings(), "load scene");
        prepared.scene = loadSubject(request);
      },
      [&] {
        if (settings.environment.empty()) return;
        const auto loaded = context.environment(settings.environment, settings.environmentRotationDeg, settings.load);
        panorama = loaded->environment;
        warnings = loaded->warnings;
      },
  });
  if (!settings.baked.empty() && !paths.bakes) {
    if (paths.truth)
      throw base::Error(base::ExitCode::usage, "--baked", settings.baked, "the truth does not use baked light");
    const base::Stopwatch watch(&context.timings(), "read baked light");
    prepared.baked = std::make_shared<const bake::BakedLight>(bake::readBaked(settings.baked));
  }
  scenes::Scene& scene = prepared.scene;
  for (scenes::Light& light : scene.lights)
    if (light.falloff != scenes::Falloff::exponent) light.falloff = settings.falloff;
  if (!request.name.empty()) scene.name = request.name;
  scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  if (scene.instances.empty() || scene.triangleCount() == 0)
    throw base::fileError(request.scene, "scene", "the scene has no triangles");

  if (!panorama && scene.environment) {
    // A built-in scene's own environment; the request's goes first.
    scene.environment->rotationDeg = settings.environmentRotationDeg;
    panorama = std::move(scene.environment);
  }
  if (!settings.environment.empty())
    prepared.environmentName = scenes::cleanName(std::filesystem::path(settings.environment).filename().string());
  else
    prepared.environmentName = panorama ? panorama->name : "none";
  scene.environment.reset(); // its pixels are not needed any more

  prepared.lights = scene.lights;
  prepared.sunText = "none";
  if (settings.sun) {
    prepared.lights.push_back(scenes::makeSun(*settings.sun));
    prepared.sunText = fmt::format("{},{},{}", settings.sun->azimuthDeg, settings.sun->elevationDeg, settings.sun->lux);
  }
  for (const paths::Path* path : paths.chosen) prepared.lightOfPath[path->name()].lights = prepared.lights;
  prepared.isLit = isLit(scene);
  const bool hasSky = panorama.has_value();
  if (hasSky && prepared.isLit)
    addEnvironment(context, extractSuns(context, request, std::move(*panorama), prepared.work), paths, prepared);
  applySceneLight(prepared, request);
  applyFullyRough(scene, settings.fullyRough);
  if (prepared.baked) {
    requireFresh(prepared, settings.baked);
    takeBaked(prepared, paths, prepared.baked);
    if (prepared.baked->localLights == bake::LocalLights::isStationary && !prepared.settings.shadows)
      for (const paths::Path* path : paths.chosen)
        if (!path->lightNeeds(prepared.settings.options).bakesLocalLights)
          scene.warnings.push_back(
              fmt::format("the {} path shades stationary lights without shadows; give --shadows", path->title()));
    prepared.panorama.reset();
  }
  if (prepared.isLit || !hasSky) prepared.pendingFile = request.scene; // an unlit scene's sky was not filtered
  if (!prepared.pendingEnvironments.isValid()) finishLight(prepared);
  return prepared;
}

const paths::Light& lightOf(const PreparedScene& prepared, const paths::Path& path) {
  static const paths::Light none;
  const auto found = prepared.lightOfPath.find(path.name());
  return found == prepared.lightOfPath.end() ? none : found->second;
}

bool letsLightThrough(const scenes::Scene& scene) {
  return std::ranges::any_of(scene.meshes, [&](const scenes::Mesh& mesh) {
    const scenes::Material& material = scene.materials[mesh.material];
    return material.hasTransmission() || material.hasDiffuseTransmission();
  });
}

bool tracesScene(const PreparedScene& prepared) {
  return prepared.settings.shadows || prepared.settings.reference.bounces > 0 || letsLightThrough(prepared.scene);
}

std::function<void(int)> imageRelease(PreparedScene& prepared, const PathChoice& paths) {
  if (paths.truth && tracesScene(prepared)) return {};
  return [&prepared](int image) { prepared.scene.images[static_cast<std::size_t>(image)].pixels = {}; };
}

} // namespace parity::job

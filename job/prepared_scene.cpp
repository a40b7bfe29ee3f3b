#include "job/prepared_scene.h"

#include <algorithm>

#include <fmt/format.h>
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/component_wise.hpp>

#include "base/error.h"
#include "base/glob.h"
#include "base/parallel.h"
#include "scenes/load.h"
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

// Black pictures are alike by any metric: a scene that nothing lights is refused, not passed.
void requireLight(PreparedScene& prepared, const std::string& file) {
  // Band 0 of the irradiance is the environment's mean: a black one gives no light.
  const bool sky = (prepared.environment && glm::compMax(prepared.environment->irradianceSh[0]) > 0) ||
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

} // namespace

PreparedScene prepareScene(Context& context, const SceneRequest& request, const EnvironmentForms& forms) {
  PreparedScene prepared;
  std::optional<scenes::Environment> environment;
  std::vector<std::string> warnings;
  base::parallelInvoke({
      [&] {
        const base::Stopwatch watch(&context.timings(), "load scene");
        prepared.scene = scenes::loadScene(request.scene);
      },
      [&] {
        if (request.environment.empty()) return;
        {
          const base::Stopwatch watch(&context.timings(), "load environment");
          environment = scenes::loadEnvironment(request.environment, request.environmentRotationDeg, warnings);
        }
        if (forms.filtered) prepared.environment = context.environmentLight(*environment);
      },
  });
  scenes::Scene& scene = prepared.scene;
  if (!request.name.empty()) scene.name = request.name;
  scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  if (scene.instances.empty() || scene.triangleCount() == 0)
    throw base::fileError(request.scene, "scene", "it shows no triangles");

  if (!environment && scene.environment) {
    // A built-in scene's own environment; the request's goes first.
    scene.environment->rotationDeg = request.environmentRotationDeg;
    environment = scene.environment;
    if (forms.filtered) prepared.environment = context.environmentLight(*environment);
  }
  if (!request.environment.empty())
    prepared.environmentName = scenes::cleanName(std::filesystem::path(request.environment).filename().string());
  else
    prepared.environmentName = environment ? environment->name : "none";
  scene.environment.reset(); // its pixels are not needed any more
  if (forms.panorama) prepared.panorama = std::move(environment);

  prepared.lights = scene.lights;
  prepared.sunText = "none";
  if (request.sun) {
    prepared.lights.push_back(scenes::makeSun(*request.sun));
    prepared.sunText = fmt::format("{},{},{}", request.sun->azimuthDeg, request.sun->elevationDeg, request.sun->lux);
  }
  applyFullyRough(scene, request.fullyRough);
  applyFullyRough(scene, context.settings().fullyRough);
  requireLight(prepared, request.scene);
  return prepared;
}

} // namespace parity::job

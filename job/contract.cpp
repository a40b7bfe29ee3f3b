#include "job/contract.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "base/file.h"
#include "base/image/image_io.h"
#include "base/log.h"
#include "base/text/json_writer.h"
#include "base/version.h"
#include "external/calibration_scene.h"
#include "job/scene/external_pictures.h"
#include "job/scene/material_ids.h"
#include "job/scene/scene_renderer.h"
#include "scenes/gltf/export_glb.h"
#include "scenes/light_names.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

namespace fs = std::filesystem;

constexpr const char *kScene = "scene.glb", *kEnvironmentFile = "environment.hdr", // in each scene's folder
                                                *kCalibrationScene = "calibration.glb",
                     *kCalibrationMap = "calibration.hdr";

void writeNumbers(base::JsonWriter& json, const float* values, int count) {
  json.beginArray();
  for (int i = 0; i < count; ++i) json.number(values[i]);
  json.endArray();
}
void writeVector(base::JsonWriter& json, const glm::vec3& v) { writeNumbers(json, glm::value_ptr(v), 3); }

// The panorama as all see it: turned already.
base::Image turned(const scenes::Environment& environment) {
  const base::Image& from = environment.radiance;
  base::Image out(from.width, from.height, 3);
  const double shift = environment.rotationDeg / 360 * from.width; // as lighting::panoramaAzimuth has it
  for (int x = 0; x < from.width; ++x) {
    const double at = x + shift, floor = std::floor(at);
    const auto share = static_cast<float>(at - floor);
    const auto column = [&](double c) {
      const auto n = static_cast<long long>(c) % from.width;
      return static_cast<int>(n < 0 ? n + from.width : n);
    };
    const int a = column(floor), b = column(floor + 1);
    for (int y = 0; y < from.height; ++y)
      for (int c = 0; c < 3; ++c) out.at(x, y)[c] = from.at(a, y)[c] + share * (from.at(b, y)[c] - from.at(a, y)[c]);
  }
  return out;
}

void writeCamera(base::JsonWriter& json, const scenes::Camera& camera, float aspect) {
  const glm::mat4 view = glm::inverse(camera.toWorld);
  const float degrees = std::numbers::pi_v<float> / 180;
  const glm::mat4 projection = camera.orthographic
                                   ? glm::orthoRH_NO(-camera.halfHeight * aspect, camera.halfHeight * aspect,
                                                     -camera.halfHeight, camera.halfHeight, camera.zNear, camera.zFar)
                                   : glm::perspectiveRH_NO(camera.fovYDeg * degrees, aspect, camera.zNear, camera.zFar);
  json.beginObject();
  writeNumbers(json.key("view"), glm::value_ptr(view), 16);
  writeNumbers(json.key("projection"), glm::value_ptr(projection), 16);
  writeVector(json.key("position"), glm::vec3(camera.toWorld[3]));
  writeVector(json.key("direction"), -glm::vec3(camera.toWorld[2]));
  writeVector(json.key("up"), glm::vec3(camera.toWorld[1]));
  json.key("orthographic").boolean(camera.orthographic);
  json.key("fovYDeg").number(camera.fovYDeg);
  json.key("halfHeight").number(camera.halfHeight);
  json.key("near").number(camera.zNear);
  json.key("far").number(camera.zFar);
  json.endObject();
}

void writeLights(base::JsonWriter& json, const std::vector<scenes::Light>& lights) {
  json.beginArray();
  for (const scenes::Light& light : lights) {
    json.beginObject();
    json.key("name").text(light.name);
    json.key("kind").text(scenes::nameOf(light.kind));
    writeVector(json.key("color"), light.color);
    writeVector(json.key("position"), light.position);
    writeVector(json.key("direction"), light.direction);
    json.key("range").number(light.range);
    json.key("falloff").text(light.falloff == scenes::Falloff::exponent
                                 ? "exponent"
                                 : scenes::falloffNames().at(static_cast<std::size_t>(light.falloff)));
    json.key("falloffExponent").number(light.falloffExponent);
    json.key("innerConeAngle").number(light.innerConeAngle);
    json.key("outerConeAngle").number(light.outerConeAngle);
    json.endObject();
  }
  json.endArray();
}

// What a view's picture must be like, besides its camera.
struct Shot {
  std::string name, picture;
  int width = 0, height = 0, samples = 1;
  double filterWidth = 1;
  glm::vec3 background{0.f};
  float exposureEv = 0;
  std::string ids, linear; // relative to the contract; empty: none
};

void writeView(base::JsonWriter& json, const Shot& shot, const scenes::Camera& camera) {
  json.beginObject();
  json.key("name").text(shot.name);
  json.key("picture").text(shot.picture);
  json.key("width").integer(shot.width);
  json.key("height").integer(shot.height);
  json.key("samples").integer(shot.samples);
  json.key("filterWidth").number(shot.filterWidth);
  writeVector(json.key("background"), shot.background);
  json.key("exposureEv").number(shot.exposureEv);
  json.key("transfer").text("srgb");
  writeCamera(json.key("camera"), camera, static_cast<float>(shot.width) / static_cast<float>(shot.height));
  if (!shot.ids.empty()) json.key("ids").text(shot.ids);
  if (!shot.linear.empty()) json.key("linear").text(shot.linear);
  json.endObject();
}

void writeEnvironment(base::JsonWriter& json, const std::string& file) {
  if (file.empty()) return json.null();
  json.beginObject();
  json.key("file").text(file);
  json.endObject();
}

class ContractWriter {
public:
  ContractWriter(Context& context, fs::path folder) : m_context(context), m_folder(std::move(folder)) {}

  void writeScene(base::JsonWriter& json, SceneRequest request, std::size_t index, const Progress& progress) {
    const std::string own = std::to_string(index);
    makeFolder(m_folder / own);
    request.settings.scene.load.allMaterials = true;                       // an exported file has the textures of all
    const PathChoice light{.chosen = {allPaths().front()}, .bakes = true}; // keeps the panorama
    const PreparedScene lit = prepareScene(m_context, request, light);
    json.beginObject();
    json.key("name").text(request.name);
    json.key("scene").text(sceneFile(request, lit.scene, own));
    std::string environment;
    if (lit.panorama) {
      environment = fmt::format("{}/{}", own, kEnvironmentFile);
      base::writeImage(m_folder / environment, turned(*lit.panorama));
    }
    writeEnvironment(json.key("environment"), environment);
    writeLights(json.key("lights"), lit.lights);
    writeViews(json.key("views"), request, own, progress);
    json.endObject();
  }

  // With as many samples as the scenes' pictures, so that it shows the same filter.
  void writeCalibration(base::JsonWriter& json) const {
    const std::vector<std::byte> glb = scenes::toGlb(external::calibrationScene());
    base::writeBytes(m_folder / kCalibrationScene, glb);
    base::writeImage(m_folder / kCalibrationMap, external::calibrationEnvironment().radiance);
    json.beginObject();
    json.key("name").text("calibration");
    json.key("scene").text(kCalibrationScene);
    writeEnvironment(json.key("environment"), kCalibrationMap);
    writeLights(json.key("lights"), {});
    json.key("views").beginArray();
    constexpr int kSize = external::kCalibrationSize;
    writeView(json,
              {.name = "calibration",
               .picture = "calibration.png",
               .width = kSize,
               .height = kSize,
               .samples = m_samples,
               .filterWidth = m_filterWidth,
               .ids = {},
               .linear = {}},
              external::calibrationCamera());
    json.endArray();
    json.endObject();
  }

private:
  static void makeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw base::fileError(folder.string(), "", "cannot be created as a folder: " + error.message());
  }

  // Whether the scene's file alone does not say what is shown. A pose is chosen wherever there is an animation.
  static bool isShownOtherwise(const SceneRequest& request, const scenes::Scene& scene) {
    const scenes::SceneSettings& settings = request.settings.scene;
    const scenes::LoadOptions& load = settings.load;
    return scenes::isBuiltin(request.scene) || settings.subject != scenes::Subject::scene ||
           !scene.facts.animations.empty() || !load.scene.empty() || !load.variant.empty();
  }

  std::string sceneFile(const SceneRequest& request, const scenes::Scene& scene, const std::string& own) const {
    if (isShownOtherwise(request, scene)) {
      for (const std::string& line : scenes::listNotInGltf(scene))
        base::logWarning(fmt::format("{}: {}", request.name, line));
      for (const scenes::Material& material : scene.materials)
        if (!material.notModelled.empty())
          base::logWarning(fmt::format("{}: material '{}' is exported without {}", request.name, material.name,
                                       fmt::join(material.notModelled, ", ")));
      base::writeBytes(m_folder / own / kScene, scenes::toGlb(scene));
      return fmt::format("{}/{}", own, kScene);
    }
    return fs::relative(fs::absolute(request.scene), fs::absolute(m_folder)).generic_string();
  }

  void writeViews(base::JsonWriter& json, const SceneRequest& request, const std::string& own,
                  const Progress& progress) {
    SceneRequest wanted = request;
    wanted.settings.coverage = true;
    const PathChoice paths{.chosen = {allPaths().front()}};
    PreparedScene prepared = prepareScene(m_context, wanted, paths);
    SceneRenderer renderer(m_context, prepared, prepared.settings, paths, wanted.views.size(), {},
                           imageRelease(prepared, paths));
    const Settings& settings = prepared.settings;
    m_samples = std::max(m_samples, settings.samples), m_filterWidth = settings.filterWidth;
    json.beginArray();
    for (std::size_t v = 0; v < wanted.views.size(); ++v) {
      const std::string& name = wanted.views[v].name;
      if (progress)
        progress(request.name + ", " + name, static_cast<double>(v) / static_cast<double>(wanted.views.size()));
      const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
      const scenes::Camera camera = scenes::makeCamera(prepared.scene, wanted.views[v], aspect);
      const ViewFrames frames = renderer.render(camera);
      const std::string prefix = fmt::format("{}/{}", own, v);
      const std::string picture = pictureFileOf("{scene}-{view}.png", request.name, name);
      if (!m_pictures.insert(picture).second)
        throw base::Error(base::ExitCode::usage, fmt::format("scene '{}', view '{}'", request.name, name), "",
                          fmt::format("another view's picture is called {}, too: name one of them otherwise", picture));
      writeMaterialIds(m_folder / (prefix + "-ids.exr"), frames.coverage, settings.width, settings.height);
      base::writeImage(m_folder / (prefix + "-linear.exr"), frames.first().frame.color);
      writeView(json,
                {.name = name,
                 .picture = picture,
                 .width = settings.width,
                 .height = settings.height,
                 .samples = settings.samples,
                 .filterWidth = settings.filterWidth,
                 .background = settings.background,
                 .exposureEv = settings.exposureEv,
                 .ids = prefix + "-ids.exr",
                 .linear = prefix + "-linear.exr"},
                camera);
    }
    json.endArray();
  }

  Context& m_context;
  const fs::path m_folder;
  int m_samples = 1;        // the most that a scene has
  double m_filterWidth = 1; // of the last one
  std::set<std::string> m_pictures{"calibration.png"};
};

} // namespace

std::vector<std::string> contractFiles(std::size_t scenes) {
  std::vector<std::string> files = {kContractFile, kCalibrationScene, kCalibrationMap};
  for (std::size_t i = 0; i < scenes; ++i)
    for (const char* file : {kScene, kEnvironmentFile}) files.push_back(fmt::format("{}/{}", i, file));
  return files;
}

void writeContract(Context& context, const std::vector<SceneRequest>& scenes, const fs::path& folder,
                   const Progress& progress) {
  ContractWriter writer(context, folder);
  base::JsonWriter json(base::JsonLayout::indented);
  json.beginObject();
  json.key("format").integer(kContractFormat);
  json.key("tool").text(fmt::format("parity {}", base::kVersion));
  json.key("scenes").beginArray();
  for (std::size_t i = 0; i < scenes.size(); ++i) writer.writeScene(json, scenes[i], i, progress);
  json.endArray();
  writer.writeCalibration(json.key("calibration"));
  json.endObject();
  base::writeText(folder / kContractFile, json.finish());
}

} // namespace parity::job

#include "stress/render_stress.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/stopwatch.h"
#include "job/context.h"
#include "job/scene_renderer.h"

namespace parity::stress {

namespace {

job::PreparedScene prepare(const StressScene& stressScene) {
  job::PreparedScene prepared;
  prepared.scene = stressScene.scene;
  prepared.lights = prepared.mobileLights = stressScene.scene.lights;
  if (stressScene.scene.environment) {
    lighting::PrefilterOptions small = lighting::kFinePrefilter;
    small.faceSize = lighting::kMinFaceSize;
    prepared.environment = prepared.mobileEnvironment = std::make_shared<const lighting::EnvironmentLight>(
        lighting::makeEnvironmentLight(*stressScene.scene.environment, small));
    prepared.cells =
        std::make_shared<const lighting::PanoramaCells>(lighting::makePanoramaCells(*stressScene.scene.environment));
  }
  return prepared;
}

PathFrame pathFrame(const job::Settings& settings, bool highend, base::Frame frame) {
  const bool half = !highend && settings.mobile.precision == mobile::Precision::fp16;
  return {.path = highend ? "highend" : fmt::format("mobile {} {}", settings.mobile.preset, half ? "fp16" : "fp32"),
          .preset = highend ? "" : settings.mobile.preset,
          .half = half,
          .frame = std::move(frame)};
}

} // namespace

RenderStress::RenderStress(const RenderOptions& options) : m_options(options) { openDevices(); }

RenderStress::~RenderStress() = default;

void RenderStress::openDevices() {
  m_contexts.clear();
  for (const mobile::Precision precision : {mobile::Precision::fp32, mobile::Precision::fp16})
    for (const std::string& preset : m_options.presets) {
      if (precision == mobile::Precision::fp16 && !m_halfSkipped.empty()) continue;
      job::Settings settings;
      settings.width = settings.height = m_options.size;
      settings.background = glm::vec3(0); // it is in no term
      settings.terms = true;
      settings.device = m_options.device;
      settings.mobile = mobile::presetByName(preset);
      settings.mobile.precision = precision;
      auto context = std::make_unique<job::Context>(settings);
      m_deviceName = context->device().report().description();
      if (!context->device().report().float16) m_halfSkipped = m_deviceName + " has no shaderFloat16";
      m_contexts.push_back(std::move(context));
    }
}

// The first context shades by high-end too, and says which pixels show which material.
SceneFrames RenderStress::render(const StressScene& scene, std::vector<Finding>& findings) {
  SceneFrames frames;
  const job::PreparedScene prepared = prepare(scene);
  for (std::size_t c = 0; c < m_contexts.size(); ++c) {
    job::Context& context = *m_contexts[c];
    job::SceneRenderer renderer(context, prepared, {.highend = c == 0, .mobile = true}, 1);
    job::ViewFrames first = renderer.render(scene.camera), second = renderer.render(scene.camera);
    for (const bool highend : {true, false}) {
      if (highend && c > 0) continue;
      PathFrame frame = pathFrame(context.settings(), highend, std::move(highend ? first.highend : first.mobile));
      const PathFrame again =
          pathFrame(context.settings(), highend, std::move(highend ? second.highend : second.mobile));
      for (const Finding& finding : checkSame(scene, frame, again)) findings.push_back(finding);
      frames.paths.push_back(std::move(frame));
    }
    if (c == 0) frames.coverage = std::move(first.coverage);
    context.device().checkValidation();
  }
  return frames;
}

SceneResult RenderStress::stress(const StressScene& scene) {
  const base::Stopwatch watch(nullptr, "");
  SceneResult result{.name = scene.name, .wants = scene.wants, .paths = {}, .findings = {}};
  try {
    const SceneFrames frames = render(scene, result.findings);
    SceneFrames twin;
    if (scene.twin) twin = render(*scene.twin, result.findings);
    for (const PathFrame& path : frames.paths) result.paths.push_back(path.path);
    for (Finding& finding : checkFrames(scene, frames, scene.twin ? &twin : nullptr))
      result.findings.push_back(std::move(finding));
  } catch (const base::Error& error) {
    Finding finding;
    finding.subject = scene.name;
    finding.fault = "not rendered";
    finding.count = 1;
    finding.example = error.what();
    finding.reproduce = scene.reproduce;
    result.findings.push_back(finding);
    openDevices(); // what was refused or lost leaves its traces
  }
  result.timeMs = watch.elapsedMs();
  return result;
}

} // namespace parity::stress

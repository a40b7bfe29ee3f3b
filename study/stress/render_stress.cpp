#include "study/stress/render_stress.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "job/context.h"
#include "job/knobs.h"
#include "job/scene/scene_renderer.h"

namespace parity::stress {

namespace {

job::PreparedScene prepare(const StressScene& stressScene) {
  job::PreparedScene prepared;
  prepared.scene = stressScene.scene;
  prepared.lights = stressScene.scene.lights;
  paths::Light light{.lights = prepared.lights, .environment = nullptr, .cells = nullptr};
  if (stressScene.scene.environment) {
    lighting::PrefilterOptions small = lighting::kFinePrefilter;
    small.faceSize = lighting::kMinFaceSize;
    light.environment = std::make_shared<const lighting::EnvironmentLight>(
        lighting::makeEnvironmentLight(*stressScene.scene.environment, small));
    light.cells =
        std::make_shared<const lighting::PanoramaCells>(lighting::makePanoramaCells(*stressScene.scene.environment));
  }
  for (const paths::Path* path : job::allPaths()) prepared.lightOfPath[path->name()] = light;
  return prepared;
}

// The path's sets of knobs that any scene may be rendered by; itself where it has none.
std::vector<paths::Path::KnobSet> setsOf(const paths::Path& path) {
  std::vector<paths::Path::KnobSet> sets;
  for (paths::Path::KnobSet& set : path.knobSets())
    if (set.needs.empty()) sets.push_back(std::move(set));
  if (sets.empty()) sets.push_back({});
  return sets;
}

std::string valueOf(const paths::Path::KnobSet& set, const std::string& knob) {
  for (const auto& [id, value] : set.values)
    if (id == knob) return value;
  return {};
}

// As settings have it.
std::string presetOf(const paths::Path& path, const paths::Path::KnobSet& set) {
  const std::string knob = path.presetKnob(), value = knob.empty() ? "" : valueOf(set, knob);
  if (value.empty()) return {};
  return job::knobs().find(knob)->text(job::withKnobs({}, {{knob, {{value}, "--" + knob}}}));
}

} // namespace

// One path with one set of its knobs.
struct RenderStress::Setup {
  const paths::Path* path = nullptr;
  std::string label, preset; // "mobile ue4-2020 fp16", "ue4-2020"
  bool half = false;
  std::unique_ptr<job::Context> context; // with a device of its own
};

RenderStress::RenderStress(const RenderOptions& options) : m_options(options) { openDevices(); }

RenderStress::~RenderStress() = default;

void RenderStress::openDevices() {
  m_setups.clear();
  for (const paths::Path* path : job::allPaths())
    for (const paths::Path::KnobSet& set : setsOf(*path)) {
      Setup setup{.path = path,
                  .label = path->name() + (set.name.empty() ? "" : " " + set.name),
                  .preset = presetOf(*path, set),
                  .half = valueOf(set, "precision") == "fp16",
                  .context = nullptr};
      const bool isWanted =
          setup.preset.empty() || m_options.presets.empty() || std::ranges::count(m_options.presets, setup.preset) > 0;
      if (!isWanted || (setup.half && !m_halfSkipped.empty())) continue;
      job::Settings settings;
      settings.width = settings.height = m_options.size;
      settings.background = glm::vec3(0); // it is in no term
      settings.terms = true;
      settings.device = m_options.device;
      base::GivenKnobs given;
      for (const auto& [id, value] : set.values) given[id] = {{value}, "--" + id};
      settings = job::withKnobs(settings, given);
      settings.coverage = m_setups.empty();
      setup.context = std::make_unique<job::Context>(settings);
      const gpu::DeviceReport& report = setup.context->device().report();
      m_deviceName = report.description();
      if (paths::Options taken = settings.options; !path->adapt(taken, report).empty()) {
        m_halfSkipped = m_deviceName + " has no shaderFloat16";
        continue;
      }
      m_setups.push_back(std::move(setup));
    }
}

// The first says which pixels show which material. Each has a device of its own, so all are rendered at a time.
SceneFrames RenderStress::render(const StressScene& scene, std::vector<Finding>& findings) {
  struct Rendered {
    PathFrame frame;
    std::vector<base::PixelList> coverage;
    std::vector<Finding> findings;
  };
  const job::PreparedScene prepared = prepare(scene);
  std::vector<Rendered> rendered(m_setups.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < m_setups.size(); ++i)
    tasks.push_back([&, i] {
      const Setup& setup = m_setups[i];
      job::Context& context = *setup.context;
      job::SceneRenderer renderer(context, prepared, context.settings(), {.chosen = {setup.path}}, 1);
      job::ViewFrames first = renderer.render(scene.camera), second = renderer.render(scene.camera);
      const auto pathFrame = [&](job::ViewFrames& of) {
        return PathFrame{.path = setup.label,
                         .preset = setup.preset,
                         .half = setup.half,
                         .frame = std::move(of.paths.front().frame)};
      };
      PathFrame frame = pathFrame(first);
      rendered[i] = {
          .frame = {}, .coverage = std::move(first.coverage), .findings = checkSame(scene, frame, pathFrame(second))};
      rendered[i].frame = std::move(frame);
      context.device().checkValidation();
    });
  base::parallelInvoke(tasks);
  SceneFrames frames;
  for (Rendered& each : rendered) {
    findings.insert(findings.end(), each.findings.begin(), each.findings.end());
    frames.paths.push_back(std::move(each.frame));
    if (!each.coverage.empty()) frames.coverage = std::move(each.coverage);
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

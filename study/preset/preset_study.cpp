#include "study/preset/preset_study.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/error_words.h"
#include "highend/options.h"
#include "highend/table_brdf.h"
#include "job/knobs.h"
#include "mobile/path.h"
#include "mobile/sampled_brdf.h"
#include "paths/preset/preset_folder.h"
#include "study/plot/env_brdf.h"
#include "study/plot/env_brdf_picture.h"
#include "study/preset/function_stress.h"

namespace parity::presets {

namespace {

// The preset first, then what else is given.
job::Settings settingsOf(const StudyRequest& request, const std::string& preset) {
  base::GivenKnobs given = request.given;
  given[mobile::path().presetKnob()] = {{preset}, "study-preset"};
  return job::withKnobs(request.plain, given);
}

void addFunctions(PresetStudy& study, const gpu::Device& device, const job::Settings& settings, bool plots) {
  const auto& highend = settings.options.of<parity::highend::Options>();
  for (const mobile::Precision precision : {mobile::Precision::fp32, mobile::Precision::fp16}) {
    mobile::Options options = settings.options.of<mobile::Options>();
    options.precision = precision;
    if (precision == mobile::Precision::fp16 && !device.report().float16) continue;
    const bool half = precision == mobile::Precision::fp16;
    for (FunctionStress& stress : stressFunctions(device, options)) study.stress.push_back(std::move(stress));
    plot::PlottedPair pair{{"high-end", std::make_unique<parity::highend::TableBrdf>(highend), {}},
                           {"mobile", std::make_unique<mobile::SampledBrdf>(device, options), {}}};
    for (plot::Plotted* each : {&pair.reference, &pair.test}) each->words = each->brdf->words();
    for (const double F0 : {0.04, 1.0}) {
      const plot::Deviation deviation = plot::deviationOf(pair, F0);
      study.envBrdf.push_back({.F0 = F0, .half = half, .max = deviation.max, .rms = deviation.rms});
    }
    if (plots && !half) study.plot = plot::drawEnvBrdf(pair, {}, "");
  }
  study.lobe = lobeErrors(device, settings.options.of<mobile::Options>(), parity::highend::TableBrdf(highend));
}

void addScene(PresetStudy& study, job::Context& context, const job::Settings& settings, const StudyRequest& request,
              const std::string& environment, const job::Progress& progress) {
  job::SceneRequest scene;
  scene.name = fmt::format("{}, {}", request.scene, environment);
  scene.scene = request.scene;
  scene.settings = settings;
  scene.settings.scene.environment = environment;
  scene.settings.costs = true;
  scene.views = {{}};
  job::ReportRequest report;
  report.scenes = {scene};
  report.oneOfMany = true;
  const job::ReportResult result = job::runReport(context, report, progress);
  const report::SceneResult& compared = result.report.scenes.at(0);
  if (!compared.error.empty()) throw base::Error(base::ExitCode::failed, environment, "", compared.error);
  SceneFigures figures{.environment = environment, .flip = {}};
  for (const report::MaterialResult& material : compared.views.at(0).materials)
    if (material.figures.pixels > 0)
      figures.flip.emplace_back(material.name, material.figures.find("flip.mean").value_or(0));
  for (const auto& [name, flip] : figures.flip) figures.meanFlip += flip / static_cast<double>(figures.flip.size());
  for (const report::PathCost& cost : report::costsByPath(compared.permutations))
    if (cost.path == mobile::path().name())
      figures.operations = static_cast<std::uint64_t>(cost.operations + 0.5),
      figures.fp16 = static_cast<std::uint64_t>(cost.fp16 + 0.5),
      figures.fetches = static_cast<std::uint64_t>(cost.fetches + 0.5), figures.samplers = cost.samplers;
  study.scenes.push_back(std::move(figures));
}

} // namespace

std::vector<PresetStudy> studyPresets(job::Context& context, const StudyRequest& request,
                                      const job::Progress& progress) {
  std::vector<PresetStudy> studies;
  for (const std::string& preset : request.presets) {
    PresetStudy& study = studies.emplace_back();
    study.preset = preset;
    try {
      const job::Settings settings = settingsOf(request, preset);
      const auto& options = settings.options.of<mobile::Options>();
      study.preset = options.preset;
      if (options.own) study.base = options.own->base(), study.functions = options.own->functions();
      addFunctions(study, context.device(), settings, request.plots);
      for (const std::string& environment : request.environments)
        addScene(study, context, settings, request, environment, progress);
    } catch (const base::Error& error) {
      if (error.code() == base::ExitCode::usage && request.presets.size() == 1) throw;
      study.failure = error.what();
    }
  }
  return studies;
}

std::uint64_t findingsOf(const PresetStudy& study) {
  std::uint64_t count = 0;
  for (const FunctionStress& stress : study.stress) count += stress.nan + stress.infinite;
  return count;
}

} // namespace parity::presets

#include "study/sweep/scaling.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "base/text/json_writer.h"
#include "base/text/nearest.h"
#include "base/version.h"
#include "compare/metrics/measure.h"
#include "job/report_run.h"
#include "job/view/displayed.h"
#include "job/view/view_surfaces.h"
#include "scenes/load.h"
#include "scenes/view.h"
#include "study/sweep/device_timings.h"
#include "study/sweep/scaling_scene.h"
#include "study/sweep/statistics.h"
#include "study/sweep/sweep_json.h"

namespace parity::sweep {

namespace {

constexpr double kFactor = 4;

// A folder that goes with this object.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string path = (std::filesystem::temp_directory_path() / "parity-bench-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr) throw base::fileError(path, "", "could not be created");
    m_path = path;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

double medianMs(int rounds, const std::function<void()>& work) {
  std::vector<double> times;
  for (int round = 0; round < rounds; ++round) {
    const base::Stopwatch watch(nullptr, "");
    work();
    times.push_back(watch.elapsedMs());
  }
  return spreadOf(times).median;
}

double deviceMs(gpu::Device& device, const std::function<void()>& shade, int rounds, base::Timings& usual) {
  std::vector<double> times;
  for (int round = 0; round <= rounds; ++round) {
    base::Timings timings;
    const DeviceTimings redirected(device, timings, usual);
    shade();
    if (round == 0) continue; // compiles
    for (const auto& [stage, timeMs] : timings.stages())
      if (stage.starts_with("device: shade")) times.push_back(timeMs);
  }
  return spreadOf(times).median;
}

StageTimes measurePoint(const std::filesystem::path& file, job::Settings settings, int side, int rounds) {
  settings.width = settings.height = side;
  settings.cacheFolder.reset();
  job::Context context(settings);
  job::SceneRequest request;
  request.scene = file.string();
  request.name = "scaling";
  settings.scene.sun = scenes::SunRequest{30, 50, 1};
  request.settings = settings;
  request.views = {{}};
  StageTimes times;
  times.load = medianMs(rounds, [&] { scenes::loadScene(file.string()); });
  const job::PathChoice paths = job::pathsOf(settings);
  const job::PreparedScene prepared = job::prepareScene(context, request, paths);
  gpu::Device& device = context.device();
  times.upload = medianMs(rounds, [&] {
    const gpu::SceneBuffers buffers(device, prepared.scene, settings.specularAa);
    std::vector<gpu::Textures::Need> all;
    for (std::uint32_t set = 0; set < buffers.textures().setCount(); ++set) all.push_back({set, ~0u});
    buffers.textures().require(all);
  });
  job::SceneOnDevice scene(context, prepared, settings, paths);
  const job::ViewSurfaces surfaces(device, scene, settings, scenes::makeCamera(prepared.scene, {}, 1));
  times.surface = medianMs(rounds, [&] { surfaces.rasteriseAgain(); });

  std::vector<base::Image> pictures;
  std::vector<base::PixelList> regions;
  for (const paths::Path* path : paths.chosen) {
    const auto renderer = scene.makeRenderer(*path, settings.options, {.expectedPixels = surfaces.size()});
    times.shade.push_back(deviceMs(
        device, [&] { surfaces.shade(*renderer); }, rounds, context.timings()));
    const auto shaded = surfaces.shade(*renderer);
    pictures.push_back(surfaces.compose(shaded, path->target(settings.options, context.deviceReport(), 0)));
    if (regions.empty()) regions = surfaces.coverage(shaded);
  }
  times.compare = medianMs(rounds, [&] {
    const job::Displayed a = job::displayImage(pictures[0], context.display(), 0),
                         b = job::displayImage(pictures[1], context.display(), 0);
    compare::MeasureRequest measured;
    measured.metrics = settings.metrics;
    compare::measureRegions({a.pixels, b.pixels, &pictures[0], &pictures[1], {}}, regions, measured);
  });

  job::ReportRequest report;
  report.scenes = {request};
  report.folder = file.parent_path() / "report";
  // Twice: the first one loads the module that encodes.
  const auto reportMs = [&] {
    double sum = 0; // of all that the context has done
    for (const auto& [stage, timeMs] : job::runReport(context, report, {}).run.timings)
      if (stage == "encode images" || stage == "write images") sum += timeMs;
    return sum;
  };
  const double first = reportMs();
  times.report = reportMs() - first;
  return times;
}

struct Plan {
  std::string grows, rest;
  double first;
  int side;                            // of the picture, where that does not grow
  std::function<SceneSize(double)> at; // the scene of an n
};

std::vector<Plan> plans(int side) {
  const int half = side / 2;
  const auto picture = [](int width) { return fmt::format("{0}x{0} pixels", width); };
  return {{"pixels", "2048 triangles, 1 material, 1 sun", 1.0 * half * half, 0, [](double) { return SceneSize{}; }},
          {"triangles", picture(side) + ", 1 material, 1 sun", 2048, side,
           [](double n) { return SceneSize{.triangles = static_cast<int>(n)}; }},
          {"lights", picture(half) + ", 2048 triangles, 1 material, 1 sun", 1, half,
           [](double n) { return SceneSize{.lights = static_cast<int>(n)}; }},
          {"materials", picture(side) + ", 2048 triangles, 1 sun", 1, side,
           [](double n) { return SceneSize{.materials = static_cast<int>(n)}; }},
          {"textures", picture(side) + ", 2048 triangles, 256 materials, 1 sun, textures of 256x256", 1, side,
           [](double n) { return SceneSize{.materials = 256, .textures = static_cast<int>(n)}; }}};
}

} // namespace

std::vector<std::string> stageNames(const std::vector<std::string>& paths) {
  std::vector<std::string> names = {"load", "upload", "surface"};
  for (const std::string& path : paths) names.push_back("shade " + path);
  names.insert(names.end(), {"compare", "report"});
  return names;
}

std::vector<double> valuesOf(const StageTimes& t) {
  std::vector<double> values = {t.load, t.upload, t.surface};
  values.insert(values.end(), t.shade.begin(), t.shade.end());
  values.insert(values.end(), {t.compare, t.report});
  return values;
}

std::vector<ScalingSeries> measureScaling(const job::Settings& settings, const ScalingOptions& options,
                                          const job::Progress& progress) {
  std::vector<ScalingSeries> all;
  std::vector<Plan> todo = plans(options.side);
  std::vector<std::string> grows;
  for (const Plan& plan : todo) grows.push_back(plan.grows);
  const std::vector<std::string_view> names(grows.begin(), grows.end());
  std::erase_if(todo, [&](const Plan& plan) {
    return !options.series.empty() && std::ranges::none_of(options.series, [&](const std::string& glob) {
      return base::matchesGlob(glob, plan.grows);
    });
  });
  if (todo.empty())
    throw base::Error(base::ExitCode::usage, "bench", "--settings",
                      "no series has this name; " + base::describeNearestToGlob(options.series.front(), names));
  for (const Plan& plan : todo) {
    ScalingSeries& series = all.emplace_back();
    series.grows = plan.grows;
    series.rest = plan.rest;
    series.stages = stageNames(settings.pathNames);
    double n = plan.first;
    for (int step = 0; step < options.steps; ++step, n *= kFactor) {
      if (progress)
        progress(plan.grows, (static_cast<double>(all.size() - 1) + static_cast<double>(step) / options.steps) /
                                 static_cast<double>(todo.size()));
      const TemporaryFolder folder;
      const std::filesystem::path file = writeScalingScene(folder.path(), plan.at(n));
      const int side = plan.side > 0 ? plan.side : static_cast<int>(std::lround(std::sqrt(n)));
      series.points.push_back({n, measurePoint(file, settings, side, options.rounds)});
    }
    for (std::size_t stage = 0; stage < series.stages.size(); ++stage) {
      std::vector<double> ns, times;
      for (std::size_t i = series.points.size() - 3; i < series.points.size(); ++i) {
        ns.push_back(series.points[i].n);
        times.push_back(std::max(1e-3, valuesOf(series.points[i].times)[stage]));
      }
      series.exponents.push_back(fitPowerLaw(ns, times).exponent);
    }
  }
  if (progress) progress("scaling", 1);
  return all;
}

std::string toText(const std::vector<ScalingSeries>& all) {
  std::string text;
  for (const ScalingSeries& series : all) {
    text += fmt::format("{} ({}), ms:\n{:>10}", series.grows, series.rest, series.grows);
    for (const std::string& stage : series.stages) text += fmt::format(" {:>13}", stage);
    text += "\n";
    for (const ScalingPoint& point : series.points) {
      text += fmt::format("{:>10.0f}", point.n);
      for (const double value : valuesOf(point.times)) text += fmt::format(" {:>13.2f}", value);
      text += "\n";
    }
    text += fmt::format("{:>10}", "exponent");
    for (const double exponent : series.exponents) text += fmt::format(" {:>13.2f}", exponent);
    text += "\n\n";
  }
  return text;
}

std::string toJson(const std::vector<ScalingSeries>& all, const Machine& machine) {
  base::JsonWriter json;
  json.beginObject();
  json.key("tool").text("parity bench --scaling");
  json.key("schema").integer(1);
  json.key("version").text(base::kVersion);
  writeMachine(json, machine);
  json.key("series").beginArray();
  for (const ScalingSeries& series : all) {
    json.beginObject();
    json.key("grows").text(series.grows);
    json.key("rest").text(series.rest);
    json.key("points").beginArray();
    for (const ScalingPoint& point : series.points) {
      json.beginObject();
      json.key("n").number(point.n);
      const std::vector<double> values = valuesOf(point.times);
      for (std::size_t s = 0; s < values.size(); ++s) json.key(series.stages[s]).number(values[s]);
      json.endObject();
    }
    json.endArray();
    json.key("exponents").beginObject();
    for (std::size_t s = 0; s < series.exponents.size(); ++s) json.key(series.stages[s]).number(series.exponents[s]);
    json.endObject();
    json.endObject();
  }
  json.endArray();
  json.endObject();
  return json.finish();
}

} // namespace parity::sweep

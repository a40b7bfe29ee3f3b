// parity suite list: what a suite would run.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/cache.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/requests.h"
#include "job/knobs.h"
#include "job/scene_times.h"

namespace parity::cli {

namespace {

using nlohmann::ordered_json;

std::string describeTime(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::vector<std::string> viewNames(const job::SceneRequest& scene) {
  std::vector<std::string> names;
  for (const scenes::ViewRequest& view : scene.views) names.push_back(view.name);
  return names;
}

// `report` compares two scenes at a time where there are threads.
double runSeconds(const job::SceneTimes& times) {
  const double sum = std::accumulate(times.seconds.begin(), times.seconds.end(), 0.0);
  return times.seconds.size() > 1 && base::threadCount() > 1 ? sum / 2 : sum;
}

std::string toJson(const RunRequest& run, const job::SceneTimes& times) {
  ordered_json scenes = ordered_json::array();
  for (std::size_t i = 0; i < run.scenes.size(); ++i) {
    const job::SceneRequest& scene = run.scenes[i];
    scenes.push_back({{"name", scene.name},
                      {"file", scene.scene},
                      {"environment", scene.settings.scene.environment},
                      {"views", viewNames(scene)},
                      {"tags", scene.tags},
                      {"budgets", scene.budgets ? ordered_json(*scene.budgets) : ordered_json()},
                      {"seconds", times.seconds.empty() ? ordered_json() : ordered_json(times.seconds[i])}});
  }
  return dumpJson({{"suite", run.suite},
                   {"scenes", scenes},
                   {"seconds", times.seconds.empty() ? ordered_json() : ordered_json(runSeconds(times))},
                   {"timedScenes", times.known}});
}

void printList(const RunRequest& run, const job::SceneTimes& times) {
  std::size_t width = 0, viewCount = 0;
  for (const job::SceneRequest& scene : run.scenes) {
    width = std::max(width, scene.name.size());
    viewCount += scene.views.size();
  }
  for (std::size_t i = 0; i < run.scenes.size(); ++i) {
    const job::SceneRequest& scene = run.scenes[i];
    std::string line = fmt::format("{:<{}}  ", scene.name, width);
    if (!times.seconds.empty()) line += fmt::format("{:>11}  ", describeTime(times.seconds[i]));
    line += fmt::format("{}", fmt::join(viewNames(scene), ", "));
    if (!scene.tags.empty()) line += fmt::format("  [{}]", fmt::join(scene.tags, ", "));
    print("{}\n", line);
  }
  std::string total = fmt::format("{}: {} scene{}, {} view{}", run.suite, run.scenes.size(),
                                  run.scenes.size() == 1 ? "" : "s", viewCount, viewCount == 1 ? "" : "s");
  if (times.seconds.empty())
    total += "; no scene has been timed yet, so there is no estimate";
  else
    total += fmt::format(
        "; about {} here{}", describeTime(runSeconds(times)),
        times.known == run.scenes.size()
            ? ""
            : fmt::format(" ({} of {} scenes timed; the others count as the median)", times.known, run.scenes.size()));
  print("{}\n", total);
}

} // namespace

int runSuiteListCommand(const SuiteListCommand& command) {
  CommonOptions common;
  common.only = command.only;
  const RunRequest run = runRequest(common, {}, command.suite);
  const job::SceneTimes times = job::estimateTimes(base::Cache(command.cacheFolder), run.scenes);
  if (!command.json.empty()) writeJson(command.json, toJson(run, times));
  if (command.json != "-") printList(run, times);
  return 0;
}

} // namespace parity::cli

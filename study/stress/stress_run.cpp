#include "study/stress/stress_run.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/text/error_words.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"
#include "base/version.h"
#include "gpu/device/device.h"

namespace parity::stress {

namespace {

// Named scenes and random ones, by number.
class SceneSource {
public:
  explicit SceneSource(const Options& options) : m_options(options) {
    std::vector<std::string> names;
    for (StressScene& scene : namedScenes()) {
      names.push_back(scene.name);
      if (base::matchesGlob(options.renderGlob, scene.name)) m_named.push_back(std::move(scene));
    }
    // A random scene is named by its seed: the glob picks out of those that are due.
    for (std::uint32_t i = 0; i < options.scenes && options.seconds <= 0; ++i)
      if (isWanted(options.seed + i)) m_seeds.push_back(options.seed + i);
    const bool soaks = options.seconds > 0 && [&] {
      for (std::uint64_t i = 0; i < kSeedsTried; ++i)
        if (isWanted(options.seed + i)) return true;
      return false;
    }();
    if (m_named.empty() && m_seeds.empty() && !soaks)
      throw base::Error(base::ExitCode::usage, "--renders", options.renderGlob,
                        fmt::format("unknown scene; {}; 'parity stress --list' lists them",
                                    base::describeNearestToGlob(options.renderGlob, std::vector<std::string_view>(
                                                                                        names.begin(), names.end()))));
  }
  // Whether the glob names the random scene of this seed.
  bool isWanted(std::uint64_t seed) const {
    return base::matchesGlob(m_options.renderGlob, fmt::format("random-{}", seed));
  }
  std::size_t count() const { return m_named.size() + m_seeds.size(); }
  StressScene scene(std::size_t index) const {
    return index < m_named.size() ? m_named[index] : randomScene(m_seeds[index - m_named.size()]);
  }

private:
  static constexpr std::uint64_t kSeedsTried = 100000;

  const Options& m_options;
  std::vector<StressScene> m_named;
  std::vector<std::uint64_t> m_seeds;
};

// Devices that threads borrow: a device takes one thread's work.
class DevicePool {
public:
  explicit DevicePool(const gpu::DeviceOptions& options) : m_options(options) { giveBack(open()); }

  const gpu::DeviceReport& report() const { return m_report; }

  std::unique_ptr<gpu::Device> take() {
    {
      const std::lock_guard lock(m_mutex);
      if (!m_free.empty()) {
        std::unique_ptr<gpu::Device> device = std::move(m_free.back());
        m_free.pop_back();
        return device;
      }
    }
    return open();
  }
  void giveBack(std::unique_ptr<gpu::Device> device) {
    const std::lock_guard lock(m_mutex);
    m_report = device->report();
    m_free.push_back(std::move(device));
  }

private:
  std::unique_ptr<gpu::Device> open() const { return std::make_unique<gpu::Device>(m_options); }

  gpu::DeviceOptions m_options;
  gpu::DeviceReport m_report;
  std::mutex m_mutex;
  std::vector<std::unique_ptr<gpu::Device>> m_free;
};

// devices: null where none is asked. Throws what the first function in the list that failed has thrown; the report has
// those that did not fail.
void stressFunctions(const std::vector<FunctionCase>& functions, const Options& options, DevicePool* devices,
                     Report& report, const Progress& progress, double share) {
  const base::Stopwatch watch(nullptr, "");
  std::vector<std::optional<FunctionResult>> results(functions.size());
  std::mutex mutex; // of the progress
  std::size_t done = 0;
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < functions.size(); ++i)
    tasks.push_back([&, i] {
      std::unique_ptr<gpu::Device> device = devices ? devices->take() : nullptr;
      results[i] = stressFunction(functions[i], options.points, device.get());
      if (device) devices->giveBack(std::move(device));
      base::logDetail(fmt::format("{}: {:.0f} ms", functions[i].name, results[i]->timeMs));
      const std::lock_guard lock(mutex);
      ++done;
      if (progress) progress(functions[i].name, share * static_cast<double>(done) / static_cast<double>(tasks.size()));
    });
  std::exception_ptr failure;
  try {
    base::parallelInvoke(tasks);
  } catch (...) {
    failure = std::current_exception();
  }
  for (std::optional<FunctionResult>& result : results) {
    if (!result) continue;
    for (const Finding& finding : findingsOf(*result)) report.findings.push_back(finding);
    report.functions.push_back(std::move(*result));
  }
  report.functionsMs = watch.elapsedMs();
  if (failure) std::rethrow_exception(failure);
}

void stressRenders(const Options& options, RenderStress& renders, const SceneSource& source, Report& report,
                   const Progress& progress, double share) {
  report.deviceName = renders.deviceName();
  report.halfSkipped = renders.halfSkipped();
  const auto add = [&](const StressScene& scene) {
    report.scenes.push_back(renders.stress(scene));
    for (const Finding& finding : report.scenes.back().findings) {
      report.findings.push_back(finding);
      if (!finding.expected) // now: a soak may run for hours
        base::logWarning(fmt::format("{} {}: {} {}; parity stress {}", finding.subject, finding.place, finding.fault,
                                     finding.example, finding.reproduce));
    }
    report.rendersMs += report.scenes.back().timeMs;
    base::logDetail(fmt::format("{}: {:.0f} ms", scene.name, report.scenes.back().timeMs));
  };
  for (std::size_t i = 0; i < source.count(); ++i) {
    const StressScene scene = source.scene(i);
    if (progress)
      progress(scene.name, 1 - share + share * static_cast<double>(i) / static_cast<double>(source.count()));
    add(scene);
  }
  const base::Stopwatch watch(nullptr, "soak");
  for (std::uint64_t seed = options.seed; watch.elapsedMs() < 1000 * options.seconds; ++seed) {
    if (!source.isWanted(seed)) continue;
    const StressScene scene = randomScene(seed);
    if (progress) progress(scene.name, watch.elapsedMs() / (1000 * options.seconds));
    add(scene);
  }
}

} // namespace

std::size_t Report::unexpected() const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [](const Finding& finding) { return !finding.expected; }));
}

Report runStress(const Options& options, const Progress& progress) {
  Report report;
  report.version = base::kVersion;
  report.seed = options.seed;
  report.points = options.points.points;
  report.devicePoints = options.points.devicePoints;
  const double share = !options.renders ? 1 : !options.functions ? 0 : 0.8;
  std::unique_ptr<SceneSource> source;
  std::unique_ptr<RenderStress> renders;
  if (options.renders) { // what refuses it does so before hours of functions
    source = std::make_unique<SceneSource>(options);
    renders = std::make_unique<RenderStress>(options.render);
  }
  const std::vector<FunctionCase> functions =
      options.functions ? functionsNamed(options.functionGlob) : std::vector<FunctionCase>();
  std::optional<DevicePool> devices;
  if (options.functions && options.points.devicePoints > 0) {
    devices.emplace(options.render.device);
    report.deviceName = devices->report().description();
    if (!devices->report().float16) report.halfSkipped = devices->report().name + " has no shaderFloat16";
  }
  try {
    stressFunctions(functions, options, devices ? &*devices : nullptr, report, progress, share);
    if (options.renders) stressRenders(options, *renders, *source, report, progress, 1 - share);
  } catch (const std::exception& error) {
    report.failure = base::wordsOf(error);
  }
  if (progress) progress("", 1);
  sortFindings(report.findings);
  return report;
}

} // namespace parity::stress

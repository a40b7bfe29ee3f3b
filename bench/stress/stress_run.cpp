#include "stress/stress_run.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/glob.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "gpu/device.h"
#include "job/version.h"

namespace parity::stress {

namespace {

// Named scenes and random ones, by number.
class SceneSource {
public:
  explicit SceneSource(const Options& options) : m_options(options) {
    for (StressScene& scene : namedScenes())
      if (base::matchesGlob(options.renderGlob, scene.name)) m_named.push_back(std::move(scene));
    // A random scene is named by its seed: the glob picks out of those that are due.
    for (std::uint32_t i = 0; i < options.scenes && options.seconds <= 0; ++i)
      if (base::matchesGlob(options.renderGlob, nameOf(options.seed + i))) m_seeds.push_back(options.seed + i);
    if (m_named.empty() && m_seeds.empty() && options.seconds <= 0)
      throw base::Error(base::ExitCode::usage, "--renders", options.renderGlob,
                        "no such scene; parity stress --list names them");
  }
  std::size_t count() const { return m_named.size() + m_seeds.size(); }
  StressScene scene(std::size_t index) const {
    return index < m_named.size() ? m_named[index] : randomScene(m_seeds[index - m_named.size()]);
  }

private:
  static std::string nameOf(std::uint64_t seed) { return fmt::format("random-{}", seed); }

  const Options& m_options;
  std::vector<StressScene> m_named;
  std::vector<std::uint64_t> m_seeds;
};

void stressFunctions(const Options& options, Report& report, const Progress& progress, double share) {
  const std::vector<FunctionCase> functions = functionsNamed(options.functionGlob);
  std::unique_ptr<gpu::Device> device;
  if (options.points.devicePoints > 0) {
    device = std::make_unique<gpu::Device>(options.render.device);
    report.deviceName = device->report().description();
    if (!device->report().float16) report.halfSkipped = device->report().name + " has no shaderFloat16";
  }
  for (std::size_t i = 0; i < functions.size(); ++i) {
    if (progress) progress(functions[i].name, share * static_cast<double>(i) / static_cast<double>(functions.size()));
    report.functions.push_back(stressFunction(functions[i], options.points, device.get()));
    for (const Finding& finding : findingsOf(report.functions.back())) report.findings.push_back(finding);
    report.functionsMs += report.functions.back().timeMs;
  }
}

void stressRenders(const Options& options, const SceneSource& source, Report& report, const Progress& progress,
                   double share) {
  RenderStress renders(options.render);
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
  };
  for (std::size_t i = 0; i < source.count(); ++i) {
    const StressScene scene = source.scene(i);
    if (progress)
      progress(scene.name, 1 - share + share * static_cast<double>(i) / static_cast<double>(source.count()));
    add(scene);
  }
  const base::Stopwatch watch(nullptr, "soak");
  for (std::uint64_t seed = options.seed; watch.elapsedMs() < 1000 * options.seconds; ++seed) {
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
  report.version = job::kVersion;
  report.seed = options.seed;
  report.points = options.points.points;
  report.devicePoints = options.points.devicePoints;
  const double share = !options.renders ? 1 : !options.functions ? 0 : 0.8;
  std::unique_ptr<SceneSource> source;
  if (options.renders) source = std::make_unique<SceneSource>(options); // refuses a glob before hours of functions
  if (options.functions) stressFunctions(options, report, progress, share);
  if (options.renders) stressRenders(options, *source, report, progress, 1 - share);
  if (progress) progress("", 1);
  sortFindings(report.findings);
  return report;
}

} // namespace parity::stress

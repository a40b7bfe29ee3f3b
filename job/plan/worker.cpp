#include "job/plan/worker.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "bake/baked_folder.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/machine.h"
#include "job/context.h"
#include "job/kept_pictures.h"
#include "job/plan/plan_folder.h"
#include "job/plan/unit_store.h"
#include "job/scene_times.h"
#include "report/reader.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

class Worker {
public:
  Worker(Context& context, const Plan& plan, const std::filesystem::path& folder)
      : m_context(context), m_plan(plan), m_request(plan.request), m_store(folder, plan),
        m_budgets(plan.plain.budgets, plan.request.suiteBudgets, plan.budgets) {
    m_request.folder = folder; // there are pictures
    if (m_context.numerics() != plan.numerics)
      throw base::Error(base::ExitCode::otherPlan, (folder / kPlanFile).string(), "",
                        fmt::format("was made on a machine that rounds otherwise (numerics id {}, here {}), so figures "
                                    "would differ; 'parity devices' prints the id",
                                    plan.numerics.substr(0, 8), m_context.numerics().substr(0, 8)));
  }

  // False where the run was told to stop: nothing is kept then.
  bool doUnit(std::size_t index, const Tell& tell) {
    takeBaseline(index);
    std::vector<scenes::SourceFile> others = otherInputs(m_request.scenes[index].settings.scene);
    const auto before = m_context.timings().stages();
    const auto start = std::chrono::steady_clock::now();
    const double cpuStart = base::cpuSeconds();
    ComparedScene scene = compareScene(m_context, m_request, index, m_budgets, tell);
    if (m_context.stoppedBy() != 0) return false;
    scene.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    scene.cpuSeconds = base::cpuSeconds() - cpuStart;
    if (!scene.isCached && scene.result.error.empty())
      keepSceneTime(m_context.cache(), m_request.scenes[index], scene.seconds);
    std::ranges::move(others, std::back_inserter(scene.inputs));
    dropPictures(scene, m_request.pictures, m_budgets.baseline(), m_plan.facts);
    if (!scene.error.empty()) base::logError(scene.error);
    UnitRun run{.seconds = scene.seconds,
                .cpuSeconds = scene.cpuSeconds,
                .machine = base::processorName(),
                .isCached = scene.isCached,
                .timings = timingsSince(before),
                .shaders = newShaders()};
    try {
      m_store.put(index, std::move(scene), std::move(run));
    } catch (const base::Error& error) { // a full disk: nothing of the scene's
      throw base::Error(base::ExitCode::incomplete, error.subject(), error.place(), error.reason());
    }
    return true;
  }

private:
  // The scene may be new since the baseline: then that knows nothing of it, but there is one.
  void takeBaseline(std::size_t index) {
    if (m_plan.request.baseline.empty()) return;
    const std::filesystem::path file = baselineOf(m_plan, m_request.folder, index);
    m_baseline = file.empty() ? report::Report() : report::readReport(file);
    m_budgets.setBaseline(&*m_baseline);
  }

  // What the scene is read from besides its own files. One that cannot be read is an error of the scene.
  static std::vector<scenes::SourceFile> otherInputs(const scenes::SceneSettings& settings) {
    std::vector<scenes::SourceFile> inputs;
    const auto add = [&](const std::filesystem::path& file) {
      try {
        inputs.push_back({file, base::hashOfFile(file)});
      } catch (const base::Error& error) {
        base::logDetail(error.what());
      }
    };
    if (!settings.environment.empty() && !scenes::isBuiltin(settings.environment)) add(settings.environment);
    if (!settings.baked.empty()) add(std::filesystem::path(settings.baked) / bake::kManifestFile);
    return inputs;
  }

  std::vector<std::pair<std::string, double>> timingsSince(const std::vector<std::pair<std::string, double>>& before) {
    std::vector<std::pair<std::string, double>> added;
    for (const auto& [stage, timeMs] : m_context.timings().stages()) {
      double then = 0;
      for (const auto& [name, sum] : before)
        if (name == stage) then = sum;
      if (timeMs > then) added.emplace_back(stage, timeMs - then);
    }
    return added;
  }

  // By what tells them apart in every process.
  std::vector<std::string> newShaders() {
    std::vector<std::string> added;
    for (const auto& [spirv, constants] : m_context.compiledShaders()) {
      base::Hasher hasher;
      hasher.add(std::as_bytes(spirv.words));
      for (const std::uint32_t constant : constants) hasher.addValue(constant);
      if (std::string hash = hasher.hex(); m_shaders.insert(hash).second) added.push_back(std::move(hash));
    }
    return added;
  }

  Context& m_context;
  const Plan& m_plan;
  ReportRequest m_request;
  UnitStore m_store;
  RunBudgets m_budgets;
  std::optional<report::Report> m_baseline;
  std::set<std::string> m_shaders; // that were told
};

} // namespace

std::string doneLine(std::size_t unit) { return fmt::format("done {}", unit); }

int runWorker(Context& context, const Plan& plan, const std::filesystem::path& folder, StagePage& page) {
  page.set("starting");
  // Nobody but this function may speak to the supervisor: drivers print, too.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> answers(::fdopen(::dup(STDOUT_FILENO), "w"), std::fclose);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  Worker worker(context, plan, folder);
  const auto say = [&](const std::string& line) {
    fmt::print(answers.get(), "{}\n", line);
    std::fflush(answers.get());
  };
  say(kReadyLine);
  for (std::string line; context.stoppedBy() == 0 && std::getline(std::cin, line);) {
    std::size_t unit = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), unit);
    if (error != std::errc() || end != line.data() + line.size() || unit >= plan.request.scenes.size())
      throw base::Error(base::ExitCode::usage, "worker", line, "is no unit of the plan");
    page.set("beginning");
    if (!worker.doUnit(unit, [&](double, const std::string& what) { page.set(what); })) break;
    say(doneLine(unit));
  }
  constexpr int kOfSignals = 128;
  return context.stoppedBy() == 0 ? 0 : kOfSignals + context.stoppedBy();
}

void doUnits(Context& context, const Plan& plan, const std::filesystem::path& folder,
             const std::vector<std::size_t>& units, const Progress& progress) {
  Worker worker(context, plan, folder);
  for (std::size_t i = 0; i < units.size() && context.stoppedBy() == 0; ++i)
    worker.doUnit(units[i], [&](double done, const std::string& what) {
      if (progress)
        progress(fmt::format("{}: {}", plan.request.scenes[units[i]].name, what),
                 (static_cast<double>(i) + done) / static_cast<double>(units.size()));
    });
}

} // namespace parity::job

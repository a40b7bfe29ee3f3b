#include "job/plan/merge.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "job/context.h"
#include "job/plan/plan_folder.h"
#include "job/plan/unit_store.h"
#include "job/scene/scene_start.h"
#include "report/judge.h"

namespace parity::job {

namespace {

std::size_t shardOf(const Plan& plan, std::size_t unit) {
  const auto holds = [&](const std::vector<std::size_t>& shard) { return std::ranges::count(shard, unit) > 0; };
  return static_cast<std::size_t>(std::ranges::find_if(plan.shards, holds) - plan.shards.begin());
}

// The first ones by name.
std::string describeMissing(const Plan& plan, const std::vector<std::size_t>& units, const std::string& fault) {
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> names;
  std::set<std::size_t> shards;
  for (const std::size_t unit : units) {
    shards.insert(shardOf(plan, unit));
    if (names.size() < kNamed) names.push_back(fmt::format("'{}'", plan.request.scenes[unit].name));
  }
  const std::size_t all = plan.request.scenes.size();
  return fmt::format("{} of {} scene{} {} no result: {}{}{}; do shard{} {}, or give --incomplete report", units.size(),
                     all, all == 1 ? "" : "s", units.size() == 1 ? "has" : "have", fmt::join(names, ", "),
                     units.size() > kNamed ? ", ..." : "", fault.empty() ? "" : " (" + fault + ")",
                     shards.size() == 1 ? "" : "s", fmt::join(shards, ","));
}

// What the plan has frozen; not of approvals that the merge is given anew, as the same file may have changed.
FrozenFiles frozenOf(const Plan& plan, const MergeOptions& options) {
  FrozenFiles frozen = plan.budgets;
  frozen.erase(options.approvals);
  return frozen;
}

class Merge {
public:
  Merge(const Plan& plan, const std::filesystem::path& folder, const MergeOptions& options)
      : m_plan(plan), m_store(folder, plan), m_request(plan.request), m_context(plan.settings()),
        m_budgets(plan.plain.budgets, plan.request.suiteBudgets, frozenOf(plan, options)),
        m_baseline(plan.request.baseline.empty() ? std::filesystem::path() : baselineOf(plan, folder)) {
    m_request.folder = options.folder;
    m_request.bench = options.bench;
    m_request.warningsFail = options.warningsFail;
    m_request.findEarlier = options.findEarlier;
    m_request.explain = options.explain;
    if (!options.approvals.empty()) m_request.approvals = options.approvals;
    if (!options.asOf.empty()) m_request.asOf = options.asOf;
    m_stoppedBy = options.stoppedBy;
    m_whyMissing = options.whyMissing;
    m_context.stopWhen(
        [this, later = options.isStopped] { return m_stoppedBy != 0 || !later ? m_stoppedBy : later(); });
  }

  ReportResult run(Incomplete incomplete, const Progress& progress) {
    for (std::size_t i = 0; i < m_request.scenes.size(); ++i) {
      if (std::string fault = m_store.findFault(i); !fault.empty()) {
        requireOwn(i);
        m_missing.push_back(i);
        if (m_fault.empty() && m_store.has(i)) m_fault = std::move(fault);
      }
    }
    if (!m_missing.empty() && incomplete == Incomplete::error && m_stoppedBy == 0)
      throw base::fileError(m_request.folder.string(), "is not written", describeMissing(m_plan, m_missing, m_fault));
    ReportEnd end(m_request, m_budgets, m_plan.facts, m_baseline);
    for (std::size_t i = 0; i < m_request.scenes.size(); ++i) {
      if (progress)
        progress("merging " + m_request.scenes[i].name,
                 static_cast<double>(i) / static_cast<double>(m_request.scenes.size()));
      if (!std::ranges::binary_search(m_missing, i))
        end.add(i, take(i, end));
      else if (m_stoppedBy == 0)
        end.add(i, missingScene(i));
    }
    report::RunInfo run;
    run.compiledShaders = m_shaders.size();
    run.timings = m_timings;
    run.incidents = m_incidents;
    run.origin.cpuSeconds = m_workerSeconds;
    return end.finish(m_context, std::move(run), progress);
  }

private:
  // Of another plan or machine: that is no gap to be filled, but a mistake.
  void requireOwn(std::size_t unit) const {
    try {
      m_store.read(unit);
    } catch (const base::Error& error) {
      if (error.code() == base::ExitCode::otherPlan) throw;
    }
  }

  ComparedScene missingScene(std::size_t index) const {
    ComparedScene scene;
    scene.result = startScene(m_request.scenes[index]);
    scene.result.error = !m_whyMissing.empty()
                             ? "was not done: " + m_whyMissing
                             : fmt::format("has no result: shard {} did not finish it", shardOf(m_plan, index));
    scene.result.errorExitCode = static_cast<int>(base::ExitCode::failed);
    scene.error = fmt::format("{}: {}", scene.result.name, scene.result.error);
    scene.isMissing = true;
    return scene;
  }

  ComparedScene take(std::size_t index, ReportEnd& end) {
    Unit unit = m_store.read(index);
    ComparedScene scene = std::move(unit.scene);
    if (!scene.result.views.empty()) report::judgeScene(scene.result, m_budgets.of(m_request.scenes[index]));
    try {
      for (const UnitFile& file : unit.files)
        if (m_request.singleFile)
          scene.pictures.push_back({file.file, m_store.contentOf(file)});
        else
          m_store.place(file, m_request.folder);
    } catch (const base::Error& error) { // as where `report` cannot write a picture
      scene.error += (scene.error.empty() ? "" : "\n") + fmt::format("{}: {}", scene.result.name, error.what());
      scene.result.error = error.what();
      scene.result.errorExitCode = static_cast<int>(error.code());
    }
    for (const scenes::SourceFile& input : scene.inputs)
      if (const auto known = m_inputs.try_emplace(input.file.string(), input.hash).first; known->second != input.hash)
        end.warn(fmt::format("file '{}' changed while the scenes of the plan were compared: scene '{}' has another "
                             "content of it than the scenes before",
                             input.file.filename().string(), scene.result.name));
    if (m_store.differs(index))
      end.warn(fmt::format("scene '{}' came out in two ways (nondeterminism): two workers that did the same work got "
                           "different figures; the report has those of the first",
                           scene.result.name));
    if (const std::string crash = m_store.crashOf(index); !crash.empty() && scene.result.error.empty())
      m_incidents.push_back(
          fmt::format("{}: flaky crash: a worker {}; the second try succeeded", scene.result.name, crash));
    m_workerSeconds += unit.run.cpuSeconds;
    m_shaders.insert(unit.run.shaders.begin(), unit.run.shaders.end());
    for (const auto& [stage, timeMs] : unit.run.timings) {
      const auto known = std::ranges::find(m_timings, stage, [](const auto& each) { return each.first; });
      if (known == m_timings.end())
        m_timings.emplace_back(stage, timeMs);
      else
        known->second += timeMs;
    }
    return scene;
  }

  const Plan& m_plan;
  const UnitStore m_store;
  ReportRequest m_request;
  Context m_context;
  RunBudgets m_budgets;
  std::filesystem::path m_baseline;
  std::string m_fault; // of the first missing unit that is there, of no use
  int m_stoppedBy = 0;
  std::string m_whyMissing;
  std::map<std::string, std::string> m_inputs; // files that scenes were read from, and their hashes
  std::vector<std::size_t> m_missing;          // in order
  std::set<std::string> m_shaders;
  std::vector<std::pair<std::string, double>> m_timings;
  std::vector<std::string> m_incidents;
  double m_workerSeconds = 0; // of CPU
};

} // namespace

ReportResult mergePlan(const Plan& plan, const std::filesystem::path& folder, const MergeOptions& options,
                       const Progress& progress) {
  return Merge(plan, folder, options).run(options.incomplete, progress);
}

} // namespace parity::job

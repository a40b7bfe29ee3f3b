#include "job/report_run.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <mutex>
#include <numeric>

#include <fmt/format.h>

#include "base/machine.h"
#include "base/parallel.h"
#include "job/context.h"
#include "job/kept_pictures.h"
#include "job/report_end.h"
#include "job/run_budgets.h"
#include "job/scene/scene_comparison.h"
#include "job/scene_times.h"
#include "job/scene_work.h"

namespace parity::job {

namespace {

// The scenes of a run, two at a time where there are threads: the driver compiles shaders on one core, and each has its
// own device. What comes out depends neither on who takes which scene nor on when.
class Run {
public:
  Run(Context& context, const ReportRequest& request, const RunBudgets& budgets, ReportEnd& end,
      const Progress& progress)
      : m_context(context), m_request(request), m_budgets(budgets), m_end(end), m_progress(progress),
        m_done(request.scenes.size()) {}

  // Once. Those that an interrupted run did not begin are not added.
  void compareScenes() {
    if (m_done.size() > 1 && base::threadCount() > 1) {
      if (m_context.cache().enabled()) m_context.numerics(); // once for both
      m_isShared = true;
      Context second(m_context, Context::ForAnotherThread{});
      std::future<void> other = std::async(std::launch::async, [&] { takeScenes(second); });
      takeScenes(m_context);
      other.get();
      m_context.take(second);
    } else {
      takeScenes(m_context);
    }
  }

private:
  void takeScenes(Context& context) {
    for (std::size_t i = take(); i < m_done.size(); i = take()) {
      const Tell tellOne = [&](double done, const std::string& what) { tell(i, done, what); };
      const auto start = std::chrono::steady_clock::now();
      const double cpuStart = base::cpuSeconds();
      ComparedScene scene = compareScene(context, m_request, i, m_budgets, tellOne);
      scene.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (!m_isShared) scene.cpuSeconds = base::cpuSeconds() - cpuStart;
      if (!scene.isCached && scene.result.error.empty())
        keepSceneTime(context.cache(), m_request.scenes[i], scene.seconds);
      dropPictures(scene, m_request.pictures, m_budgets.baseline(), m_end.facts());
      m_end.add(i, std::move(scene));
      const std::lock_guard lock(m_mutex);
      m_done[i] = 1;
    }
  }

  std::size_t take() {
    const std::lock_guard lock(m_mutex);
    if (m_context.stoppedBy() != 0 || m_next == m_done.size()) return m_done.size();
    const std::size_t next = m_next++;
    if (!m_isShared) return next;
    if (next == m_blockBegin + m_block.size())
      m_block = orderOfBlock(m_context.cache(), m_request.scenes, m_blockBegin = next);
    return m_block[next - m_blockBegin];
  }

  void tell(std::size_t scene, double done, const std::string& what) {
    if (!m_progress) return;
    const std::lock_guard lock(m_mutex);
    m_done[scene] = std::min(done, 0.999);
    const auto finished = std::ranges::count(m_done, 1.0);
    const std::string count = m_done.size() > 1 ? fmt::format("{} of {} done, ", finished, m_done.size()) : "";
    m_progress(fmt::format("{}{}: {}", count, m_request.scenes[scene].name, what),
               std::accumulate(m_done.begin(), m_done.end(), 0.0) / static_cast<double>(m_done.size()));
  }

  Context& m_context;
  const ReportRequest& m_request;
  const RunBudgets& m_budgets;
  ReportEnd& m_end;
  const Progress& m_progress;
  bool m_isShared = false;    // two scenes at a time
  std::mutex m_mutex;         // of all below
  std::vector<double> m_done; // how much of each; 1: all
  std::size_t m_next = 0;     // how many were begun
  std::size_t m_blockBegin = 0;
  std::vector<std::size_t> m_block; // from there on, in the order in which they are begun; where two are at a time
};

} // namespace

ReportResult runReport(Context& context, const ReportRequest& request, const Progress& progress) {
  RunBudgets budgets(context.settings().budgets, request.suiteBudgets);
  if (request.baseline.empty()) budgets.requireLevels();
  ReportEnd end(request, budgets, factsOf(context));
  Run(context, request, budgets, end, progress).compareScenes();
  return end.finish(context, {}, progress);
}

} // namespace parity::job

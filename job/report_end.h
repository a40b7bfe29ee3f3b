// The end of every run: compared scenes in, the report out. `parity report` and `parity merge` both end here, so the
// same scenes give the same bytes, wherever and in whatever order they were compared.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "job/baseline_pictures.h"
#include "job/report_run.h"
#include "job/run_budgets.h"
#include "job/scene/scene_comparison.h"

namespace parity::job {

// What is the same for every scene of a run, as the report says it.
struct RunFacts {
  std::string device; // its description
  std::string driver; // with what tells its builds apart
  std::vector<std::pair<std::string, std::string>> settings;
  std::vector<compare::Condition> conditions;
  std::string build = {}, numerics = {}; // of the binary and of the machine; empty: they are asked for at the end
};
// Makes no device.
RunFacts factsOf(Context& context);

class ReportEnd {
public:
  // What concerns the whole run comes first: without it nothing is rendered, and an older report stays. Reads the
  // baseline, from `baselineFile` where that is not the request's own; then cleans the folder. Both must outlive this.
  // Throws Error where the baseline or the folder cannot be used.
  ReportEnd(const ReportRequest& request, RunBudgets& budgets, RunFacts facts,
            const std::filesystem::path& baselineFile = {});

  // The scene at this place of the request. Writes its pictures, unless the page takes them; what goes wrong there is
  // the scene's error. Logs scenes in the order of the request. Thread-safe.
  void add(std::size_t index, ComparedScene scene);

  const RunFacts& facts() const { return m_facts; }
  // Of the whole run: it makes the verdict a warning at least.
  void warn(const std::string& words) { m_warnings.push_back(words); }

  // Once. A scene that was not added is not run, as the context was told to stop. run: what others have timed,
  // compiled and noticed; the context adds its own.
  ReportResult finish(Context& context, report::RunInfo run, const Progress& progress);

private:
  bool isBaselineInPlace() const;
  void setOrigin(Context& context, report::RunOrigin& origin) const;
  void holdBudgets(const Settings& settings, report::Report& report) const;
  void holdApprovals(const Settings& settings, report::Report& report) const;
  void keepBaselinePictures(report::Report& report, std::vector<EncodedPicture>& pictures) const;
  void explain(Context& context, report::Report& report, std::vector<EncodedPicture>& pictures,
               const Progress& progress) const;
  void keepApprovedPictures(const report::EarlierRuns& earlier, std::vector<EncodedPicture>& pictures) const;

  const ReportRequest& m_request;
  RunBudgets& m_budgets;
  RunFacts m_facts;
  std::filesystem::path m_baselineFile;
  std::optional<report::Report> m_baseline;
  compare::Approvals m_approvals;
  base::Day m_asOf; // of them
  std::optional<BaselinePictures> m_baselinePictures;
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
  std::string m_startedAt;
  std::vector<std::string> m_warnings;
  std::mutex m_mutex; // of all below
  std::vector<ComparedScene> m_scenes;
  std::vector<bool> m_isAdded;
  std::size_t m_logged = 0;
};

} // namespace parity::job

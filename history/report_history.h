// A history as the report's page, its summary and its exit code ask it.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "history/approved_states.h"
#include "history/row_history.h"
#include "history/store.h"
#include "history/trend.h"
#include "report/earlier_runs.h"

namespace parity::history {

class ReportHistory final : public report::EarlierRuns {
public:
  // Of the report's suite, and of the branch of its newest run in the history. started: of the report's run. Throws
  // Error for a history that cannot be used.
  ReportHistory(const std::filesystem::path& folder, const report::Report& report, const std::string& started);

  bool knowsAny() const override { return !m_before.runs.empty(); }
  report::RowStanding standingOf(const report::SceneResult& scene, const report::ViewResult& view,
                                 const report::MaterialResult* material) const override {
    return m_rows.of(scene, view, material);
  }
  std::string runsJson() const override;
  std::string trendsJson(const report::SceneResult& scene) const override;
  std::vector<report::ApprovedPicture> approvedPictures() const override;

private:
  void findApproved(const report::Report& report);
  void writeRow(base::JsonWriter& json, const RowName& row, std::int64_t sceneId) const;

  Store m_store;
  RunsBefore m_before;
  RowHistory m_rows;
  std::map<RowName, ApprovedState> m_approved;
  mutable std::mutex m_mutex; // of all below
  mutable TrendReader m_trends;
  mutable Statement m_subject;
};

} // namespace parity::history

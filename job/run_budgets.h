// Which budgets judge which scene of a run, and the baseline that the run is held against.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "compare/verdict/approval.h"
#include "compare/verdict/budget.h"
#include "job/scene_request.h"
#include "report/report.h"

namespace parity::job {

// Texts of files by their paths, which then are not read: those of a plan.
using FrozenFiles = std::map<std::string, std::string>;

// Each file is read once. Thread-safe.
class RunBudgets {
public:
  // ofRun (--budgets) goes before a scene's own file, ofSuite stands in where it has none; neither: the built-in
  // budgets. Throws Error where one of the two cannot be used.
  RunBudgets(std::optional<std::string> ofRun, std::optional<std::string> ofSuite, FrozenFiles frozen = {});

  // Throws Error where the scene's own file cannot be used.
  compare::Budgets of(const SceneRequest& request) const;
  // The file whose rules judge this scene; nothing: the built-in budgets do.
  std::optional<std::string> fileOf(const SceneRequest& request) const;
  // Throws Error as compare::loadBudgets does.
  const compare::Budgets& ofFile(const std::string& file) const;
  // Of the texts of the files that judge these scenes, 32 hexadecimal digits; empty where none does.
  std::string digestOf(const std::vector<SceneRequest>& requests) const;

  // Throws Error where a file of the constructor limits only regressions of its materials or its whole images: without
  // a baseline nothing could judge them, and that should not be told at the end of the run.
  void requireLevels() const;
  // A file of approvals. Throws Error as compare::loadApprovals does.
  compare::Approvals approvalsOf(const std::string& file) const;

  void setBaseline(const report::Report* baseline) { m_baseline = baseline; }
  const report::Report* baseline() const { return m_baseline; } // null: none

private:
  std::optional<std::string> m_ofRun, m_ofSuite;
  FrozenFiles m_frozen;
  const report::Report* m_baseline = nullptr;
  mutable std::mutex m_mutex; // of what is read
  mutable std::map<std::string, std::string> m_texts;
  mutable std::map<std::string, compare::Budgets> m_read;
};

} // namespace parity::job

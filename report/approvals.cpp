#include "report/approvals.h"

#include <algorithm>
#include <functional>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.h"

namespace parity::report {
namespace {

constexpr std::size_t kMostUnusedNamed = 5;

// Names cannot hold a zero byte.
std::string keyOf(const std::string& scene, const std::string& view, const std::string& material) {
  std::string key = scene;
  for (const std::string* part : {&view, &material}) (key += '\0') += *part;
  return key;
}

// The entries by their rows, and which of them were for something.
class Entries {
public:
  Entries(const compare::Approvals& approvals, base::Day asOf) : m_approvals(approvals), m_asOf(asOf) {
    for (std::size_t i = 0; i < approvals.entries.size(); ++i) {
      const compare::Approval& entry = approvals.entries[i];
      m_byRow[keyOf(entry.scene, entry.view, entry.material)].push_back(i);
    }
    m_why.assign(approvals.entries.size(), "no such row");
  }

  // The row's checks, and those of its variants.
  void apply(const std::string& row, const std::string& inputs, const compare::Figures& figures,
             std::vector<compare::CheckResult>& checks) {
    const auto found = m_byRow.find(row);
    if (found == m_byRow.end()) return;
    for (const std::size_t i : found->second) {
      const compare::Approval& entry = m_approvals.entries[i];
      const std::optional<double> figure = figures.find(entry.metric);
      m_why[i] = figures.pixels == 0 ? "its row is not seen" : !figure ? "the figure was not measured" : "";
      if (!m_why[i].empty()) continue;
      const compare::AppliedApproval applied =
          compare::applyApproval(entry, compare::originOf(m_approvals, entry), *figure, inputs, m_asOf);
      bool isNeeded = false, isJudged = false;
      for (compare::CheckResult& check : checks)
        if (check.metric == entry.metric) {
          check.approval = applied;
          isJudged = true;
          isNeeded = isNeeded || check.verdict >= compare::Verdict::warn || !check.judged();
        }
      if (!isJudged)
        m_why[i] = "no limit judges the figure";
      else if (!isNeeded && applied.daysLeft < 0)
        m_why[i] = "it expired, and the row passes without it";
    }
  }

  // isKnown: whether the run says anything of the scene. Empty where all were for something.
  std::string describeUnused(const std::function<bool(const std::string& scene)>& isKnown) const {
    std::vector<std::string> unused;
    for (std::size_t i = 0; i < m_why.size(); ++i) {
      const compare::Approval& entry = m_approvals.entries[i];
      if (!m_why[i].empty() && isKnown(entry.scene))
        unused.push_back(fmt::format("line {} ({} of {}, {}, view {}: {})", entry.line, entry.metric,
                                     entry.material.empty() ? "the whole image" : "'" + entry.material + "'",
                                     entry.scene, entry.view, m_why[i]));
    }
    if (unused.empty()) return {};
    const std::size_t count = unused.size(), named = std::min(count, kMostUnusedNamed);
    unused.resize(named);
    return fmt::format("{}: {} accept{} nothing: {}{}", std::filesystem::path(m_approvals.file).filename().string(),
                       count == 1 ? "an entry" : fmt::format("{} entries", count), count == 1 ? "s" : "",
                       fmt::join(unused, "; "), named < count ? fmt::format("; and {} more", count - named) : "");
  }

private:
  const compare::Approvals& m_approvals;
  base::Day m_asOf;
  std::unordered_map<std::string, std::vector<std::size_t>> m_byRow;
  std::vector<std::string> m_why; // by entry: why it is for nothing; empty: it is not
};

const compare::AppliedApproval* endingOf(const compare::CheckResult& check) {
  const bool isOver =
      check.judged() && (check.verdict == compare::Verdict::warn || check.verdict == compare::Verdict::fail);
  return isOver && check.approval && check.approval->daysLeft <= compare::kToldDaysBefore ? &*check.approval : nullptr;
}

} // namespace

std::string approvedInputs(const std::optional<SceneInputs>& inputs) {
  if (!inputs) return {};
  base::Hasher hasher;
  hasher.add(inputs->asset).add(inputs->environment);
  if (!inputs->pictures.empty()) hasher.add(inputs->pictures);
  return hasher.hex().substr(0, compare::kInputDigits);
}

void applyApprovals(Report& report, const compare::Approvals& approvals, base::Day asOf, EntriesFor entriesFor) {
  if (approvals.entries.empty()) return;
  const std::filesystem::path file(approvals.file);
  report.approvals = {(file.is_absolute() ? file.filename() : file).generic_string(), base::textOf(asOf),
                      approvals.entries.size()};
  Entries entries(approvals, asOf);
  std::unordered_map<std::string, bool> compared; // by scene: whether it was
  for (SceneResult& scene : report.scenes) {
    compared.emplace(scene.name, scene.error.empty());
    const std::string inputs = approvedInputs(scene.inputs);
    for (ViewResult& view : scene.views) {
      entries.apply(keyOf(scene.name, view.name, ""), inputs, view.whole, view.checks);
      for (MaterialResult& material : view.materials) {
        const std::string row = keyOf(scene.name, view.name, material.name);
        for (WhatIf& each : material.whatIf) entries.apply(row, inputs, each.figures, each.checks);
        entries.apply(row, inputs, material.figures, material.checks);
      }
    }
  }
  if (entriesFor == EntriesFor::none) return;
  const std::string unused = entries.describeUnused([&](const std::string& scene) {
    const auto found = compared.find(scene);
    return found == compared.end() ? entriesFor == EntriesFor::all : found->second;
  });
  if (!unused.empty()) report.warnings.push_back(unused);
}

std::vector<ExpiringApproval> expiringApprovals(const Report& report) {
  std::vector<ExpiringApproval> expiring;
  std::unordered_set<std::string_view> known; // by origin: a figure may have several checks
  const auto add = [&](const SceneResult& scene, const ViewResult& view, const std::string& material,
                       const std::vector<compare::CheckResult>& checks) {
    for (const compare::CheckResult& check : checks) {
      const compare::AppliedApproval* approval = endingOf(check);
      if (approval && known.insert(approval->origin).second)
        expiring.push_back({scene.name, view.name, material, check.metric, approval});
    }
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(scene, view, "", view.checks);
      for (const MaterialResult& material : view.materials) add(scene, view, material.name, material.checks);
    }
  std::ranges::stable_sort(expiring, {}, [](const ExpiringApproval& each) { return each.approval->daysLeft; });
  return expiring;
}

} // namespace parity::report

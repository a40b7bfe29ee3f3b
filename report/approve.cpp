// Entries of approvals from the rows of a report that fail.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "base/text/glob.h"
#include "report/approvals.h"

namespace parity::report {
namespace {

bool matchesAny(const std::vector<std::string>& globs, const std::string& name) {
  return std::ranges::any_of(globs, [&](const std::string& glob) { return base::matchesGlob(glob, name); });
}

double rounded(double value, int digits) { return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr); }

// A row of a view: a material, or the whole image (material null).
struct ApprovedRow {
  const SceneResult& scene;
  const ViewResult& view;
  const MaterialResult* material;

  const std::string& name() const {
    static const std::string kWhole;
    return material ? material->name : kWhole;
  }
  compare::Verdict verdict() const { return material ? material->verdict : view.wholeVerdict; }
  const compare::Figures& figures() const { return material ? material->figures : view.whole; }
  const std::vector<compare::CheckResult>& checks() const { return material ? material->checks : view.checks; }
  std::string words() const {
    return fmt::format("{} ({}, view {})", material ? "'" + material->name + "'" : "the whole image", scene.name,
                       view.name);
  }
};

class Approver {
public:
  explicit Approver(const ApproveRequest& request) : m_request(request) {}

  void take(const ApprovedRow& row) {
    const compare::Verdict least = m_request.warnings ? compare::Verdict::warn : compare::Verdict::fail;
    if (row.verdict() < least) return;
    const auto refuse = [&](const std::string& why) { result.refused.push_back(row.words() + ": " + why); };
    const compare::Figures& figures = row.figures();
    if (row.verdict() == compare::Verdict::error) return refuse("it could not be judged, and no error is approved");
    if (figures.pixels == 0) return refuse("it is not seen");
    if (figures.nonFinite > 0) return refuse("NaN and infinite pixels are never approved");
    bool isBeyond = false;
    for (const compare::CheckResult& check : row.checks()) {
      if (check.verdict != compare::Verdict::warn && check.verdict != compare::Verdict::fail) continue;
      if (!m_request.metrics.empty() && std::ranges::count(m_request.metrics, check.metric) == 0) continue;
      isBeyond = true;
      if (isTaken(row, check.metric)) continue; // it has a regression, too
      if (const std::string why = add(row, check.metric); !why.empty()) refuse(why);
    }
    if (!isBeyond && m_request.metrics.empty() && row.verdict() == compare::Verdict::fail)
      refuse("no figure of it is beyond a limit");
  }

  ApproveResult result;

private:
  bool isTaken(const ApprovedRow& row, const std::string& metric) const {
    if (result.entries.empty()) return false;
    for (auto each = result.entries.rbegin(); each != result.entries.rend(); ++each) {
      if (each->scene != row.scene.name || each->view != row.view.name || each->material != row.name()) return false;
      if (each->metric == metric) return true;
    }
    return false;
  }

  // Why not; empty: it is added.
  std::string add(const ApprovedRow& row, const std::string& metric) {
    const std::optional<double> figure = row.figures().find(metric);
    if (!figure || !std::isfinite(*figure)) return metric + " is not a number";
    const std::shared_ptr<const compare::Statistic> statistic = compare::statisticByName(metric);
    if (!statistic) return metric + " is not known";
    compare::Approval entry;
    entry.scene = row.scene.name;
    entry.view = row.view.name;
    entry.material = row.name();
    entry.metric = metric;
    entry.value = rounded(*figure, 4);
    entry.slack = rounded(m_request.slack * std::abs(*figure), 2);
    entry.slack = std::max(entry.slack, rounded(2 * std::abs(*figure - entry.value), 2)); // rounding is no loss
    if (!compare::canBeBeyond(*statistic, compare::mostOf(entry, statistic->better)))
      return fmt::format("no {} can be worse than {:g}, so the entry would accept whatever comes", metric, *figure);
    entry.until = m_request.until;
    entry.owner = m_request.owner;
    entry.reason = m_request.reason;
    entry.inputs = approvedInputs(row.scene.inputs);
    if (entry.inputs.empty()) return "the report does not have the digests of its inputs; make it again";
    result.entries.push_back(std::move(entry));
    return {};
  }

  const ApproveRequest& m_request;
};

} // namespace

ApproveResult approveRows(const Report& report, const ApproveRequest& request) {
  Approver approver(request);
  const auto isAsked = [](const std::vector<std::string>& globs, const std::string& name) {
    return globs.empty() || matchesAny(globs, name);
  };
  for (const SceneResult& scene : report.scenes) {
    if (!isAsked(request.scenes, scene.name)) continue;
    for (const ViewResult& view : scene.views) {
      if (!isAsked(request.views, view.name)) continue;
      if (request.wholes) approver.take({scene, view, nullptr});
      for (const MaterialResult& material : view.materials)
        if (matchesAny(request.materials, material.name)) approver.take({scene, view, &material});
    }
  }
  return std::move(approver.result);
}

MergedApprovals mergeApprovals(compare::Approvals& approvals, const std::vector<compare::Approval>& entries) {
  MergedApprovals merged;
  std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> places;
  const auto keyOf = [](const compare::Approval& entry) {
    return std::tuple(entry.scene, entry.view, entry.material, entry.metric);
  };
  for (std::size_t i = 0; i < approvals.entries.size(); ++i) places.emplace(keyOf(approvals.entries[i]), i);
  for (const compare::Approval& entry : entries) {
    const auto [place, isNew] = places.emplace(keyOf(entry), approvals.entries.size());
    if (isNew) {
      approvals.entries.push_back(entry);
      ++merged.added;
    } else {
      approvals.entries[place->second] = entry;
      ++merged.replaced;
    }
  }
  return merged;
}

} // namespace parity::report

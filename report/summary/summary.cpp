#include "report/summary/summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/approvals.h"
#include "report/causes.h"
#include "report/wording.h"

namespace parity::report {
namespace {

std::string plural(std::size_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string placeOf(const std::string& scene, const std::string& view) {
  return view.empty() ? scene : fmt::format("{}, view {}", scene, view);
}

std::string nameOf(const std::string& material) { return material.empty() ? "whole image" : material; }

// A row with what it is sorted by.
struct GravityLine {
  SummaryLine line;
  compare::Verdict verdict = compare::Verdict::pass;
  double flip = 0;
};

class Summarizer {
public:
  Summarizer(const Report& report, const RunInfo& run, const FindStanding& find)
      : m_report(report), m_run(run), m_find(find) {}

  Summary make() {
    collectRows();
    Summary summary;
    summary.title = m_report.suite.empty() ? m_report.tool : m_report.tool + ": " + m_report.suite;
    summary.verdict = compare::nameOf(m_report.verdict);
    summary.headline = headline(m_report);
    if (m_knowsBefore)
      summary.changes = fmt::format("{}, {} still failing, {} fixed",
                                    plural(count(Standing::isNew) + m_report.lost.size(), "new failure"),
                                    count(Standing::still), count(Standing::fixed));
    m_sections = &summary.sections;
    add("Errors", errors());
    add("New failures", linesOf(Standing::isNew));
    add("Failures", linesOf(Standing::unknown));
    add("Required and missing", lost());
    add("Still failing", linesOf(Standing::still));
    add("Approvals that end", expiring());
    add("Fixed", linesOf(Standing::fixed));
    add("Flaky", flaky());
    add("Gone since the baseline", gone());
    add("New since the baseline", std::move(m_new));
    add("Causes", causes());
    add("Accepted", linesOf(Standing::accepted));
    return summary;
  }

private:
  void add(const char* title, std::vector<SummaryLine> lines) {
    if (!lines.empty()) m_sections->push_back({title, std::move(lines)});
  }

  std::size_t count(Standing standing) const {
    const auto found = m_rows.find(standing);
    return found == m_rows.end() ? 0 : found->second.size();
  }

  static std::string noteOf(const RowStanding& row) {
    std::vector<std::string> parts;
    if (row.nights > 0) parts.push_back(plural(row.nights, "night"));
    if (!row.owner.empty()) parts.push_back("owner: " + row.owner);
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  void collectRow(const SceneResult& scene, const ViewResult& view, const MaterialResult* material) {
    const std::optional<BaselineChange>& baseline = material ? material->baseline : view.baseline;
    m_knowsBefore = m_knowsBefore || baseline.has_value();
    SummaryLine line{material ? material->name : nameOf(""), placeOf(scene.name, view.name), "", "", ""};
    if (baseline && baseline->isNew && !(material && material->seenElsewhere)) m_new.push_back(line);
    const RowStanding row = m_find ? m_find(scene, view, material) : standingOf(view, material);
    if (row.standing == Standing::none) return;
    m_knowsBefore = m_knowsBefore || row.standing == Standing::isNew || row.standing == Standing::still ||
                    row.standing == Standing::fixed;
    const bool isOver = isFailure(material ? material->verdict : view.wholeVerdict);
    const std::string& accepted = material ? material->accepted : view.accepted;
    line.why = row.standing == Standing::accepted ? accepted : material ? material->reason : view.reason;
    if (isOver && material)
      if (const std::string cause = describeCauses(*material, view.reference); !cause.empty()) line.why += "; " + cause;
    line.note = noteOf(row);
    line.picture = material && !material->crops.flip.empty() ? material->crops.flip : view.images.flip;
    const compare::Figures& figures = material ? material->figures : view.whole;
    const double flip = figures.find("flip.mean").value_or(0);
    m_rows[row.standing].push_back(
        {std::move(line), material ? material->verdict : view.wholeVerdict, std::isnan(flip) ? INFINITY : flip});
  }

  void collectRows() {
    for (const SceneResult& scene : m_report.scenes)
      for (const ViewResult& view : scene.views) {
        collectRow(scene, view, nullptr);
        for (const MaterialResult& material : view.materials) collectRow(scene, view, &material);
      }
  }

  std::vector<SummaryLine> linesOf(Standing standing) {
    std::vector<GravityLine>& rows = m_rows[standing];
    std::ranges::stable_sort(rows, [](const GravityLine& a, const GravityLine& b) {
      return a.verdict != b.verdict ? a.verdict > b.verdict : a.flip > b.flip;
    });
    std::vector<SummaryLine> lines;
    for (GravityLine& row : rows) lines.push_back(std::move(row.line));
    return lines;
  }

  std::vector<SummaryLine> errors() const {
    std::vector<SummaryLine> lines;
    if (m_report.scenes.empty()) lines.push_back({"nothing was compared", "", "", "", ""});
    if (m_report.baseline && !m_report.baseline->error.empty())
      lines.push_back({"baseline", "", m_report.baseline->error, "", ""});
    for (const SceneResult& scene : m_report.scenes)
      if (!scene.error.empty()) lines.push_back({scene.name, "", scene.error, "", ""});
    for (const RunProblem& problem : problemsOf(m_report))
      if (problem.verdict == compare::Verdict::error) lines.push_back({"the run", "", problem.reason, "", ""});
    return lines;
  }

  std::vector<SummaryLine> lost() const {
    std::vector<SummaryLine> lines;
    for (const RunProblem& problem : m_report.lost)
      if (problem.verdict != compare::Verdict::error) lines.push_back({"the run", "", problem.reason, "", ""});
    return lines;
  }

  std::vector<SummaryLine> expiring() const {
    std::vector<SummaryLine> lines;
    for (const ExpiringApproval& each : expiringApprovals(m_report)) {
      const compare::AppliedApproval& approval = *each.approval;
      const std::string days = approval.daysLeft < 0    ? fmt::format("ended {} ago", plural(-approval.daysLeft, "day"))
                               : approval.daysLeft == 0 ? "ends today"
                                                        : fmt::format("{} left", plural(approval.daysLeft, "day"));
      lines.push_back({nameOf(each.material), placeOf(each.scene, each.view),
                       fmt::format("{}: {} ({})", each.metric, approval.reason, approval.origin),
                       fmt::format("{} (until {}), owner: {}", days, approval.until, approval.owner), ""});
    }
    return lines;
  }

  std::vector<SummaryLine> flaky() {
    std::vector<SummaryLine> lines = linesOf(Standing::flaky);
    for (const std::string& incident : m_run.incidents) lines.push_back({"the run", "", incident, "", ""});
    return lines;
  }

  std::vector<SummaryLine> gone() const {
    std::vector<SummaryLine> lines;
    if (m_report.baseline)
      for (const GoneRow& row : m_report.baseline->gone)
        lines.push_back({row.material.empty() ? row.view.empty() ? "the scene" : "the view" : row.material,
                         placeOf(row.scene, row.view), "", "", ""});
    return lines;
  }

  std::vector<SummaryLine> causes() const {
    std::vector<SummaryLine> lines;
    for (const CauseTotal& total : totalsByCause(m_report))
      lines.push_back({total.words, "",
                       fmt::format("{}, worst: {} in {}", plural(total.materials, "material"),
                                   total.worst ? total.worst->name : "", total.scene ? total.scene->name : ""),
                       "", ""});
    return lines;
  }

  const Report& m_report;
  const RunInfo& m_run;
  const FindStanding& m_find;
  bool m_knowsBefore = false;
  std::map<Standing, std::vector<GravityLine>> m_rows;
  std::vector<SummaryLine> m_new;
  std::vector<SummarySection>* m_sections = nullptr;
};

} // namespace

Summary summarize(const Report& report, const RunInfo& run, const FindStanding& find) {
  return Summarizer(report, run, find).make();
}

std::vector<std::size_t> fitLines(std::span<const SummarySection> sections, std::size_t bytes,
                                  const std::function<std::size_t(const SummaryLine&)>& bytesOf) {
  constexpr std::size_t kOfEach = 5;
  std::vector<std::size_t> counts(sections.size());
  const auto fill = [&](std::size_t section, std::size_t most) {
    const std::vector<SummaryLine>& lines = sections[section].lines;
    for (std::size_t& count = counts[section]; count < std::min(most, lines.size()); ++count) {
      const std::size_t taken = bytesOf(lines[count]);
      if (taken > bytes) return false;
      bytes -= taken;
    }
    return true;
  };
  for (std::size_t i = 0; i < sections.size(); ++i) fill(i, kOfEach);
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (!fill(i, sections[i].lines.size())) break;
  return counts;
}

std::string pictureUrl(const std::string& picturesUrl, const std::string& picture) {
  if (picturesUrl.empty() || picture.empty()) return {};
  std::string url = picturesUrl;
  if (!url.ends_with('/')) url += '/';
  for (const char c : picture) {
    const auto byte = static_cast<unsigned char>(c);
    const bool isPlain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
                         c == '/' || c == '-' || c == '_' || c == '.';
    url += isPlain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return url;
}

} // namespace parity::report

#include "history/step.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "report/view_choice.h"

namespace parity::history {

namespace {

bool isBeyond(const StepLimit& limit, double value) {
  switch (limit.figure.better) {
  case compare::Better::lower:
    return value > limit.most;
  case compare::Better::higher:
    return value < limit.most;
  case compare::Better::nearZero:
    return std::abs(value) > limit.most;
  }
  return true;
}

class Judge {
public:
  explicit Judge(const std::vector<StepLimit>& limits) : m_limits(limits) {}

  void untestable(const std::string& reason) {
    if (m_untestable.empty()) m_untestable = reason;
  }
  void row(const std::string& name, const compare::Figures& figures) {
    if (figures.pixels == 0) return;
    ++m_rows;
    for (const StepLimit& limit : m_limits) {
      const std::optional<double> value = figures.find(limit.figure.name);
      if (!value || std::isnan(*value) || figures.nonFinite > 0)
        untestable(fmt::format("{}: {} {}", name, limit.figure.name, !value ? "was not measured" : "is no number"));
      else if (isBeyond(limit, *value) && m_bad.empty())
        m_bad = fmt::format("{}: {} is {:.6g}; the limit is {:.6g}", name, limit.figure.name, *value, limit.most);
    }
  }
  StepVerdict verdict() const {
    if (!m_bad.empty()) return {StepVerdict::bad, m_bad};
    if (!m_untestable.empty()) return {StepVerdict::untestable, m_untestable};
    if (m_rows == 0) return {StepVerdict::untestable, "the report shows no such row"};
    return {StepVerdict::good, fmt::format("{} row{} within the limit", m_rows, m_rows == 1 ? " is" : "s are")};
  }

private:
  const std::vector<StepLimit>& m_limits;
  std::size_t m_rows = 0;
  std::string m_bad, m_untestable; // the first
};

bool isChosenMaterial(const StepChoice& choice, const std::string& name) {
  return choice.materials.empty() ||
         std::ranges::any_of(choice.materials, [&](const std::string& glob) { return base::matchesGlob(glob, name); });
}

// Of a scene that failed some views are not there.
bool mayBeChosen(const StepChoice& choice, const std::string& scene) {
  return choice.views.empty() || std::ranges::any_of(choice.views, [&](const std::string& glob) {
           std::size_t at = glob.size();
           for (; at != std::string::npos && at > 0; at = glob.rfind('/', at - 1))
             if (base::matchesGlob(glob.substr(0, at), scene)) return true;
           return false;
         });
}

} // namespace

StepLimit readLimit(const std::string& text) {
  const std::size_t at = text.rfind('=');
  double most = 0;
  const char* end = text.data() + text.size();
  const auto read = at == std::string::npos ? std::from_chars_result{end, std::errc::invalid_argument}
                                            : std::from_chars(text.data() + at + 1, end, most);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(most))
    throw base::Error(base::ExitCode::usage, "--at-most", text, "is not FIGURE=NUMBER, such as flip.mean=.062");
  return {compare::requireStatistic(text.substr(0, at), "--at-most"), most};
}

StepVerdict judgeStep(const report::Report& report, const std::vector<StepLimit>& limits, const StepChoice& choice) {
  Judge judge(limits);
  for (const report::SceneResult& scene : report.scenes) {
    if (!scene.error.empty() && mayBeChosen(choice, scene.name))
      judge.untestable(fmt::format("{}: {}", scene.name, scene.error));
    for (const report::ViewResult& view : scene.views) {
      if (!report::isChosen(choice.views, scene.name, view.name)) continue;
      const std::string place = fmt::format("{}/{}", scene.name, view.name);
      if (choice.wholes) judge.row(place, view.whole);
      if (choice.wholes) continue;
      for (const report::MaterialResult& material : view.materials)
        if (isChosenMaterial(choice, material.name)) judge.row(place + "/" + material.name, material.figures);
    }
  }
  return judge.verdict();
}

} // namespace parity::history

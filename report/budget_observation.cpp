#include "report/budget_observation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "compare/verdict/budget.h"
#include "report/budget_limits.h"

namespace parity::report {
namespace {

// As settleMaterial has it, under a rule that says nothing of pixels.
bool isSeenWell(const compare::Figures& figures) {
  return figures.pixels >= compare::kDefaultMinPixels || (figures.pixels > 0 && figures.nonFinite > 0);
}

// Whether no pixel differs, as any figure says that does say so.
bool isIdentical(const compare::Figures& figures) {
  for (const char* name : {"flip.max", "rmse", "maxabs"})
    if (figures.find(name) == std::optional(0.0)) return true;
  return figures.find("psnr") == std::optional(double{INFINITY});
}

class Observer {
public:
  Observer(const std::vector<ObservedRun>& runs, const std::vector<compare::Statistic>& figures)
      : m_runs(runs), m_figures(figures) {}

  Observation observe() {
    for (m_run = 0; m_run < m_runs.size(); ++m_run)
      for (const SceneResult& scene : m_runs[m_run].report.scenes) addScene(scene);
    for (const auto& [scene, sources] : m_broken) {
      const bool isEverCompared = m_compared.contains(scene);
      (isEverCompared ? m_result.notes : m_result.errors)
          .push_back(fmt::format("scene '{}' could not be compared in {}{}", scene, sources.front(),
                                 isEverCompared ? "" : ", and no rule can accept that"));
    }
    return std::move(m_result);
  }

private:
  const std::string& source() const { return m_runs[m_run].source; }

  void addScene(const SceneResult& scene) {
    if (!scene.error.empty() || scene.views.empty())
      m_broken[scene.name].push_back(source());
    else
      m_compared.insert(scene.name);
    std::set<std::string> names;
    for (const ViewResult& view : scene.views) {
      const std::string place = fmt::format("scene {}, view {}", scene.name, view.name);
      if (view.materials.empty()) refuse(place + ": there is no material to compare");
      for (const MaterialResult& material : view.materials)
        if (names.insert(material.name).second) addMaterial(scene, material.name);
      ObservedSubject& whole = subjectOf(scene.name, "", true);
      if (view.whole.pixels == 0)
        whole.isNotSeen = true;
      else
        addRow(whole, place + ", whole image", view.whole, view.truth);
    }
  }

  void addMaterial(const SceneResult& scene, const std::string& name) {
    ObservedSubject& subject = subjectOf(scene.name, name, false);
    bool isSeen = false;
    const auto forEachRow = [&](auto visit) {
      for (const ViewResult& view : scene.views)
        for (const MaterialResult& material : view.materials)
          if (material.name == name) visit(view, material);
    };
    forEachRow([&](const ViewResult&, const MaterialResult& row) { isSeen = isSeen || isSeenWell(row.figures); });
    forEachRow([&](const ViewResult& view, const MaterialResult& row) {
      if (isSeenWell(row.figures)) {
        const std::string place = fmt::format("scene {}, view {}, material {}", scene.name, view.name, name);
        subject.notModelled.insert(row.notModelled.begin(), row.notModelled.end());
        addRow(subject, place, row.figures, row.truth);
        // Accepted NaN do not make it larger.
        subject.isTooSmall = subject.isTooSmall || row.figures.pixels < compare::kDefaultMinPixels;
      } else if (!isSeen) { // a view that shows more of it says all that there is to say
        (row.figures.pixels == 0 ? subject.isNotSeen : subject.isTooSmall) = true;
      }
    });
  }

  void addRow(ObservedSubject& subject, const std::string& place, const compare::Figures& figures,
              const std::optional<compare::Truth>& truth) {
    if (truth && truth->figures.nonFinite > 0) refuse(place + ": pixels of the truth are NaN or infinite");
    subject.isSeen = true;
    if (figures.nonFinite > 0) {
      subject.nonFinite = std::max(subject.nonFinite, figures.nonFinite);
      return;
    }
    const bool isMostly = !subject.whole && figures.clipped() > compare::kMostClipping;
    if (isMostly)
      subject.mostlyClipped = std::max(subject.mostlyClipped, figures.clipped());
    else if (figures.clipped() >= compare::kNotableClipping)
      subject.clipped = std::max(subject.clipped, figures.clipped());
    m_result.isAnyCompared = m_result.isAnyCompared || (!subject.whole && !isMostly);
    subject.isIdentical = subject.isIdentical && isIdentical(figures);
    addFigures(subject, place, figures);
    if (const std::string unsound = findUnsound(figures); !unsound.empty())
      refuse(fmt::format("{}: {} is not a number", place, unsound));
  }

  void addFigures(ObservedSubject& subject, const std::string& place, const compare::Figures& figures) {
    std::vector<bool> judgeable;
    for (std::size_t i = 0; i < m_figures.size(); ++i) {
      const std::optional<double> value = figures.find(m_figures[i].name);
      if (!value) throw base::fileError(source(), place, m_figures[i].name + " was not measured");
      if (std::isnan(*value)) throw base::fileError(source(), place, m_figures[i].name + " is not a number");
      judgeable.push_back(compare::describeTooDark(m_figures[i].name, figures).empty());
      if (!judgeable.back()) continue;
      const double error = errorOf(m_figures[i], *value);
      double& worst = subject.errors[i][m_run];
      worst = std::isnan(worst) ? error : std::max(worst, error);
    }
    subject.judgeable.insert(std::move(judgeable));
  }

  void refuse(const std::string& what) {
    m_result.errors.push_back(fmt::format("{} in {}, and no rule can accept that", what, source()));
  }

  ObservedSubject& subjectOf(const std::string& scene, const std::string& material, bool whole) {
    const auto found = std::ranges::find_if(m_result.subjects, [&](const ObservedSubject& each) {
      return each.whole == whole && each.scene == scene && each.material == material;
    });
    if (found != m_result.subjects.end()) return *found;
    ObservedSubject& subject = m_result.subjects.emplace_back();
    subject.scene = scene;
    subject.material = material;
    subject.whole = whole;
    subject.errors.assign(m_figures.size(), std::vector<double>(m_runs.size(), NAN));
    return subject;
  }

  const std::vector<ObservedRun>& m_runs;
  const std::vector<compare::Statistic>& m_figures;
  std::size_t m_run = 0;
  Observation m_result;
  std::map<std::string, std::vector<std::string>> m_broken; // by scene: the runs in which it could not be compared
  std::set<std::string> m_compared;
};

} // namespace

Observation observe(const std::vector<ObservedRun>& runs, const std::vector<compare::Statistic>& figures) {
  return Observer(runs, figures).observe();
}

} // namespace parity::report

#include "report/record/derived.h"

#include <set>

#include "compare/pooling/statistic.h"
#include "compare/verdict/wording.h"

namespace parity::report {
namespace {

std::set<std::string> figureNames(const Report& report) {
  std::set<std::string> names;
  const auto add = [&](const compare::Figures& figures, const std::vector<compare::CheckResult>& checks) {
    for (const compare::Figure& figure : figures.values) names.insert(figure.name);
    for (const compare::CheckResult& check : checks) names.insert(check.metric);
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(view.whole, view.checks);
      for (const MaterialResult& material : view.materials) add(material.figures, material.checks);
    }
  return names;
}

} // namespace

std::map<std::string, FigureWords> figureWordsOf(const Report& report) {
  std::map<std::string, FigureWords> words;
  for (const std::string& name : figureNames(report))
    if (const std::shared_ptr<const compare::Statistic> statistic = compare::statisticByName(name)) {
      const bool isShare = compare::isShare(name);
      words[name] = {statistic->label, isShare ? "%" : statistic->unit, isShare ? 1 : statistic->digits,
                     statistic->better == compare::Better::lower    ? "lower"
                     : statistic->better == compare::Better::higher ? "higher"
                                                                    : "near zero"};
    }
  return words;
}

std::string biasOf(const compare::Figures& figures, const std::string& test) {
  return figures.pixels > 0 ? compare::describeBias(figures, test) : std::string();
}

} // namespace parity::report

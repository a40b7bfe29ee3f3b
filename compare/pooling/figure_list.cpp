#include "compare/pooling/figure_list.h"

#include <algorithm>

#include "base/error.h"
#include "base/text/nearest.h"
#include "compare/metrics/metric.h"

namespace parity::compare {

namespace {

// The nearest of all figures and metrics is named; a list of all would be of figures alone.
[[noreturn]] void throwUnknown(std::string_view name, const std::string& subject) {
  const std::vector<std::string> figures = knownStatistics();
  std::vector<std::string_view> metrics, known(figures.begin(), figures.end());
  for (const Metric& metric : metricRegistry()) metrics.push_back(metric.name);
  known.insert(known.begin(), metrics.begin(), metrics.end());
  const std::string asked = base::askNearest(name, known);
  throw base::Error(base::ExitCode::usage, subject, "'" + std::string(name) + "'",
                    "unknown metric; " + (asked.empty() ? base::describeNearest(name, metrics) : asked));
}

} // namespace

std::vector<Statistic> parseFigures(std::string_view commaSeparated, const std::string& subject) {
  std::vector<Statistic> figures;
  for (std::size_t begin = 0; begin <= commaSeparated.size();) {
    const std::size_t end = std::min(commaSeparated.find(',', begin), commaSeparated.size());
    const std::string_view part = commaSeparated.substr(begin, end - begin);
    if (part.empty())
      throw base::Error(base::ExitCode::usage, subject, "'" + std::string(commaSeparated) + "'",
                        "give names of metrics or figures, separated by commas");
    const std::shared_ptr<const Statistic> figure = statisticByName(part);
    const Metric* metric = figure ? nullptr : findMetric(part);
    if (!figure && !metric) throwUnknown(part, subject);
    figures.push_back(figure ? *figure : metric->statistics.front());
    begin = end + 1;
  }
  return figures;
}

} // namespace parity::compare

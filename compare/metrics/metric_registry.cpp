// Which metrics there are, and by which names they are found.
#include <algorithm>

#include "base/error.h"
#include "base/text/nearest.h"
#include "compare/metrics/metric.h"
#include "compare/metrics/metric_makers.h"
#include "compare/pooling/figure_list.h"

namespace parity::compare {

const std::vector<Metric>& metricRegistry() {
  static const std::vector<Metric> kMetrics = {
      makeFlipMetric(), makeHdrFlipMetric(), makeSsimMetric(),   makeMsSsimMetric(), makeDeltaEMetric(),
      makeRmseMetric(), makePsnrMetric(),    makeRelMseMetric(), makeMaxAbsMetric(), makeBiasMetric(),
  };
  return kMetrics;
}

const Metric* findMetric(std::string_view name) {
  const auto& metrics = metricRegistry();
  const auto found = std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == name; });
  return found == metrics.end() ? nullptr : &*found;
}

const Metric& requireMetric(std::string_view name, const std::string& subject) {
  if (const Metric* metric = findMetric(name)) return *metric;
  std::vector<std::string_view> known;
  for (const Metric& metric : metricRegistry()) known.push_back(metric.name);
  throw base::Error(base::ExitCode::usage, subject, "'" + std::string(name) + "'",
                    "unknown metric; " + base::describeNearest(name, known));
}

std::vector<std::string> parseMetricNames(std::string_view commaSeparated, const std::string& subject) {
  const std::vector<Statistic> wanted = parseFigures(commaSeparated, subject);
  std::vector<std::string> names;
  for (const Metric& metric : metricRegistry())
    if (std::ranges::find(wanted, metric.name, &Statistic::metric) != wanted.end()) names.push_back(metric.name);
  return names;
}

} // namespace parity::compare

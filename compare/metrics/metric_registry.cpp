// Which metrics there are, and by which names they are found.
#include <algorithm>

#include "base/error.h"
#include "base/text/nearest.h"
#include "compare/metrics/metric.h"
#include "compare/metrics/metric_makers.h"

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
  std::vector<std::string_view> wanted;
  for (std::size_t begin = 0; begin <= commaSeparated.size();) {
    const std::size_t end = std::min(commaSeparated.find(',', begin), commaSeparated.size());
    const std::string_view part = commaSeparated.substr(begin, end - begin);
    if (part.empty())
      throw base::Error(base::ExitCode::usage, subject, "'" + std::string(commaSeparated) + "'",
                        "give names of metrics, separated by commas");
    wanted.push_back(requireMetric(part, subject).name);
    begin = end + 1;
  }
  std::vector<std::string> names;
  for (const Metric& metric : metricRegistry())
    if (std::find(wanted.begin(), wanted.end(), metric.name) != wanted.end()) names.push_back(metric.name);
  return names;
}

} // namespace parity::compare

// Names of figures, looked up in the registry of metrics.
#include "compare/pooling/statistic.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "compare/metrics/metric.h"
#include "compare/pooling/figures.h"

namespace parity::compare {
namespace {

constexpr std::string_view kFractionOver = ".fraction_over(";

// "flip.fraction_over(0.1)": the share of pixels above a threshold within the metric's range.
std::shared_ptr<const Statistic> fractionOver(std::string_view name) {
  const std::size_t at = name.find(kFractionOver);
  if (at == std::string_view::npos || !name.ends_with(')')) return nullptr;
  const Metric* metric = findMetric(name.substr(0, at));
  if (!metric || !metric->hasFractionOver) return nullptr;
  const std::string_view text = name.substr(at + kFractionOver.size(), name.size() - 1 - at - kFractionOver.size());
  double threshold = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threshold);
  if (error != std::errc() || end != text.data() + text.size()) return nullptr;
  const Statistic& ranged = metric->statistics.front();
  if (!(threshold >= ranged.least && threshold < ranged.most)) return nullptr; // NaN is in no range
  Statistic statistic;
  statistic.name = fmt::format("{}.fraction_over({})", metric->name, threshold + 0.); // -0 is 0
  statistic.metric = metric->name;
  statistic.label = fmt::format("share of pixels with {} over {}", metric->label, threshold + 0.);
  return std::make_shared<const Statistic>(std::move(statistic));
}

} // namespace

std::optional<double> Figures::find(std::string_view name) const {
  const auto found = std::find_if(values.begin(), values.end(), [&](const Figure& f) { return f.name == name; });
  if (found == values.end()) return std::nullopt;
  return found->value;
}

std::shared_ptr<const Statistic> statisticByName(std::string_view name) {
  static const auto index = [] {
    std::unordered_map<std::string_view, const Statistic*> all;
    for (const Metric& metric : metricRegistry())
      for (const Statistic& statistic : metric.statistics) all.emplace(statistic.name, &statistic);
    return all;
  }();
  // Every figure of every row is looked up, several times: without a copy. The registry stays as long as the program.
  if (const auto known = index.find(name); known != index.end()) return {std::shared_ptr<void>(), known->second};
  return fractionOver(name);
}

bool canBeBeyond(const Statistic& statistic, double limit) {
  return statistic.better == Better::higher ? limit > statistic.least : limit < statistic.most;
}

bool isShare(std::string_view name) { return name.find(kFractionOver) != std::string_view::npos; }

std::vector<std::string> knownStatistics() {
  std::vector<std::string> names;
  for (const Metric& metric : metricRegistry()) {
    for (const Statistic& statistic : metric.statistics) names.push_back(statistic.name);
    if (metric.hasFractionOver) names.push_back(metric.name + std::string(kFractionOver) + "X)");
  }
  return names;
}

Statistic requireStatistic(std::string_view name, const std::string& subject) {
  if (const std::shared_ptr<const Statistic> found = statisticByName(name)) return *found;
  const std::vector<std::string> known = knownStatistics();
  const std::vector<std::string_view> views(known.begin(), known.end());
  throw base::Error(base::ExitCode::usage, subject, "'" + std::string(name) + "'",
                    "unknown figure; " + base::describeNearest(name, views));
}

} // namespace parity::compare

#include "compare/metrics/metric_parts.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/error.h"
#include "compare/metrics/color_rows.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {
namespace {

double numberIn(std::string_view text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

std::string labelOfPart(std::string_view part, const std::string& label) {
  if (part == "mean") return "mean " + label;
  if (part == "max") return "largest " + label;
  if (part == "min") return "least " + label;
  if (part == "p50") return "median of " + label;
  const int percent = static_cast<int>(numberIn(part.substr(1)));
  return fmt::format("{}th percentile of {}", percent, label);
}

base::Image mapOf(const MetricInput& input, const MetricOptions& options, bool linear, float worst,
                  const RowFunction& make) {
  const Rect box = boxOf(input, options);
  base::Image map(input.width(), input.height(), 1);
  forRows(box, [&](int y) {
    std::vector<float> rows(6 * static_cast<std::size_t>(box.width));
    float *reference = rows.data(), *test = reference + 3 * static_cast<std::size_t>(box.width);
    if (linear) {
      readLinearRow(input.reference, input.referenceLinear, box.x, y, box.width, reference);
      readLinearRow(input.test, input.testLinear, box.x, y, box.width, test);
    } else {
      readDisplayRow(input.reference, box.x, y, box.width, reference);
      readDisplayRow(input.test, box.x, y, box.width, test);
    }
    make({reference, test}, box.width, map.at(box.x, y));
  });
  setPixels(map, input.nonFinite, worst);
  return map;
}

} // namespace

Rect boxOf(const MetricInput& input, const MetricOptions& options) {
  if (!options.box) return {0, 0, input.width(), input.height()};
  const Rect& box = *options.box;
  if (box.empty() || box.x < 0 || box.y < 0 || box.x + box.width > input.width() || box.y + box.height > input.height())
    throw base::Error(base::ExitCode::failed, "region",
                      fmt::format("{} x {} at {}, {}", box.width, box.height, box.x, box.y),
                      fmt::format("is not inside the image of {} x {}", input.width(), input.height()));
  return box;
}

base::Image lumaMap(const PixelView& view, const Rect& box) {
  base::Image luma(view.width, view.height, 1);
  forRows(box, [&](int y) {
    std::vector<float> rgb(3 * static_cast<std::size_t>(box.width));
    readDisplayRow(view, box.x, y, box.width, rgb.data());
    lumaRow(rgb.data(), box.width, luma.at(box.x, y));
  });
  return luma;
}

std::string_view partOf(const Statistic& statistic) {
  const std::string_view name = statistic.name;
  return name.size() > statistic.metric.size() ? name.substr(statistic.metric.size() + 1) : std::string_view();
}

std::vector<Statistic> distributionStatistics(const std::string& metric, const std::string& label,
                                              std::span<const std::string_view> parts, const DistributionRange& range) {
  std::vector<Statistic> out;
  for (const std::string_view part : parts)
    out.push_back({fmt::format("{}.{}", metric, part), metric, labelOfPart(part, label), "", range.better, range.least,
                   range.most, range.digits});
  return out;
}

std::vector<double> poolDistribution(const MetricMaps& maps, const RegionRuns& region,
                                     std::span<const Statistic> wanted) {
  constexpr std::string_view kOver = "fraction_over(";
  DistributionRequest request;
  for (const Statistic& statistic : wanted) {
    const std::string_view part = partOf(statistic);
    if (part.starts_with('p')) request.fractions.push_back(numberIn(part.substr(1)) / 100);
    if (part.starts_with(kOver)) request.thresholds.push_back(numberIn(part.substr(kOver.size())));
  }
  const Distribution found = poolPlane(maps.planes[0], region, request);
  std::vector<double> out;
  std::size_t percentile = 0, share = 0;
  for (const Statistic& statistic : wanted) {
    const std::string_view part = partOf(statistic);
    out.push_back(part.starts_with('p')     ? found.percentiles[percentile++]
                  : part.starts_with(kOver) ? found.shares[share++]
                  : part == "min"           ? found.min
                  : part == "max"           ? found.max
                                            : found.mean);
  }
  return out;
}

base::Image mapOfDisplayed(const MetricInput& input, const MetricOptions& options, float worst,
                           const RowFunction& make) {
  return mapOf(input, options, false, worst, make);
}

base::Image mapOfLinear(const MetricInput& input, const MetricOptions& options, float worst, const RowFunction& make) {
  return mapOf(input, options, true, worst, make);
}

} // namespace parity::compare

#include "history/timing_steps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace parity::history {

namespace {

double medianOf(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

double distance(std::span<const double> values, double center) {
  double sum = 0;
  for (const double value : values) sum += std::abs(value - center);
  return sum;
}

// Whether the cut parts two levels, and not one level and its noise.
bool isStep(std::span<const double> a, std::span<const double> b, double before, double now) {
  if (std::abs(now - before) < kLeastStep * before) return false;
  std::vector<double> residuals;
  for (const double value : a) residuals.push_back(std::abs(value - before));
  for (const double value : b) residuals.push_back(std::abs(value - now));
  constexpr double kSigmaOfMad = 1.4826, kErrorOfMedian = 1.2533, kErrors = 6;
  const double sigma = kSigmaOfMad * medianOf(residuals);
  const double error =
      kErrorOfMedian * sigma * std::sqrt(1 / static_cast<double>(a.size()) + 1 / static_cast<double>(b.size()));
  return std::abs(now - before) >= kErrors * error;
}

void findWithin(std::span<const double> series, std::size_t offset, std::vector<Step>& steps) {
  if (series.size() < 2 * kLeastPoints) return;
  std::size_t best = 0;
  double least = INFINITY;
  for (std::size_t cut = 1; cut < series.size(); ++cut) {
    const auto a = series.first(cut), b = series.subspan(cut);
    if (const double sum = distance(a, medianOf(a)) + distance(b, medianOf(b)); sum < least) least = sum, best = cut;
  }
  const auto a = series.first(best), b = series.subspan(best);
  if (b.size() < kLeastPoints) return findWithin(a, offset, steps); // a level of a few points: too early to say
  if (a.size() < kLeastPoints) return findWithin(b, offset + best, steps);
  const double before = medianOf(a), now = medianOf(b);
  if (!isStep(a, b, before, now)) return;
  findWithin(a, offset, steps);
  steps.push_back({offset + best, before, now});
  findWithin(b, offset + best, steps);
}

} // namespace

std::vector<Step> findSteps(const std::vector<double>& series) {
  std::vector<Step> steps;
  findWithin(series, 0, steps);
  return steps;
}

std::vector<TimingStep> timingSteps(const Database& index, const Where& where, std::size_t most) {
  struct Series {
    std::vector<double> times;
    std::vector<std::int64_t> runs;
  };
  std::map<std::pair<std::string, std::string>, Series> all; // by scene and machine
  Statement times = index.prepare(
      "SELECT timing.run, subject.scene, timing.machine, timing.cpu_ms FROM timing JOIN subject ON "
      "subject.id=timing.scene WHERE stage='scene' AND NOT cached AND cpu_ms IS NOT NULL AND run IN (SELECT id FROM "
      "run "
      "WHERE (?1 IS NULL OR suite=?2) AND (?3 IS NULL OR branch=?4) ORDER BY id DESC LIMIT ?5) ORDER BY timing.run");
  const auto given = [](const std::optional<std::string>& text) {
    return text ? std::optional<std::int64_t>(1) : std::nullopt;
  };
  times.bind(given(where.suite), where.suite.value_or(""), given(where.branch), where.branch.value_or(""), most);
  while (times.step()) {
    Series& series = all[{times.text(1), times.text(2)}];
    series.times.push_back(times.real(3));
    series.runs.push_back(times.integer(0));
  }
  std::vector<TimingStep> steps;
  for (const auto& [key, series] : all)
    if (const std::vector<Step> found = findSteps(series.times); !found.empty()) {
      const Step& last = found.back();
      steps.push_back({key.first, key.second, findRun(index, series.runs[last.at - 1]),
                       findRun(index, series.runs[last.at]), last.before, last.now});
    }
  std::ranges::stable_sort(steps, std::ranges::greater(),
                           [](const TimingStep& step) { return std::abs(std::log(step.nowMs / step.beforeMs)); });
  return steps;
}

} // namespace parity::history

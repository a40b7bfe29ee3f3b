// A benchmark's table, and below it how the times grow with what is counted.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "study/sweep/statistics.h"

namespace parity::bench {

// Also keeps the times by n, for the exponents k of t = c n^k.
class ExponentReporter : public benchmark::ConsoleReporter {
public:
  // pointOf: n and the time of one run.
  explicit ExponentReporter(std::function<std::pair<double, double>(const Run&)> pointOf)
      : m_pointOf(std::move(pointOf)) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    benchmark::ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const auto [n, time] = m_pointOf(run);
      m_times[run.run_name.function_name][n].push_back(time);
    }
  }

  // Through the largest three n of each benchmark that has two at least.
  void printExponents() const {
    for (const auto& [name, points] : m_times) {
      std::vector<double> n, medians;
      for (const auto& [count, times] : points) {
        n.push_back(count);
        medians.push_back(sweep::spreadOf(times).median);
      }
      const auto drop = static_cast<std::ptrdiff_t>(n.size() > 3 ? n.size() - 3 : 0);
      n.erase(n.begin(), n.begin() + drop);
      medians.erase(medians.begin(), medians.begin() + drop);
      if (n.size() > 1) fmt::print("{:<28} n^{:.2f}\n", name, sweep::fitPowerLaw(n, medians).exponent);
    }
  }

private:
  std::function<std::pair<double, double>(const Run&)> m_pointOf;
  std::map<std::string, std::map<double, std::vector<double>>> m_times; // by benchmark and n
};

// All benchmarks of the program, then the exponents.
inline void
runWithExponents(int& count, char** arguments,
                 std::function<std::pair<double, double>(const benchmark::BenchmarkReporter::Run&)> pointOf) {
  benchmark::Initialize(&count, arguments);
  ExponentReporter reporter(std::move(pointOf));
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.printExponents();
}

} // namespace parity::bench

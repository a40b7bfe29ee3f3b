// Wall time by stage, for --timings and run.json.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace parity::base {

// Milliseconds per stage name, in order of first use. Thread-safe; stages may overlap.
class Timings {
public:
  void add(const std::string& stage, double timeMs) {
    std::lock_guard lock(m_mutex);
    for (auto& [name, sum] : m_stages)
      if (name == stage) {
        sum += timeMs;
        return;
      }
    m_stages.emplace_back(stage, timeMs);
  }
  std::vector<std::pair<std::string, double>> stages() const {
    std::lock_guard lock(m_mutex);
    return m_stages;
  }

private:
  mutable std::mutex m_mutex;
  std::vector<std::pair<std::string, double>> m_stages;
};

// Adds its lifetime to a stage. timings may be null.
class Stopwatch {
public:
  Stopwatch(Timings* timings, std::string stage) : m_timings(timings), m_stage(std::move(stage)) {}
  ~Stopwatch() {
    if (m_timings) m_timings->add(m_stage, elapsedMs());
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  double elapsedMs() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - m_start).count();
  }

private:
  Timings* m_timings;
  std::string m_stage;
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

} // namespace parity::base

// Steps in the CPU times of scenes. Times have noise, so this is statistics: it is reported, and is never a verdict.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "history/subject.h"

namespace parity::history {

struct Step {
  std::size_t at = 0;         // place of the first time of the new level
  double before = 0, now = 0; // medians of both sides
};

inline constexpr std::size_t kLeastPoints = 7; // of each side of a step
inline constexpr double kLeastStep = 0.05;     // of the median before

// Steps of a series, oldest first. It is cut where the sum of distances to the medians of both parts is least, and each
// part again. A cut is a step where the medians differ by kLeastStep and by six standard errors of their difference;
// the noise is estimated from the median distance to the medians (1.4826 MAD, Rousseeuw and Croux 1993), the error of a
// median of n points is 1.2533 sigma / sqrt(n).
std::vector<Step> findSteps(const std::vector<double>& series);

struct TimingStep {
  std::string scene, machine;
  RunRef before, now; // the last run of the old level, the first one of the new one
  double beforeMs = 0, nowMs = 0;
};
// Of the newest `most` runs of the suite and branch: of each scene on each kind of processor its last step, the largest
// change first. Times of results that came from the cache do not count.
std::vector<TimingStep> timingSteps(const Database& index, const Where& where, std::size_t most);

} // namespace parity::history

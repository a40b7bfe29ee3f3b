// The supervisor of a plan's workers: it starts them, watches them, and tries again what one of them did not survive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "job/plan/plan.h"

namespace parity::job {

struct SuperviseOptions {
  int jobs = 1;                     // workers at a time
  double timeoutS = 300;            // that a scene may take; a worker that takes longer is killed
  std::size_t memoryBytes = 0;      // that a worker may hold; 0: any
  bool showErrors = true;           // what workers write to stderr is written there
  std::function<int()> stoppedBy;   // the number of the signal that ends all; 0: none yet; empty: none
  std::vector<std::string> command; // that starts a worker
};

struct SuperviseResult {
  std::size_t done = 0;    // units that are there now and were not before
  std::size_t crashed = 0; // of them: units that no worker survived; they are errors of the report
  std::string lastCrash;   // what became of the last one of these
  std::size_t missing = 0; // units that are still to be done
  std::string why;         // of what is missing: a line
  bool otherPlan = false;  // a worker refused the plan (exit 78)
};

// Does these units of the plan, in their order. Each worker gets up to kMostScenes scenes, or 60 s of them, then a new
// one takes its place. A unit whose worker crashes, takes too long or takes too much memory is tried once more by a
// worker of its own; after that it is a unit with an error, with signal, stage and the last lines of stderr. Once
// kMostFailures workers fail in a row, the device is taken for dead and all stops; the failures in that row are kept
// out.
SuperviseResult supervise(const Plan& plan, const std::filesystem::path& folder, const std::vector<std::size_t>& units,
                          const SuperviseOptions& options, const Progress& progress);

inline constexpr int kMostScenes = 16, kMostFailures = 32;

} // namespace parity::job

// What earlier runs showed of each material and whole image: what suggested budgets rest on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "compare/pooling/statistic.h"
#include "report/report.h"

namespace parity::report {

struct ObservedRun {
  std::string source; // the report's file, for messages
  Report report;      // readReport (report/reader.h)
};

// A material of a scene, or its whole images, over all runs.
struct ObservedSubject {
  std::string scene, material;
  bool whole = false;
  // By figure, by run: its worst over the views (budget_limits.h: errorOf); NaN where no row of the run says anything.
  std::vector<std::vector<double>> errors;
  std::set<std::vector<bool>> judgeable; // rows by which figures can be judged: bias.ev is not where it is too dark
  bool isSeen = false, isNotSeen = false, isTooSmall = false; // in some run
  bool isIdentical = true;                                    // no pixel differs in any row
  double clipped = 0, mostlyClipped = 0; // the largest shares of rows that warn of it, and that it keeps from judging
  std::uint64_t nonFinite = 0;           // the most NaN and infinite pixels in a row
  std::set<std::string> notModelled;
};

struct Observation {
  std::vector<ObservedSubject> subjects; // in the order of the runs
  std::vector<std::string> notes;        // what says nothing here, but another run tells of it
  std::vector<std::string> errors;       // what no rule can accept, so that an unchanged run is an error again
  bool isAnyCompared = false;            // some material, in some run
};

// Throws Error (failed) where a figure was not measured or is no number.
Observation observe(const std::vector<ObservedRun>& runs, const std::vector<compare::Statistic>& figures);

} // namespace parity::report

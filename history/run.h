// What history keeps of a run, as plain data: the content of a run file (history/run_file.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/pooling/figures.h"
#include "compare/verdict/check.h"
#include "report/report.h"

namespace parity::history {

// Whether a verdict, by its name, is one of a failure: fail or error.
bool isFailing(const std::string& verdict);

// Pictures of a row by their content (history/pictures.h): 32 hexadecimal digits; empty: not kept.
struct PictureHashes {
  std::string reference, test, flip;
};

// A material of a view, or its whole image.
struct RowRecord {
  std::string name; // empty: the whole image
  compare::Verdict verdict = compare::Verdict::pass;
  std::string reason, rule;
  std::vector<compare::Figure> figures; // by name; four significant digits; empty: not seen
  PictureHashes pictures = {};
};

struct ViewRecord {
  std::string name;
  RowRecord whole;
  std::vector<RowRecord> materials; // in the report's order; namesakes are told apart by their order
};

struct SceneRecord {
  std::string name;
  report::SceneInputs inputs;
  compare::Verdict verdict = compare::Verdict::pass;
  std::string error;     // empty: it was compared
  bool isCached = false; // its result is that of an earlier run
  double wallS = 0;      // that it took; 0: not known
  double cpuS = 0;       // of all threads; 0: not known
  std::string machine;   // processor; empty: the run's
  std::vector<ViewRecord> views;
};

struct RunRecord {
  std::string started;               // ISO 8601, UTC: runs are in this order
  std::string suite, branch, commit; // empty: not known
  std::string commitTime;            // ISO 8601; empty: not known
  std::string version, build, device, driver, numerics, machine, settings, budgets;
  std::string report; // folder of the report, for `parity history baseline`
  compare::Verdict verdict = compare::Verdict::pass;
  bool isComplete = true, isWhole = true; // as report::RunOrigin has them
  std::vector<std::string> incidents;
  std::vector<std::pair<std::string, double>> stages; // ms
  std::vector<SceneRecord> scenes;
};

// Which commit a run is of.
struct CommitInfo {
  std::string branch, commit, commitTime;
};

// report, run: as read back (report/reader.h).
RunRecord makeRecord(const report::Report& report, const report::RunInfo& run, const CommitInfo& commit);

// The nearest number of four significant digits; what is not finite stays as it is.
double roundedFigure(double value);

} // namespace parity::history

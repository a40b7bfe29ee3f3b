// Where the rows of a report stand since an earlier run: which failures are new.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "report/report.h"

namespace parity::report {

// unknown: it fails, and nothing is known of an earlier run. none: it passes as before, or has no verdict of interest.
enum class Standing { none, unknown, isNew, still, fixed, accepted, flaky };
// "new", "still failing", ...
const char* nameOf(Standing standing);

struct RowStanding {
  Standing standing = Standing::none;
  std::size_t nights = 0; // for how many runs it fails, this one included; 0: not known
  std::string owner;      // of its approval, else of its budget; may be empty
};

bool isFailure(compare::Verdict verdict); // fail or error

// By the baseline of the report. material null: the view's whole image. A row that the baseline has under other
// conditions is held to the verdict that it had there.
RowStanding standingOf(const ViewResult& view, const MaterialResult* material);

// What is known of a row: by default standingOf, else by a history (report/earlier_runs.h). material null: the whole
// image.
using FindStanding = std::function<RowStanding(const SceneResult&, const ViewResult&, const MaterialResult*)>;

// How many rows of a report fail for the first time, and again. A failure that is flaky is not new. What budgets
// require and no scene has (Report::lost) counts as new: no report says since when.
struct FailureCounts {
  std::size_t isNew = 0, still = 0;
};
FailureCounts countFailures(const Report& report, const FindStanding& find = {});

class EarlierRuns;

// Why nobody can say which failures of a settled report are new: no earlier run is known, and there is no baseline, it
// could not be used, or it is of a part of the scenes or lacks results; empty: one can. earlier: may be null.
std::string whyNewIsUnknown(const Report& report, const EarlierRuns* earlier = nullptr);

} // namespace parity::report

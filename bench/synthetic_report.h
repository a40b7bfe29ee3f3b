// A report of as many scenes as are asked for, made up without rendering: its rows have what rows of a real report
// have.
#pragma once

#include "report/report.h"

namespace parity::bench {

struct ReportSize {
  int scenes = 10000, views = 3, materials = 5; // views of a scene, materials of a view
};

// The same for the same size. Of the rows about one in ten fails, has its cause measured, and one in five warns.
// Settled.
report::Report makeSyntheticReport(const ReportSize& size);

// Its run, with a command and a time for each view and scene.
report::RunInfo makeSyntheticRun(const ReportSize& size);

} // namespace parity::bench

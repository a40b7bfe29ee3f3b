// The report of a made-up night.
#pragma once

#include "history/synthetic_nights.h"
#include "report/report.h"

namespace parity::tests {

// With the names and verdicts of the record; "lighting" owns all materials.
report::Report reportOf(const history::RunRecord& record);

} // namespace parity::tests

// index.html of a history: the dashboard with the runs, what each brought, and the rows that changed.
#pragma once

#include <cstddef>
#include <string>

#include "history/subject.h"

namespace parity::history {

inline constexpr std::size_t kMostTimedRuns =
    100; // that steps in times are looked for in: `history show --timings`, too

// The data of the page: the JSON of Nights in report/dashboard/src/data/history.ts. The newest `last` runs (0: all) of
// the suite and branch; of each run the 200 gravest changes; the 2,000 rows that changed last.
std::string nightsPageJson(const Database& index, const Where& where, std::size_t last);

// The page, which works without a server. Empty in a build without the dashboard.
std::string toNightsPage(const Database& index, const Where& where, std::size_t last);

} // namespace parity::history

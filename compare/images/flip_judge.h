// What a region's figures are worth by the limits and budgets of a run of parity flip.
#pragma once

#include <vector>

#include "compare/images/flip_run.h"

namespace parity::compare {

// Fills row.checks, rule, verdict and reason from its figures. limits: those of the command line, for this row.
// `scene`: the pair's name, for budgets. Regressions are not judged, as there is no baseline; a row that nothing else
// judges is an error where limits were asked for at all. Throws Error (exit 4) where no rule of the budgets is for it.
void judgeRow(FlipRow& row, const FlipRequest& request, const std::vector<BudgetCheck>& limits,
              const std::string& scene);

// The pair's verdict and reason, from its rows.
void settlePair(FlipPair& pair);

} // namespace parity::compare

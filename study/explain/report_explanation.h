// --explain over-budget: explanations in a report.
#pragma once

#include "job/report_run.h"
#include "study/explain/explanation.h"

namespace parity::explain {

// Explains the materials of a settled report that exceed a limit and so warn or fail, view by view: all but those that
// are not judged by their light (a picture of another engine, NaN) and those of a path without switches. What cannot be
// explained, also because a signal stops the run, says so, and nothing else of the report changes. Pictures go to
// `keep`, or are not made where that is empty.
void explainReport(job::Context& context, const job::ReportRequest& request, const job::RunBudgets& budgets,
                   report::Report& report, const job::KeepPicture& keep, const job::Progress& progress);

// As the report has it.
report::Explanation explanationOf(const MaterialExplanation& material, const std::vector<Switch>& switches);

} // namespace parity::explain

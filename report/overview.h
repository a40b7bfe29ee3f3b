// What the page's list shows, sorts, filters and counts, as columns: index.html holds this of every row, and a scene's
// other details come with its file (report/scene_file.h).
#pragma once

#include "base/text/text_sink.h"
#include "report/report.h"
#include "report/standing.h"

namespace parity::report {

// One line of JSON: {"verdicts", "texts", "lists", "limits", "scenes", "views", "rows"}.
// - verdicts: names; texts: each once; lists: of places in texts; limits: lists of checks of figures (not of
//   regressions) as {"metric", "warn", "fail", "verdict"}. Columns hold places in these.
// - scenes, views, rows: {"count": N, "columns": {NAME: COLUMN}} (report/column.h), in the order of the report; none
//   of no rows. The rows of a view are its materials, then its whole image; "figures" of rows: a column for each
//   figure, by its name.
// A row's pictures are its view's "prefix" and, behind it, the three texts of its list "images"; "": none.
// find: the standing of a row; empty: standingOf (report/standing.h).
void writeOverview(const Report& report, const FindStanding& find, const base::TextSink& sink);

} // namespace parity::report

// The rows of the terminal's table: a block a view, a row a material and one for the whole image.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace parity::report {

// Coloured by the verdict.
std::string paint(compare::Verdict verdict, const std::string& text, bool color);

// "3 pass, 1 warn"; "none".
std::string formatCounts(const VerdictCounts& counts);

// Whether the table shows a row of this verdict: one that failed, warned or could not be judged.
inline bool isShownRow(compare::Verdict verdict, bool all) { return all || verdict >= compare::Verdict::notJudged; }

bool showsStage(const ViewResult& view, const std::string& stage);

// "hi/truth": two letters of the path's name, or as many as tell it from all others.
std::string truthColumn(const std::string& path, const std::vector<std::string>& paths);

// The view's header and rows, and how many materials it does not show; empty where it shows no row. paths: of the
// report. hasBaseline: of the report.
std::string formatView(const SceneResult& scene, const ViewResult& view, const std::vector<std::string>& paths,
                       bool hasBaseline, const TableOptions& options);

} // namespace parity::report

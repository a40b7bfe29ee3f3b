// The report as a table for spreadsheets.
#pragma once

#include <string>

#include "report/report.h"

namespace parity::report {

// RFC 4180, UTF-8: a line for the whole image of each view (kind "whole"), for each material of it ("material"), and
// for each scene that failed ("scene"). Columns: scene, view, environment, reference, test (paths), kind, material,
// verdict, pixels, non_finite, one for each figure that any line has, those of both paths against the truth
// ("reference_to_truth.flip.mean"), cause, reason.
std::string toCsv(const Report& report);

} // namespace parity::report

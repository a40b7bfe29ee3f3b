// What of a report is told in sentences.
#pragma once

#include <string>

#include "report/report.h"

namespace parity::report {

// "gone: material 'Lamp', scene Desk, view front: in the baseline, but not in this run".
std::string describeGone(const GoneRow& row);

// What a path is called in sentences: "high-end"; all others by their names.
std::string titleOf(const std::string& path);

// Which term is the cause: "skySpecular (reflections of the environment): FLIP 0.142 -> 0.031 with the high-end term",
// of the term that lowers the mean the most once it is the reference path's. One that takes less than a tenth of it off
// explains nothing: "no single term explains it". Empty where FLIP is 0.000.
std::string describeCause(const compare::Attribution& attribution, const std::string& reference);

} // namespace parity::report

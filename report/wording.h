// What of a report is told in sentences.
#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace parity::report {

// "gone: material 'Lamp', scene Desk, view front: in the baseline, but not in this run".
std::string describeGone(const GoneRow& row);

// "not run: 3 of 8 scenes (SIGINT interrupted the run): Desk, Lamp, Sofa"; empty where all were.
std::string describeNotRun(const Report& report);

// What a path is called in sentences: "high-end"; all others by their names.
std::string titleOf(const std::string& path);

inline constexpr const char* kNoSingleTerm = "no single term explains it";

// The term that lowers the mean FLIP the most once it is the reference path's. Nothing where none takes a tenth of it
// off.
std::optional<compare::TermEffect> findCause(const compare::Attribution& attribution);

// Which term is the cause: "skySpecular (reflections of the environment): FLIP 0.142 -> 0.031 with the high-end term",
// or "no single term explains it". Empty where FLIP is 0.000.
std::string describeCause(const compare::Attribution& attribution, const std::string& reference);

// The cause by terms and the cause by approximations (--explain) of a material, with what would help, in a line. Empty
// where neither is known.
std::string describeCauses(const MaterialResult& material, const std::string& reference);

} // namespace parity::report

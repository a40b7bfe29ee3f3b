// "To see it again": the command for one row.
#pragma once

#include <string>

#include "report/report.h"

namespace parity::report {

// A line for a POSIX shell that compares this material of this view alone; material null: the whole image. Empty where
// the run does not say how.
std::string againCommand(const RunInfo& run, const SceneResult& scene, const ViewResult& view,
                         const MaterialResult* material);

} // namespace parity::report

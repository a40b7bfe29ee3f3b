// An earlier report read back from its report.json.
#pragma once

#include <filesystem>

#include "report/report.h"

namespace parity::report {

// The file itself, or report.json in the folder.
std::filesystem::path reportFileOf(const std::filesystem::path& fileOrFolder);

inline constexpr int kOldestRead = 3; // what is asked of a report is the same since

// checks: also the metric and the verdict of each check.
enum class ReadDepth { figures, checks };

// What later runs ask of an earlier one: version, device, settings; digests; of each scene name, environment, sun,
// inputs and whether it failed; of each view and material name, verdict, reason, figures, pictures, what no path
// models, and whether its truth is a number; all conditions. All else stays empty, and takes no memory while the file
// is read, scene by scene. May be given the report's folder. An infinite psnr, null in the file, is infinite again; any
// other null is NaN. Throws Error (exit 4) "file: /json/pointer: reason" where it cannot be read, is no JSON, lacks
// something or holds a wrong type, or is of a schema version that is not kOldestRead to kReportSchema.
Report readReport(const std::filesystem::path& fileOrFolder, ReadDepth depth = ReadDepth::figures);

// What history asks of a run.json: when it was, by what it was made, times, crashes. All else stays empty. Throws Error
// (exit 4) as readReport does.
RunInfo readRun(const std::filesystem::path& folder);

} // namespace parity::report

// The folder of a report: what is written there, and what an older report has left.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "compare/report.h"

namespace parity::job {

// What the names of a view's pictures begin with: unique by the places of scene and view in the request, and safe in
// file names whatever they are called.
std::string imagePrefix(std::size_t sceneIndex, const std::string& scene, std::size_t viewIndex,
                        const std::string& view);

// What a report's folder holds besides images/.
inline constexpr std::array<const char*, 4> kReportFiles = {"report.json", "run.json", "junit.xml", "index.html"};

// Makes the folder, and removes what an older report has left in it: a run that dies midway leaves no old verdict
// beside new pictures. Files that no report writes stay. Throws Error (exit 4).
void prepareReportFolder(const std::filesystem::path& folder);

// report.json, run.json, junit.xml and index.html. Throws Error (exit 4).
void writeReport(const std::filesystem::path& folder, const compare::Report& report, const compare::RunInfo& run);

} // namespace parity::job

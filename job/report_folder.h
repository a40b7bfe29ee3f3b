// The folder of a report: what is written there, and what an older report has left.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "job/view/view_pictures.h"
#include "report/page.h"

namespace parity::job {

// What the names of a view's pictures begin with: unique by the places of scene and view in the request, and safe in
// file names whatever they are called.
std::string imagePrefix(std::size_t sceneIndex, const std::string& scene, std::size_t viewIndex,
                        const std::string& view);

// In the names of pictures: of other engines, whatever they are called.
inline constexpr const char *kExternal = "external", *kExternalReference = "external-reference";

// What a report's folder may hold besides images/, pixels/, scenes/, baseline/ and approved/.
inline constexpr std::array<const char*, 7> kReportFiles = {"report.json",  "run.json",      "junit.xml", "index.html",
                                                            "dashboard.js", "dashboard.css", "bench.json"};

// Makes the folder. Throws Error (exit 4), also where it holds a page that no report has written.
void requireReportFolder(const std::filesystem::path& folder);

// The same; and removes what an older report has left in it: a run that dies midway leaves no old verdict
// beside new pictures. Files that no report writes stay. singleFile: images/ and pixels/ are not needed. Throws Error
// (exit 4).
void prepareReportFolder(const std::filesystem::path& folder, bool singleFile);

struct ReportParts {
  const report::Bench& bench;
  bool singleFile = false;                      // index.html holds the bench, the pictures, script and style
  const std::vector<EncodedPicture>& pictures;  // of a single file
  const report::EarlierRuns* earlier = nullptr; // null: no earlier run is known
};

// report.json, run.json, junit.xml and, where the build has the page, index.html with dashboard.js, dashboard.css and
// scenes/; bench.json where there is one. Of a long report it holds pieces at a time, and of its rows the overview
// (report/overview.h). Throws Error (exit 4).
void writeReport(const std::filesystem::path& folder, const report::Report& report, const report::RunInfo& run,
                 const ReportParts& parts);

} // namespace parity::job

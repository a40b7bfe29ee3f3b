#include "job/report_folder.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "base/temporary_name.h"
#include "base/write_pieces.h"
#include "job/baseline_pictures.h"
#include "job/paths.h"
#include "job/scene/material_cards.h"
#include "job/view/display_table.h"
#include "report/dashboard_files.h"
#include "report/scene_file.h"

namespace parity::job {

namespace {

// Letters, digits and '-' stay; the rest becomes '_'. The index in front keeps two alike names apart.
std::string safeFileName(std::size_t index, const std::string& name) {
  std::string out = fmt::format("{}-", index);
  for (const char c : name)
    out += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
  return out.substr(0, 64);
}

bool isOfAView(std::string_view name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits > 0 && name.substr(digits).starts_with('-');
}

// Whether a report could have given this name to a picture: "0-scene_0-view_m3_flip.png", or one of a texture.
bool isPictureOfAReport(std::string_view name) {
  std::vector<std::string> kinds = pathNames();
  kinds.insert(kinds.end(), {"flip", "truth", kExternal, kExternalReference});
  const auto isOfKind = [&](const std::string& kind) { return name.ends_with("_" + kind + ".png"); };
  return isCardPicture(name) || (isOfAView(name) && std::ranges::any_of(kinds, isOfKind));
}

// The same of a pixel file: "0-scene_0-view.js".
bool isPixelFileOfAReport(std::string_view name) {
  return (isOfAView(name) && name.ends_with(".js")) || "pixels/" + std::string(name) == kDisplayTableFile;
}

// The same of a scene's details: "12.js".
bool isSceneFile(std::string_view name) {
  return name.find_first_not_of("0123456789") == name.size() - 3 && name.size() > 3 && name.ends_with(".js");
}

// The same of a picture of an approved state: "9f3c....png", by its content.
bool isApprovedPicture(std::string_view name) {
  constexpr std::size_t kHash = 32; // digits
  return name.find_first_not_of("0123456789abcdef") == kHash && name.substr(kHash) == ".png";
}

bool isReportFile(std::string_view name) { return std::ranges::find(kReportFiles, name) != std::end(kReportFiles); }

// Removes the files that reports have left in a folder, also under the temporary names of a run that was killed.
std::error_code clean(const std::filesystem::path& folder, bool (*isOwn)(std::string_view name)) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error) || error) return error;
  std::vector<std::filesystem::path> own;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (isOwn(base::ownNameOf(name).value_or(name))) own.push_back(entry->path());
  }
  for (const std::filesystem::path& file : own)
    if (!error) std::filesystem::remove(file, error);
  return error;
}

// The same of a folder that is a report's own: it goes, too, unless it holds other files.
std::error_code cleanOwn(const std::filesystem::path& folder, bool (*isOwn)(std::string_view name)) {
  const std::error_code error = clean(folder, isOwn);
  std::error_code isNotEmpty;
  if (!error) std::filesystem::remove(folder, isNotEmpty);
  return error;
}

} // namespace

std::string imagePrefix(std::size_t sceneIndex, const std::string& scene, std::size_t viewIndex,
                        const std::string& view) {
  return safeFileName(sceneIndex, scene) + "_" + safeFileName(viewIndex, view);
}

void requireReportFolder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / "index.html", error) && !std::filesystem::exists(folder / "report.json", error))
    throw base::fileError(folder.string(), "index.html", "was not written by a report; give another folder");
  std::filesystem::create_directories(folder, error);
  if (error) throw base::fileError(folder.string(), "", "cannot be created as a folder: " + error.message());
}

void prepareReportFolder(const std::filesystem::path& folder, bool singleFile) {
  requireReportFolder(folder);
  std::error_code error = clean(folder, isReportFile);
  if (!error) error = cleanOwn(folder / "images", isPictureOfAReport);
  if (!error) error = cleanOwn(folder / "pixels", isPixelFileOfAReport);
  if (!error) error = cleanOwn(folder / "scenes", isSceneFile);
  if (!error) error = cleanOwn(folder / "baseline", isBaselinePicture);
  if (!error) error = cleanOwn(folder / "approved", isApprovedPicture);
  if (error) throw base::fileError(folder.string(), "", "an older report cannot be removed: " + error.message());
  // What is in the way of the pictures is said before anything is rendered.
  if (!singleFile) std::filesystem::create_directories(folder / "images", error);
  if (error) throw base::fileError(folder.string(), "images", "cannot be created as a folder: " + error.message());
}

void writeReport(const std::filesystem::path& folder, const report::Report& report, const report::RunInfo& run,
                 const ReportParts& parts) {
  base::writePieces(folder / "report.json", [&](const base::TextSink& sink) { report::writeJson(report, sink); });
  base::writeText(folder / "run.json", report::toJson(run));
  base::writePieces(folder / "junit.xml", [&](const base::TextSink& sink) { report::writeJunit(report, run, sink); });
  if (!parts.bench.json.empty() && !parts.singleFile) base::writeText(folder / "bench.json", parts.bench.json);
  if (!report::hasDashboard()) return;
  report::PageRequest page{.bench = parts.bench, .singleFile = parts.singleFile, .files = {}, .earlier = parts.earlier};
  if (parts.singleFile)
    for (const EncodedPicture& picture : parts.pictures) page.files.push_back({picture.file, picture.bytes});
  if (!parts.singleFile) {
    base::writeText(folder / "dashboard.js", report::dashboardScript().text);
    base::writeText(folder / "dashboard.css", report::dashboardStyle().text);
    const report::SceneFiles scenes(report, run, parts.earlier);
    base::parallelFor(report.scenes.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        base::writeText(folder / report::SceneFiles::nameOf(i), scenes.script(i));
    });
  }
  base::writePieces(folder / "index.html",
                    [&](const base::TextSink& sink) { report::writeHtml(report, run, page, sink); });
}

} // namespace parity::job

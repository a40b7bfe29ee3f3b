#include "job/report_folder.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"

namespace parity::job {

namespace {

// Letters, digits and '-' stay; the rest becomes '_'. The index in front keeps two alike names apart.
std::string safeFileName(std::size_t index, const std::string& name) {
  std::string out = fmt::format("{}-", index);
  for (const char c : name)
    out += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
  return out.substr(0, 64);
}

// Whether a report could have given this name to a picture: "0-scene_0-view_m3_flip.png".
bool isPictureOfAReport(std::string_view name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits > 0 && name.substr(digits).starts_with('-') &&
         (name.ends_with("_highend.png") || name.ends_with("_mobile.png") || name.ends_with("_flip.png") ||
          name.ends_with("_truth.png"));
}

} // namespace

std::string imagePrefix(std::size_t sceneIndex, const std::string& scene, std::size_t viewIndex,
                        const std::string& view) {
  return safeFileName(sceneIndex, scene) + "_" + safeFileName(viewIndex, view);
}

void prepareReportFolder(const std::filesystem::path& folder) {
  const std::filesystem::path images = folder / "images";
  std::error_code error;
  if (std::filesystem::exists(folder / "index.html", error) && !std::filesystem::exists(folder / "report.json", error))
    throw base::fileError(folder.string(), "index.html", "is not a report's: give another folder");
  std::filesystem::create_directories(images, error);
  if (error) throw base::fileError(folder.string(), "", "cannot be made a folder: " + error.message());

  for (const char* file : kReportFiles)
    if (!error) std::filesystem::remove(folder / file, error);
  std::filesystem::directory_iterator entry(images, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (isPictureOfAReport(entry->path().filename().string())) std::filesystem::remove(entry->path(), error);
  if (error) throw base::fileError(folder.string(), "", "an older report cannot be removed: " + error.message());
}

void writeReport(const std::filesystem::path& folder, const compare::Report& report, const compare::RunInfo& run) {
  const std::array<std::string, kReportFiles.size()> contents = {
      compare::toJson(report), compare::toJson(run), compare::toJunit(report, run), compare::toHtml(report, run)};
  for (std::size_t i = 0; i < kReportFiles.size(); ++i) base::writeText(folder / kReportFiles[i], contents[i]);
}

} // namespace parity::job

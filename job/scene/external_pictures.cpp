#include "job/scene/external_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "external/calibration.h"
#include "external/picture.h"
#include "external/registration.h"
#include "job/view/material_swaps.h"
#include "scenes/names.h"

namespace parity::job {

namespace {

// Pixels of shift that are put right in silence, that warn, and beyond which nothing is compared (half a pixel costs
// FLIP as much as what tells two paths apart); and how alike the edges must be: those of other engines are above 0.9,
// those of another scene below 0.45.
constexpr double kSilent = 0.02, kTold = 0.1, kMost = 0.5, kLeastLikeness = 0.6;

std::string fileName(const std::string& name) {
  std::string file;
  for (const char c : name)
    file += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ? c : '_';
  return file;
}

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw base::Error(base::ExitCode::notComparable, file, "", reason);
}

// Pixels in which any material is seen.
std::vector<char> covered(const ViewFrames& frames) {
  std::vector<char> is(frames.first().frame.color.pixelCount(), 0);
  for (const base::PixelList& list : frames.coverage)
    for (const std::uint32_t pixel : list.pixels) is[pixel] = 1;
  return is;
}

// Light above white is white in a picture, so that its edges are no edges there.
base::Image clipped(base::Image light) {
  for (float& value : light.pixels) value = std::isfinite(value) ? std::clamp(value, 0.f, 1.f) : 0.f;
  return light;
}

// Of the calibration's picture, which must have been made as the suite says.
external::Placement calibratedPlacement(const scenes::ExternalPictures& external) {
  constexpr double kMostTurnDeg = 1; // of the environment
  const std::string& file = external.calibration;
  const external::Calibration calibration = external::calibrate(external::readValues(file), file);
  const external::Placement& placement = calibration.placement;
  if (placement.mirrored || calibration.quarterTurns != 0)
    refuse(file,
           placement.mirrored ? "is mirrored" : fmt::format("is turned by {} degrees", 90 * calibration.quarterTurns));
  const external::CurveFit& curve = calibration.curves.front();
  const char* name = external::kTransferNames[static_cast<std::size_t>(curve.transfer)];
  if (curve.error > external::kMostCurveError)
    refuse(file, fmt::format("its tone curve is none of the known ones (the nearest, {}, is {:.1f} of 255 away)", name,
                             curve.error));
  if (name != external.transfer)
    refuse(file, fmt::format("its tone curve is {}; the transfer of {} is {}", name, external.name, external.transfer));
  if (const auto& turn = calibration.environment; turn && (turn->isMirrored || turn->angleDeg > kMostTurnDeg))
    refuse(file, turn->isMirrored
                     ? std::string("its environment is mirrored")
                     : fmt::format("its environment is turned by {:.1f} degrees ({:+.1f} about the vertical)",
                                   turn->angleDeg, turn->yawDeg));
  return placement;
}

class Reader {
public:
  Reader(const SceneRequest& request, std::size_t view, const ViewFrames& frames, std::vector<std::string>& warnings)
      : m_request(request), m_view(request.views[view].name), m_first(frames.first().frame.color),
        m_covered(covered(frames)), m_warnings(warnings) {}

  base::Image read(const Column& column, const std::string& file) {
    const external::Transfer transfer = *external::findTransfer(column.external->transfer);
    external::Picture picture = external::readPicture(file, m_first.width, m_first.height, transfer);
    requireOpaque(picture, file);
    base::Image light = std::move(picture.light);
    const float gain = std::exp2(-m_request.settings.exposureEv); // a picture is exposed
    if (gain != 1)
      for (float& value : light.pixels) value *= gain;
    keepBackground(light);
    tellClipped(picture, column);
    return register_(std::move(light), column, file);
  }

private:
  void requireOpaque(const external::Picture& picture, const std::string& file) const {
    constexpr float kOpaque = 0.998f;
    if (picture.alpha.empty()) return;
    std::size_t count = 0;
    for (std::size_t i = 0; i < m_covered.size(); ++i) count += m_covered[i] && picture.alpha.pixels[i] < kOpaque;
    if (count > 0)
      refuse(file, fmt::format("{} pixels of materials are transparent (alpha below 1): render over the contract's "
                               "background, without alpha",
                               count));
  }

  // What another engine shows where nothing is must not count.
  void keepBackground(base::Image& light) const {
    for (std::size_t i = 0; i < m_covered.size(); ++i)
      if (!m_covered[i]) std::copy_n(&m_first.pixels[3 * i], 3, &light.pixels[3 * i]);
  }

  void tellClipped(const external::Picture& picture, const Column& column) const {
    constexpr double kNotable = 0.01; // of the pixels of materials
    std::size_t clippedCount = 0, all = 0;
    for (std::size_t i = 0; i < m_covered.size(); ++i)
      if (m_covered[i]) ++all, clippedCount += picture.clipped[i];
    if (static_cast<double>(clippedCount) > kNotable * static_cast<double>(all))
      m_warnings.push_back(
          fmt::format("view '{}': {} of {} pixels of materials are clipped in the picture of {}: their "
                      "light is not known",
                      m_view, clippedCount, all, column.name));
  }

  // Where the picture lies: by the calibration's picture, else by its own edges.
  external::Placement placementOf(const base::Image& light, const Column& column, const std::string& file) const {
    if (!column.external->calibration.empty()) return calibratedPlacement(*column.external);
    const external::Shift shift = external::findShift(edges(light), edges(m_first));
    base::logDetail(fmt::format("{}: its edges lie {:+.3f} pixels to the right, {:+.3f} down; likeness {:.3f}", file,
                                shift.dx, shift.dy, shift.likeness));
    requireLike(shift.likeness, file);
    return {.dx = shift.dx, .dy = shift.dy};
  }

  base::Image edges(const base::Image& light) const {
    base::Image shown = light;
    const float gain = std::exp2(m_request.settings.exposureEv);
    for (float& value : shown.pixels) value *= gain;
    return external::edgesOf(clipped(std::move(shown)));
  }

  void requireLike(double likeness, const std::string& file) const {
    if (likeness < kLeastLikeness)
      refuse(file, fmt::format("does not show the view '{}': its edges are not where those of the scene are (likeness "
                               "{:.2f}, at least {:.1f} is needed); is it of another scene, view or camera?",
                               m_view, likeness, kLeastLikeness));
  }

  base::Image register_(base::Image light, const Column& column, const std::string& file) const {
    constexpr int kLeastSide = 16;
    if (std::min(light.width, light.height) < kLeastSide) return light;
    const bool isCalibrated = !column.external->calibration.empty();
    const external::Placement placement = placementOf(light, column, file);
    const double moved = external::mostMoved(placement, light.width, light.height);
    if (moved > kMost)
      refuse(file,
             fmt::format("lies {:.2f} pixels beside the view '{}' ({:+.2f} to the right, {:+.2f} down{}); at most "
                         "{} pixel is put right: mend the camera",
                         moved, m_view, placement.dx, placement.dy,
                         isCalibrated ? fmt::format(", scale {:.4f}, turned by {:.2f} degrees", placement.scale,
                                                    placement.rotationDeg)
                                      : "",
                         kMost));
    if (moved > kTold)
      m_warnings.push_back(fmt::format("view '{}': the picture of {} lies {:.2f} pixels beside it ({:+.2f} to the "
                                       "right, {:+.2f} down), as {}; that is put right",
                                       m_view, column.name, moved, placement.dx, placement.dy,
                                       isCalibrated ? "the calibration tells" : "its edges tell"));
    if (moved > kSilent) {
      light = external::placedOnView(light, placement);
      keepBackground(light);
    }
    if (isCalibrated) requireLike(external::likenessOf(edges(light), edges(m_first)), file);
    return light;
  }

  const SceneRequest& m_request;
  const std::string& m_view;
  const base::Image& m_first;
  const std::vector<char> m_covered;
  std::vector<std::string>& m_warnings;
};

} // namespace

std::string pictureFileOf(const std::string& pattern, const std::string& scene, const std::string& view) {
  std::string file = pattern;
  std::error_code none;
  if (file.find('{') == std::string::npos && std::filesystem::is_directory(file, none))
    file = (std::filesystem::path(file) / "{scene}-{view}.png").string();
  const auto replace = [&](const std::string& word, const std::string& name) {
    for (std::size_t at = file.find(word); at != std::string::npos; at = file.find(word, at + name.size()))
      file.replace(at, word.size(), name);
  };
  replace("{scene}", fileName(scene));
  replace("{view}", fileName(view));
  return file;
}

void addExternalPictures(const SceneRequest& request, std::size_t view, ViewFrames& frames,
                         std::vector<std::string>& warnings, std::vector<scenes::SourceFile>& sources) {
  Reader reader(request, view, frames, warnings);
  std::vector<PathFrames> pictures;
  for (const Column& column : columnsOf(request)) {
    if (!column.external) continue;
    const std::string file = pictureFileOf(column.file, request.name, request.views[view].name);
    PathFrames& picture = pictures.emplace_back();
    picture.frame.color = reader.read(column, file);
    if (!frames.truth.color.empty())
      for (const base::PixelList& list : frames.coverage)
        picture.truthSwap.push_back(mixByCoverage(list, frames.truth.color, picture.frame.color));
    sources.push_back({file, base::hashOfFile(file)});
    if (const std::string& calibration = column.external->calibration; !calibration.empty())
      sources.push_back({calibration, base::hashOfFile(calibration)});
  }
  std::ranges::move(pictures, std::back_inserter(frames.paths));
}

} // namespace parity::job

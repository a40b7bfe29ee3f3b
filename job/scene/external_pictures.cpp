#include "job/scene/external_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "external/picture.h"
#include "external/registration.h"
#include "job/view/material_swaps.h"

namespace parity::job {

namespace {

// Pixels of shift that are put right in silence, that warn, and beyond which nothing is compared: half a pixel costs
// FLIP as much as what tells two paths apart.
constexpr double kSilent = 0.02, kTold = 0.1, kMost = 0.5;

// How alike the edges must be. Measured at 384 x 384: three.js and Cycles have .58 to .99 (.58: the glass and sheen of
// ToyCar by Cycles), pictures of 10 other scenes at most .32.
constexpr double kLeastLikeness = 0.45;

// Bytes above ASCII are letters of other scripts.
std::string fileName(const std::string& name) {
  std::string file;
  for (const char c : name)
    file +=
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || (c & 0x80) ? c : '_';
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

// And all pixels around them.
std::vector<char> grown(const std::vector<char>& mask, int width, int height, int reach) {
  std::vector<char> wide(mask.size(), 0), out(mask.size(), 0);
  const auto grow = [&](const std::vector<char>& from, std::vector<char>& to, int lines, int length, int step,
                        int next) {
    for (int line = 0; line < lines; ++line)
      for (int last = -1 - reach, i = 0; i < length + reach; ++i) {
        const auto at = [&](int k) { return static_cast<std::size_t>(line * next + k * step); };
        if (i < length && from[at(i)]) last = i;
        const int target = i - reach; // a pixel of the mask lies within `reach` before i, or after the target
        if (target >= 0 && last >= target - reach) to[at(target)] = 1;
      }
  };
  grow(mask, wide, height, width, 1, width);
  grow(wide, out, width, height, width, 1);
  return out;
}

// Light above white is white in a picture, so that its edges are no edges there.
base::Image clipped(base::Image light) {
  for (float& value : light.pixels) value = std::isfinite(value) ? std::clamp(value, 0.f, 1.f) : 0.f;
  return light;
}

// The pictures of one view.
class View {
public:
  View(const SceneRequest& request, std::size_t view, const ViewFrames& frames, Calibrations& calibrations,
       std::vector<std::string>& warnings)
      : m_request(request), m_name(request.views[view].name), m_first(frames.first().frame.color),
        m_covered(covered(frames)), m_calibrations(calibrations), m_warnings(warnings) {
    constexpr int kReach = 8; // beyond what is put right, and what is told
    m_near = grown(m_covered, m_first.width, m_first.height, kReach);
    m_edges = edges(m_first);
  }

  base::Image read(const Column& column, const std::string& file) {
    const external::Encoding encoding = encodingOf(*column.external, m_calibrations);
    external::Picture picture = external::readPicture(file, m_first.width, m_first.height, encoding);
    requireOpaque(picture, file);
    tellClipped(picture, column);
    base::Image light = std::move(picture.light);
    const float gain = std::exp2(-m_request.settings.exposureEv); // a picture is exposed
    if (gain != 1)
      for (float& value : light.pixels) value *= gain;
    light = placed(std::move(light), column, file);
    keepBackground(light);
    return light;
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
                      m_name, clippedCount, all, column.name));
  }

  // Near the materials. Far from them the engine's own background may be anything.
  base::Image edges(const base::Image& light) const {
    base::Image shown = light;
    const float gain = std::exp2(m_request.settings.exposureEv);
    for (float& value : shown.pixels) value *= gain;
    base::Image edges = external::edgesOf(clipped(std::move(shown)));
    for (std::size_t i = 0; i < m_near.size(); ++i)
      if (!m_near[i]) edges.pixels[i] = 0;
    return edges;
  }

  bool hasEdges() const {
    constexpr int kLeastSide = 16;      // of what can be registered
    constexpr float kLeastEdge = 0.02f; // of the logarithm of luminance, a pixel
    return std::min(m_first.width, m_first.height) >= kLeastSide &&
           std::ranges::any_of(m_edges.pixels, [](float edge) { return edge > kLeastEdge; });
  }

  external::Shift findShift(const base::Image& light, const std::string& file) const {
    const external::Shift shift = external::findShift(edges(light), m_edges);
    base::logDetail(fmt::format("{}: its edges lie {:+.3f} pixels to the right, {:+.3f} down; likeness {:.3f}", file,
                                shift.dx, shift.dy, shift.likeness));
    if (shift.likeness < kLeastLikeness)
      refuse(file, fmt::format("does not show the view '{}': its edges are not where those of the scene are (likeness "
                               "{:.2f}, at least {} is needed); is it of another scene, view or camera?",
                               m_name, shift.likeness, kLeastLikeness));
    return shift;
  }

  // The picture as it lies on the view: by the calibration's picture where there is one, else by its own edges.
  base::Image placed(base::Image light, const Column& column, const std::string& file) const {
    if (!column.external->calibration.empty()) {
      light = putRight(std::move(light), m_calibrations.of(*column.external).placement, column, file, true);
      if (hasEdges()) requireInPlace(findShift(light, file), column, file);
      return light;
    }
    if (!hasEdges()) {
      base::logDetail(fmt::format("{}: the view '{}' has no edges: where the picture lies is not known", file, m_name));
      return light;
    }
    const external::Shift shift = findShift(light, file);
    return putRight(std::move(light), {.dx = shift.dx, .dy = shift.dy}, column, file, false);
  }

  base::Image putRight(base::Image light, const external::Placement& placement, const Column& column,
                       const std::string& file, bool isCalibrated) const {
    const double moved = external::mostMoved(placement, light.width, light.height);
    if (moved > kMost)
      refuse(file,
             fmt::format("lies {:.2f} pixels beside the view '{}' ({:+.2f} to the right, {:+.2f} down{}); at most "
                         "{} pixel is put right: mend the camera",
                         moved, m_name, placement.dx, placement.dy,
                         isCalibrated ? fmt::format(", scale {:.4f}, turned by {:.2f} degrees", placement.scale,
                                                    placement.rotationDeg)
                                      : "",
                         kMost));
    if (moved > kTold)
      m_warnings.push_back(fmt::format("view '{}': the picture of {} lies {:.2f} pixels beside it ({:+.2f} to the "
                                       "right, {:+.2f} down), as {}; that is put right",
                                       m_name, column.name, moved, placement.dx, placement.dy,
                                       isCalibrated ? "the calibration tells" : "its edges tell"));
    return moved > kSilent ? external::placedOnView(light, placement) : light;
  }

  // After the calibration's placement: a view of another size may have a fault of its own.
  void requireInPlace(const external::Shift& shift, const Column& column, const std::string& file) const {
    const double moved = std::hypot(shift.dx, shift.dy);
    const std::string where = fmt::format("{:.2f} pixels beside the view '{}' ({:+.2f} to the right, {:+.2f} down), "
                                          "although the calibration's place is put right",
                                          moved, m_name, shift.dx, shift.dy);
    if (moved > kMost) refuse(file, fmt::format("lies {}: mend the camera of this view", where));
    if (moved > kTold) m_warnings.push_back(fmt::format("the picture of {} lies {}", column.name, where));
  }

  const SceneRequest& m_request;
  const std::string& m_name;
  const base::Image& m_first;
  const std::vector<char> m_covered;
  std::vector<char> m_near;
  base::Image m_edges; // of the first path's picture
  Calibrations& m_calibrations;
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

std::vector<std::string> externalFilesOf(const SceneRequest& request) {
  std::vector<std::string> files;
  for (const Column& column : columnsOf(request)) {
    if (!column.external) continue;
    for (const scenes::ViewRequest& view : request.views)
      files.push_back(pictureFileOf(column.file, request.name, view.name));
    if (!column.external->calibration.empty()) files.push_back(column.external->calibration);
  }
  return files;
}

void ExternalPictureReader::addTo(ViewFrames& frames, std::size_t view) {
  if (m_request.externals.empty()) return;
  View reader(m_request, view, frames, m_calibrations, m_warnings);
  std::vector<PathFrames> pictures;
  for (const Column& column : columnsOf(m_request)) {
    if (!column.external) continue;
    const std::string file = pictureFileOf(column.file, m_request.name, m_request.views[view].name);
    PathFrames& picture = pictures.emplace_back();
    try {
      picture.frame.color = reader.read(column, file);
      if (!frames.truth.color.empty())
        for (const base::PixelList& list : frames.coverage)
          picture.truthSwap.push_back(mixByCoverage(list, frames.truth.color, picture.frame.color));
      addSource(file);
      if (!column.external->calibration.empty()) addSource(column.external->calibration);
    } catch (const base::Error& error) {
      picture = {};
      const std::string text = error.what();
      if (!m_problem)
        m_problem = error;
      else if (text != m_problem->what() && std::ranges::find(m_warnings, text) == m_warnings.end())
        m_warnings.push_back(text);
    }
  }
  std::ranges::move(pictures, std::back_inserter(frames.paths));
}

void ExternalPictureReader::addSource(const std::string& file) {
  const auto isSame = [&](const scenes::SourceFile& source) { return source.file == file; };
  if (std::ranges::none_of(m_sources, isSame)) m_sources.push_back({file, base::hashOfFile(file)});
}

std::vector<std::string> ExternalPictureReader::warnings() const {
  std::vector<std::string> all = m_calibrations.warnings();
  all.insert(all.end(), m_warnings.begin(), m_warnings.end());
  return all;
}

} // namespace parity::job

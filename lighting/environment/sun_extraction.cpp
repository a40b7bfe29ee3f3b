// Bright compact sources: found as connected cells above a level, filled from their rim.
#include "lighting/environment/sun_extraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/parallel.h"
#include "lighting/environment/panorama.h"
#include "scenes/environment.h"
#include "scenes/luminance.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;
constexpr double kLevelOverMean = 10; // on three real maps: above what glare leaves 3 degrees from a sun
constexpr double kPeakOverLevel = 8;
constexpr double kMaxRadius = 3 * pi / 180;
constexpr double kLeastShare = 0.02; // of the map's flux: st_peters_square_night has 5 above, 15 above half of it

using scenes::luminanceOf;

// The panorama's cells: where they are and what they hold.
class Cells {
public:
  explicit Cells(const base::Image& image) : m_image(image), m_luminance(image.pixelCount()) {
    const int w = width(), h = height();
    for (int x = 0; x < w; ++x) {
      const double azimuth = ((x + 0.5) / w - 0.5) * 2 * pi;
      m_columns.emplace_back(std::cos(azimuth), std::sin(azimuth));
    }
    for (int y = 0; y < h; ++y) {
      const double polar = (y + 0.5) / h * pi;
      m_rows.emplace_back(std::sin(polar), std::cos(polar));
      m_solidAngles.push_back(2 * pi / w * (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h)));
    }
    std::vector<double> rowSums(h);
    base::parallelFor(h, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * w; i < end * w; ++i) {
        m_luminance[i] = static_cast<float>(luminanceOf(radiance(i)));
        rowSums[i / w] += m_luminance[i];
      }
    });
    for (int y = 0; y < h; ++y) m_flux += rowSums[y] * m_solidAngles[y];
  }

  int width() const { return m_image.width; }
  int height() const { return m_image.height; }
  std::size_t count() const { return m_luminance.size(); }
  glm::dvec3 radiance(std::size_t i) const {
    const float* p = m_image.pixels.data() + 3 * i;
    return glm::dvec3(glm::min(glm::vec3(p[0], p[1], p[2]), scenes::kMaxRadiance));
  }
  double luminance(std::size_t i) const { return m_luminance[i]; }
  double solidAngle(std::size_t i) const { return m_solidAngles[i / width()]; }
  double flux() const { return m_flux; } // the sum of luminance times solid angle
  double mean() const { return m_flux / (4 * pi); }
  // In the panorama's own frame, unit length.
  glm::dvec3 direction(std::size_t i) const {
    const glm::dvec2 column = m_columns[i % width()], row = m_rows[i / width()];
    return {row.x * column.x, row.y, row.x * column.y};
  }
  // Calls visit for those that share an edge or a corner, around the seam too, and for the one opposite across a pole.
  template <typename Visit> void forEachNeighbour(std::size_t i, const Visit& visit) const {
    const int w = width(), x = static_cast<int>(i) % w, y = static_cast<int>(i) / w;
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height() - 1); ++ny)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || ny != y) visit(static_cast<std::size_t>(ny) * w + (x + dx + w) % w);
    if (y == 0 || y == height() - 1) visit(static_cast<std::size_t>(y) * w + (x + w / 2) % w);
  }

private:
  const base::Image& m_image;
  std::vector<float> m_luminance;
  std::vector<glm::dvec2> m_columns, m_rows; // cos and sin of the azimuth; sin and cos of the polar angle
  std::vector<double> m_solidAngles;         // by row
  double m_flux = 0;
};

enum : std::uint8_t { kFree, kSeen, kTaken }; // of a cell: not looked at, part of what was refused, part of a source

// The cells above `level` that hang together with `peak`; cut short where they reach twice too far.
std::vector<std::size_t> growRegion(const Cells& cells, std::size_t peak, double level,
                                    const std::vector<std::uint8_t>& states, std::vector<std::uint8_t>& inRegion) {
  const glm::dvec3 center = cells.direction(peak);
  const double farthest = std::cos(2 * kMaxRadius);
  std::vector<std::size_t> region = {peak};
  inRegion[peak] = 1;
  bool isTooFar = false;
  for (std::size_t k = 0; k < region.size() && !isTooFar; ++k) {
    isTooFar = glm::dot(cells.direction(region[k]), center) < farthest;
    cells.forEachNeighbour(region[k], [&](std::size_t n) {
      if (inRegion[n] || states[n] == kTaken || !(cells.luminance(n) > level)) return;
      inRegion[n] = 1;
      region.push_back(n);
    });
  }
  for (const std::size_t i : region) inRegion[i] = 0;
  return region;
}

bool isCompact(const Cells& cells, const std::vector<std::size_t>& region) {
  glm::dvec3 sum(0);
  for (const std::size_t i : region) sum += cells.luminance(i) * cells.solidAngle(i) * cells.direction(i);
  const glm::dvec3 center = glm::normalize(sum);
  return std::all_of(region.begin(), region.end(),
                     [&](std::size_t i) { return glm::dot(cells.direction(i), center) >= std::cos(kMaxRadius); });
}

// A source with what stays in the map in its place.
struct Source {
  std::vector<ExtractedSun::Cell> cells;
  glm::dvec3 illuminance{0.0}, direction{0.0}; // towards it, not normalised
  double luminance() const { return luminanceOf(illuminance); }
};

// Inverse-distance interpolation (Shepard 1968) of the rim: smooth, and never beyond what is there.
Source takeOut(const Cells& cells, std::vector<std::size_t> region, double level, std::vector<std::uint8_t>& states) {
  for (const std::size_t i : region) states[i] = kTaken;
  // Adds what is next to cells [0, count) of the list, once each.
  const auto addNeighbours = [&](std::vector<std::size_t>& list, std::size_t count, std::vector<std::size_t>& to) {
    for (std::size_t k = 0; k < count; ++k)
      cells.forEachNeighbour(list[k], [&](std::size_t n) {
        if (states[n] == kTaken || cells.luminance(n) > level) return;
        states[n] = kTaken;
        to.push_back(n);
      });
  };
  std::vector<std::size_t> edge, rim;
  addNeighbours(region, region.size(), edge);
  region.insert(region.end(), edge.begin(), edge.end());
  addNeighbours(edge, edge.size(), rim);
  for (const std::size_t i : rim) states[i] = kFree;

  Source source;
  for (const std::size_t i : region) {
    const glm::dvec3 before = cells.radiance(i), direction = cells.direction(i);
    glm::dvec3 sum(0);
    double weights = 0;
    for (const std::size_t r : rim) {
      const glm::dvec3 between = cells.direction(r) - direction;
      const double weight = cells.solidAngle(r) / glm::dot(between, between);
      sum += weight * cells.radiance(r);
      weights += weight;
    }
    const glm::vec3 remainder(weights > 0 ? glm::min(sum / weights, before) : before);
    const glm::dvec3 taken = cells.solidAngle(i) * (before - glm::dvec3(remainder));
    source.illuminance += taken;
    source.direction += luminanceOf(taken) * direction;
    source.cells.push_back({static_cast<std::uint32_t>(i), glm::vec3(before), remainder});
  }
  return source;
}

std::vector<Source> findSources(const Cells& cells) {
  const double lowest = kLevelOverMean * cells.mean();
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < cells.count(); ++i)
    if (cells.luminance(i) > kPeakOverLevel * lowest) peaks.push_back(i);
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&](std::size_t a, std::size_t b) { return cells.luminance(a) > cells.luminance(b); });
  std::vector<Source> sources;
  std::vector<std::uint8_t> states(peaks.empty() ? 0 : cells.count(), kFree), inRegion(states);
  for (const std::size_t peak : peaks) {
    if (states[peak] != kFree) continue;
    std::vector<std::size_t> region;
    double level = lowest;
    for (; kPeakOverLevel * level <= cells.luminance(peak); level *= 2) {
      region = growRegion(cells, peak, level, states, inRegion);
      if (isCompact(cells, region)) break;
    }
    if (kPeakOverLevel * level > cells.luminance(peak)) {
      for (const std::size_t i : region) states[i] = kSeen;
      continue;
    }
    Source source = takeOut(cells, std::move(region), level, states);
    if (source.luminance() >= kLeastShare * cells.flux()) sources.push_back(std::move(source));
  }
  std::stable_sort(sources.begin(), sources.end(),
                   [](const Source& a, const Source& b) { return a.luminance() > b.luminance(); });
  if (sources.size() > kMaxExtractedSuns) sources.resize(kMaxExtractedSuns);
  return sources;
}

void setRadiance(base::Image& image, std::uint32_t index, const glm::vec3& radiance) {
  for (int c = 0; c < 3; ++c) image.pixels[3 * std::size_t{index} + c] = radiance[c];
}

} // namespace

SunExtraction extractSuns(scenes::Environment environment) {
  SunExtraction extraction{.environment = std::move(environment), .suns = {}};
  base::Image& image = extraction.environment.radiance;
  const auto isRadiance = [](float value) { return value >= 0 && std::isfinite(value); };
  if (image.empty() || image.channels != 3 || !std::all_of(image.pixels.begin(), image.pixels.end(), isRadiance))
    return extraction; // refused where it is resampled
  std::vector<Source> sources = findSources(Cells(image));
  const double rotation = panoramaAzimuth(0, extraction.environment.rotationDeg);
  for (Source& source : sources) {
    const double polar = std::acos(std::clamp(glm::normalize(source.direction).y, -1.0, 1.0));
    const double azimuth = std::atan2(source.direction.z, source.direction.x) - rotation;
    ExtractedSun sun;
    sun.light.name = "sun " + std::to_string(extraction.suns.size() + 1) + " of " + extraction.environment.name;
    sun.light.kind = scenes::LightKind::directional;
    sun.light.color = glm::vec3(source.illuminance);
    sun.light.direction =
        -glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
    sun.cells = std::move(source.cells);
    for (const ExtractedSun::Cell& cell : sun.cells) setRadiance(image, cell.index, cell.remainder);
    extraction.suns.push_back(std::move(sun));
  }
  return extraction;
}

scenes::Environment putBackSuns(const SunExtraction& extraction, std::optional<std::size_t> without) {
  scenes::Environment environment = extraction.environment;
  for (std::size_t i = 0; i < extraction.suns.size(); ++i)
    if (i != without)
      for (const ExtractedSun::Cell& cell : extraction.suns[i].cells)
        setRadiance(environment.radiance, cell.index, cell.radiance);
  return environment;
}

} // namespace parity::lighting

#include "external/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "base/error.h"
#include "external/angles.h"
#include "external/calibration_scene.h"
#include "external/rotation_fit.h"

namespace parity::external {

namespace {

double luma(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// A bright patch of the picture.
struct Blob {
  glm::dvec2 at{0.0}; // pixels from the picture's middle, y down
  glm::dvec3 color{0.0};
  double area = 0;
  int width = 0, height = 0;
};

// Connected pixels that are brighter than a threshold in some channel. Their places are weighted by how bright they
// are.
std::vector<Blob> findBlobs(const base::Image& values) {
  constexpr float kThreshold = 0.25f;
  const int width = values.width, height = values.height;
  const auto strength = [&](std::size_t pixel) {
    const float* c = &values.pixels[3 * pixel];
    return std::max({c[0], c[1], c[2]});
  };
  std::vector<char> seen(values.pixelCount(), 0);
  std::vector<Blob> blobs;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start] || strength(start) < kThreshold) continue;
    Blob blob;
    double weights = 0;
    int left = width, right = -1, top = height, bottom = -1;
    std::vector<std::size_t> open = {start};
    seen[start] = 1;
    while (!open.empty()) {
      const std::size_t pixel = open.back();
      open.pop_back();
      const int x = static_cast<int>(pixel % static_cast<std::size_t>(width)),
                y = static_cast<int>(pixel / static_cast<std::size_t>(width));
      const double weight = strength(pixel);
      weights += weight, blob.area += 1;
      blob.at += weight * glm::dvec2(x - 0.5 * (width - 1), y - 0.5 * (height - 1));
      for (int c = 0; c < 3; ++c) blob.color[c] += values.pixels[3 * pixel + static_cast<std::size_t>(c)];
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
        const std::size_t next =
            static_cast<std::size_t>(ny) * static_cast<std::size_t>(width) + static_cast<std::size_t>(nx);
        if (seen[next] || strength(next) < kThreshold) continue;
        seen[next] = 1;
        open.push_back(next);
      }
    }
    blob.at /= weights;
    blob.color /= blob.area;
    blob.width = right - left + 1, blob.height = bottom - top + 1;
    blobs.push_back(blob);
  }
  return blobs;
}

// The place of the picture's units in pixels from its middle, y down.
glm::dvec2 pixelOf(const glm::dvec2& at, int size) { return glm::dvec2(at.x, -at.y) * (0.5 * size); }

glm::dvec2 turned(glm::dvec2 p, int quarters, bool mirrored) {
  if (mirrored) p.x = -p.x;
  for (int i = 0; i < quarters; ++i) p = {-p.y, p.x};
  return p;
}

bool isColored(const glm::dvec3& found, const glm::dvec3& wanted) {
  const double most = std::max({found.x, found.y, found.z, 1e-6});
  for (int c = 0; c < 3; ++c)
    if ((found[c] / most > 0.6) != (wanted[c] > 0.5)) return false;
  return true;
}

struct Match {
  std::vector<std::pair<glm::dvec2, glm::dvec2>> pairs; // where a mark should be, and is: pixels, y down
  int quarters = 0;
  bool mirrored = false;
};

// The turn in which most marks lie where a blob of their colour and size is.
Match matchMarks(const std::vector<Blob>& blobs, int size) {
  constexpr double kNear = 0.06; // of the size
  const double area = kPi * std::pow(kMarkRadius * 0.5 * size, 2);
  Match best;
  for (int quarters = 0; quarters < 4; ++quarters)
    for (const bool mirrored : {false, true}) {
      Match match{{}, quarters, mirrored};
      for (const Mark& mark : marks()) {
        const glm::dvec2 place = pixelOf(turned(mark.at, quarters, mirrored), size);
        for (const Blob& blob : blobs)
          if (glm::distance(blob.at, place) < kNear * size && blob.area > 0.5 * area && blob.area < 2 * area &&
              isColored(blob.color, mark.color))
            match.pairs.emplace_back(pixelOf(mark.at, size), blob.at);
      }
      if (match.pairs.size() > best.pairs.size()) best = match;
    }
  return best;
}

// The similarity that takes the places to where they are, by least squares.
void fitPlacement(const Match& match, Calibration& calibration) {
  glm::dvec2 from(0), to(0);
  const auto n = static_cast<double>(match.pairs.size());
  const auto seen = [&](glm::dvec2 p) {
    p.y = -p.y; // the turn is of the picture's units
    p = turned(p, match.quarters, match.mirrored);
    return glm::dvec2(p.x, -p.y);
  };
  for (const auto& [place, found] : match.pairs) from += seen(place) / n, to += found / n;
  double dot = 0, cross = 0, square = 0;
  for (const auto& [place, found] : match.pairs) {
    const glm::dvec2 a = seen(place) - from, b = found - to;
    dot += glm::dot(a, b), cross += a.x * b.y - a.y * b.x, square += glm::dot(a, a);
  }
  Placement& placement = calibration.placement;
  placement.scale = std::hypot(dot, cross) / square;
  const double angle = std::atan2(cross, dot), c = std::cos(angle) * placement.scale,
               s = std::sin(angle) * placement.scale;
  placement.rotationDeg = angle / kDegree;
  const glm::dvec2 shift = to - glm::dvec2(c * from.x - s * from.y, s * from.x + c * from.y);
  placement.dx = shift.x, placement.dy = shift.y;
  placement.mirrored = match.mirrored;
  calibration.quarterTurns = match.quarters;
  double error = 0;
  for (const auto& [place, found] : match.pairs) {
    const glm::dvec2 a = seen(place), b(c * a.x - s * a.y + shift.x, s * a.x + c * a.y + shift.y);
    error += glm::dot(b - found, b - found) / n;
  }
  calibration.residual = std::sqrt(error);
}

// The picture's value at a place of the scene's picture, the nearest pixel.
class Places {
public:
  Places(const base::Image& values, const Placement& placement) : m_values(values) {
    const double angle = placement.rotationDeg * kDegree;
    m_c = std::cos(angle) * placement.scale, m_s = std::sin(angle) * placement.scale;
    m_shift = {placement.dx, placement.dy};
  }
  // Pixels from the middle, y down.
  glm::dvec2 inPicture(const glm::dvec2& p) const {
    return glm::dvec2(m_c * p.x - m_s * p.y, m_s * p.x + m_c * p.y) + m_shift;
  }
  glm::dvec2 onView(const glm::dvec2& p) const {
    const glm::dvec2 q = (p - m_shift) / (m_c * m_c + m_s * m_s);
    return {m_c * q.x + m_s * q.y, -m_s * q.x + m_c * q.y};
  }
  const float* at(const glm::dvec2& p) const {
    const glm::dvec2 q = inPicture(p) + 0.5 * glm::dvec2(m_values.width - 1, m_values.height - 1);
    return m_values.at(std::clamp(static_cast<int>(std::lround(q.x)), 0, m_values.width - 1),
                       std::clamp(static_cast<int>(std::lround(q.y)), 0, m_values.height - 1));
  }

private:
  const base::Image& m_values;
  double m_c = 1, m_s = 0;
  glm::dvec2 m_shift{0.0};
};

std::vector<CurveFit> fitCurves(const base::Image& values, const Places& places) {
  std::array<glm::dvec3, kRampSteps> seen{};
  for (std::size_t step = 0; step < kRampSteps; ++step) {
    constexpr int kSamples = 8; // each way, of the middle half of a patch
    for (int j = 0; j < kSamples; ++j)
      for (int i = 0; i < kSamples; ++i) {
        const glm::dvec2 offset = (glm::dvec2(i, j) + 0.5) / static_cast<double>(kSamples) - 0.5;
        const float* value =
            places.at(pixelOf(rampPlace(step) + offset * glm::dvec2(kRampHalf, kRampHalfHeight), values.width));
        seen[step] += glm::dvec3(value[0], value[1], value[2]) / static_cast<double>(kSamples * kSamples);
      }
  }
  std::vector<CurveFit> fits;
  for (const char* name : kTransferNames) {
    CurveFit& fit = fits.emplace_back();
    fit.transfer = *findTransfer(name);
    for (std::size_t step = 0; step < kRampSteps; ++step) {
      const double grey = rampValue(step);
      const Rgb value = encode(fit.transfer, {grey, grey, grey});
      for (int c = 0; c < 3; ++c) fit.error += std::pow(255 * (value[static_cast<std::size_t>(c)] - seen[step][c]), 2);
    }
    fit.error = std::sqrt(fit.error / (3 * kRampSteps));
  }
  std::ranges::stable_sort(fits, {}, &CurveFit::error);
  return fits;
}

// How an edge rises from a tenth to nine tenths; a box of one pixel does so within 0.8 pixels.
double filterWidthOf(const base::Image& light, const Places& places) {
  const double half = 0.5 * light.width, angle = kBarAngleDeg * kDegree;
  const glm::dvec2 along(std::cos(angle), -std::sin(angle)), up(-std::sin(angle), -std::cos(angle)); // y down
  const glm::dvec2 middle = pixelOf({0, kBarAt}, light.width) + up * (kBarHalfHeight * half);
  constexpr double kReach = 4, kBin = 0.1; // pixels
  constexpr int kBins = static_cast<int>(2 * kReach / kBin);
  std::array<double, kBins> sum{}, count{};
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      const glm::dvec2 p =
          places.onView(glm::dvec2(x, y) - 0.5 * glm::dvec2(light.width - 1, light.height - 1)) - middle;
      const double distance = glm::dot(p, -up); // above 0: within the bar
      if (std::abs(glm::dot(p, along)) > 0.8 * kBarHalf * half || std::abs(distance) >= kReach) continue;
      const auto bin = static_cast<std::size_t>((distance + kReach) / kBin);
      sum[bin] += luma(light.at(x, y)), count[bin] += 1;
    }
  const auto crossing = [&](double level) {
    double last = 0;
    for (std::size_t i = 0; i < kBins; ++i) {
      if (count[i] == 0) continue;
      const double value = sum[i] / count[i];
      if (value >= level) {
        const double share = value > last ? (level - last) / (value - last) : 1;
        return (static_cast<double>(i) - 0.5 + share - 0.5) * kBin;
      }
      last = value;
    }
    return kBins * kBin;
  };
  const double width = (crossing(0.9) - crossing(0.1)) / 0.8;
  return width < 2 * kBin ? 0 : width;
}

// The direction that a pixel of the mirror shows; nothing beside the ball.
std::optional<glm::dvec3> mirrored(const glm::dvec2& p, int size) {
  const double extent = std::tan(0.5 * kCameraFovDeg * kDegree) / (0.5 * size);
  const glm::dvec3 eye(0, 0, kCameraDistance), ray = glm::normalize(glm::dvec3(p.x * extent, -p.y * extent, -1));
  const double b = glm::dot(eye, ray), c = glm::dot(eye, eye) - kBallRadius * kBallRadius, d = b * b - c;
  if (d <= 0) return std::nullopt;
  const glm::dvec3 normal = (eye + ray * (-b - std::sqrt(d))) / kBallRadius;
  return glm::reflect(ray, normal);
}

std::optional<Calibration::Turn> findTurn(const base::Image& light, const Places& places) {
  const int size = light.width;
  std::array<glm::dvec3, 6> sums{};
  std::array<double, 6> counts{};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec2 p = places.onView(glm::dvec2(x, y) - 0.5 * (size - 1));
      const auto direction = mirrored(p, size);
      if (!direction) continue;
      const auto right = mirrored(p + glm::dvec2(1, 0), size), below = mirrored(p + glm::dvec2(0, 1), size);
      if (!right || !below) continue;
      const double solid = glm::length(glm::cross(*right - *direction, *below - *direction));
      if (solid > 0.02) continue; // the rim, which shows too much at once
      const float* c = light.at(x, y);
      for (std::size_t k = 0; k < spots().size(); ++k) {
        double on = 1e9, off = 0;
        for (int i = 0; i < 3; ++i)
          (spots()[k].color[i] > 0.5 ? on = std::min<double>(on, c[i]) : off = std::max<double>(off, c[i]));
        const double weight = std::min(on - off, 1.0);
        if (weight < 0.1) continue;
        sums[k] += weight * solid * *direction, counts[k] += weight;
      }
    }
  constexpr double kLeastPixels = 20;
  std::vector<glm::dvec3> wanted, found;
  for (std::size_t k = 0; k < spots().size(); ++k)
    if (counts[k] >= kLeastPixels) wanted.push_back(spots()[k].direction), found.push_back(glm::normalize(sums[k]));
  if (found.size() < 3) return std::nullopt;
  Calibration::Turn best;
  double least = 1e9;
  for (const bool isMirrored : {false, true}) {
    std::vector<glm::dvec3> from = wanted;
    if (isMirrored)
      for (glm::dvec3& each : from) each.x = -each.x;
    const RotationFit fit = fitRotation(from, found);
    if (fit.errorDeg >= least) continue;
    least = fit.errorDeg;
    // As Environment::rotationDeg has it: about +Y, from +Z towards +X.
    const double yaw = std::atan2(-fit.rotation[0].z, fit.rotation[0].x) / kDegree;
    best = {isMirrored, yaw, fit.angleDeg, fit.errorDeg, static_cast<int>(found.size())};
  }
  return best;
}

} // namespace

Calibration calibrate(const base::Image& values, const std::filesystem::path& file) {
  constexpr std::size_t kLeastMarks = 6;
  const auto refuse = [&](const std::string& reason) {
    throw base::Error(base::ExitCode::notComparable, file.string(), "", reason);
  };
  if (values.width != values.height)
    refuse(fmt::format("is {} x {} pixels; the calibration's picture is square", values.width, values.height));
  const Match match = matchMarks(findBlobs(values), values.width);
  if (match.pairs.size() < kLeastMarks)
    refuse(fmt::format("does not show the calibration scene: {} of its {} marks are found", match.pairs.size(),
                       marks().size()));
  Calibration calibration;
  fitPlacement(match, calibration);
  if (match.mirrored || match.quarters != 0) return calibration; // the rest is read where nothing is turned
  const Places places(values, calibration.placement);
  calibration.curves = fitCurves(values, places);
  base::Image light = values;
  for (std::size_t i = 0; i < light.pixelCount(); ++i) {
    float* c = &light.pixels[3 * i];
    const Rgb decoded = decode(calibration.curves.front().transfer, {c[0], c[1], c[2]});
    for (std::size_t k = 0; k < 3; ++k) c[k] = static_cast<float>(std::min(decoded[k], 2.0));
  }
  calibration.filterWidth = filterWidthOf(light, places);
  calibration.environment = findTurn(light, places);
  return calibration;
}

std::vector<std::string> describe(const Calibration& calibration) {
  std::vector<std::string> lines;
  const Placement& p = calibration.placement;
  lines.push_back(fmt::format("place        {:+.3f} pixels to the right, {:+.3f} down; scale {:.5f}; turned by {:+.3f} "
                              "degrees (marks within {:.3f} pixels)",
                              p.dx, p.dy, p.scale, p.rotationDeg, calibration.residual));
  if (p.mirrored || calibration.quarterTurns != 0) {
    lines.push_back(fmt::format(
        "orientation  the picture is {}{}{}: write it upright", p.mirrored ? "mirrored" : "",
        p.mirrored && calibration.quarterTurns ? ", and " : "",
        calibration.quarterTurns ? fmt::format("turned by {} degrees", 90 * calibration.quarterTurns) : ""));
    return lines;
  }
  const CurveFit &best = calibration.curves[0], &next = calibration.curves[1];
  const auto name = [](const CurveFit& fit) { return kTransferNames[static_cast<std::size_t>(fit.transfer)]; };
  if (best.error > kMostCurveError)
    lines.push_back(fmt::format("curve        none of the known ones; the nearest is {} ({:.1f} of 255 away)",
                                name(best), best.error));
  else
    lines.push_back(fmt::format("curve        {} ({:.2f} of 255 away; the next, {}, {:.1f})", name(best), best.error,
                                name(next), next.error));
  lines.push_back(calibration.filterWidth == 0
                      ? "filter       none: one sample at the middle of a pixel"
                      : fmt::format("filter       as wide as a box of {:.2f} pixels", calibration.filterWidth));
  if (!calibration.environment) {
    lines.push_back("environment  not found: the mirror ball does not show three of the six coloured spots");
  } else {
    const Calibration::Turn& turn = *calibration.environment;
    lines.push_back(fmt::format("environment  turned by {:+.2f} degrees about the vertical, {:.2f} in all{} ({} spots, "
                                "within {:.2f} degrees)",
                                turn.yawDeg, turn.angleDeg, turn.isMirrored ? ", and mirrored" : "", turn.spots,
                                turn.errorDeg));
  }
  return lines;
}

} // namespace parity::external

#include "external/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "base/error.h"
#include "external/angles.h"
#include "external/calibration_scene.h"
#include "external/find_marks.h"
#include "external/picture.h"
#include "external/rotation_fit.h"

namespace parity::external {

namespace {

double luma(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

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

// The mean value within a rectangle of the picture's units.
Rgb meanAround(const Places& places, const glm::dvec2& at, const glm::dvec2& size, int width) {
  constexpr int kSamples = 8; // each way
  Rgb mean{};
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) {
      const glm::dvec2 offset = (glm::dvec2(i, j) + 0.5) / static_cast<double>(kSamples) - 0.5;
      const float* value = places.at(pixelOf(at + offset * size, width));
      for (std::size_t c = 0; c < 3; ++c) mean[c] += value[c] / static_cast<double>(kSamples * kSamples);
    }
  return mean;
}

void fitCurves(const base::Image& values, const Places& places, Calibration& calibration) {
  std::array<Rgb, kRampSteps> seen{};
  for (std::size_t step = 0; step < kRampSteps; ++step) // the middle half of a patch
    seen[step] = meanAround(places, rampPlace(step), {kRampHalf, kRampHalfHeight}, values.width);
  for (const char* name : kTransferNames) {
    CurveFit& fit = calibration.curves.emplace_back();
    fit.transfer = *findTransfer(name);
    for (std::size_t step = 0; step < kRampSteps; ++step) {
      const double grey = rampValue(step);
      const Rgb value = encode(fit.transfer, {grey, grey, grey});
      for (std::size_t c = 0; c < 3; ++c) fit.error += std::pow(255 * (value[c] - seen[step][c]), 2);
    }
    fit.error = std::sqrt(fit.error / (3 * kRampSteps));
  }
  std::ranges::stable_sort(calibration.curves, {}, &CurveFit::error);
  calibration.fitted = FittedCurve::fit(seen);
  if (!calibration.fitted) return;
  for (const Mark& mark : marks()) {
    const Rgb light = calibration.fitted->light(meanAround(places, mark.at, glm::dvec2(kMarkRadius), values.width));
    for (int c = 0; c < 3; ++c)
      calibration.mixing = std::max(calibration.mixing, std::abs(light[static_cast<std::size_t>(c)] - mark.color[c]));
  }
}

// How an edge rises from a tenth to nine tenths; a box of one pixel does so within 0.8 pixels.
double measureFilter(const base::Image& light, const Places& places) {
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
  const FoundMarks found = findMarks(values);
  if (found.count < kLeastMarks)
    refuse(
        fmt::format("does not show the calibration scene: {} of its {} marks are found", found.count, marks().size()));
  Calibration calibration;
  calibration.placement = found.placement, calibration.residual = found.residual;
  calibration.quarterTurns = found.quarterTurns;
  if (found.placement.mirrored || found.quarterTurns != 0)
    return calibration; // the rest is read where nothing is turned
  const Places places(values, calibration.placement);
  fitCurves(values, places, calibration);
  const CurveFit& best = calibration.curves.front();
  const Encoding encoding =
      best.error > kMostCurveError && calibration.fitted ? Encoding(*calibration.fitted) : Encoding(best.transfer);
  base::Image light = toLight(values, encoding);
  for (float& value : light.pixels) value = std::min(value, 2.f);
  calibration.filterWidth = measureFilter(light, places);
  calibration.environment = findTurn(light, places);
  return calibration;
}

std::string describeFit(const Calibration& calibration) {
  if (!calibration.fitted) return "Its greys do not grow from left to right: no curve can be read from them";
  if (calibration.mixing > kMostMixing)
    return fmt::format("It mixes channels: by the curve of its greys, colours are {:.2f} of light away. Write linear "
                       "pictures (.exr)",
                       calibration.mixing);
  return fmt::format("transfer = \"{}\" reads it from the ramp; colours are then within {:.3f} of light", kFitted,
                     calibration.mixing);
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
  if (best.error <= kMostCurveError)
    lines.push_back(fmt::format("curve        {} ({:.2f} of 255 away; the next, {}, {:.1f})", nameOf(best.transfer),
                                best.error, nameOf(next.transfer), next.error));
  else
    lines.push_back(fmt::format("curve        none of the known ones; the nearest is {} ({:.1f} of 255 away). {}",
                                nameOf(best.transfer), best.error, describeFit(calibration)));
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

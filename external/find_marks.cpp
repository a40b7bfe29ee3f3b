#include "external/find_marks.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "external/angles.h"
#include "external/calibration_scene.h"

namespace parity::external {

namespace {

// A bright patch of the picture.
struct Blob {
  glm::dvec2 at{0.0}; // pixels from the picture's middle, y down
  glm::dvec3 color{0.0};
  double area = 0;
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
    blobs.push_back(blob);
  }
  return blobs;
}

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
FoundMarks fitPlacement(const Match& match) {
  FoundMarks fit{.count = match.pairs.size()};
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
  Placement& placement = fit.placement;
  placement.scale = std::hypot(dot, cross) / square;
  const double angle = std::atan2(cross, dot), c = std::cos(angle) * placement.scale,
               s = std::sin(angle) * placement.scale;
  placement.rotationDeg = angle / kDegree;
  const glm::dvec2 shift = to - glm::dvec2(c * from.x - s * from.y, s * from.x + c * from.y);
  placement.dx = shift.x, placement.dy = shift.y;
  placement.mirrored = match.mirrored;
  fit.quarterTurns = match.quarters;
  double error = 0;
  for (const auto& [place, found] : match.pairs) {
    const glm::dvec2 a = seen(place), b(c * a.x - s * a.y + shift.x, s * a.x + c * a.y + shift.y);
    error += glm::dot(b - found, b - found) / n;
  }
  fit.residual = std::sqrt(error);
  return fit;
}

} // namespace

FoundMarks findMarks(const base::Image& values) {
  const Match match = matchMarks(findBlobs(values), values.width);
  return match.pairs.size() < 2 ? FoundMarks{.count = match.pairs.size()} : fitPlacement(match);
}

} // namespace parity::external

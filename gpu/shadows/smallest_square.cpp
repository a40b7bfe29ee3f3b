#include "gpu/shadows/smallest_square.h"

#include <algorithm>

namespace parity::gpu {

namespace {

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

// Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
std::vector<glm::vec2> convexHull(std::vector<glm::vec2> points) {
  std::sort(points.begin(), points.end(), [](auto a, auto b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const glm::vec2& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull.empty() ? points : hull;
}

} // namespace

Square smallestSquare(const std::vector<glm::vec2>& points) {
  const std::vector<glm::vec2> hull = convexHull(points);
  Square best;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const float length = glm::length(edge);
    const glm::vec2 x = length > 0 ? edge / length : glm::vec2(1, 0), y(-x.y, x.x);
    glm::vec2 lower(INFINITY), upper(-INFINITY);
    for (const glm::vec2& p : hull) {
      const glm::vec2 q(glm::dot(x, p), glm::dot(y, p));
      lower = glm::min(lower, q);
      upper = glm::max(upper, q);
    }
    const glm::vec2 size = upper - lower, middle = 0.5f * (lower + upper);
    if (const float half = 0.5f * std::max(size.x, size.y); half < best.halfSide)
      best = {x, middle.x * x + middle.y * y, half};
  }
  return best;
}

} // namespace parity::gpu

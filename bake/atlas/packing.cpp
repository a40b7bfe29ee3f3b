// Skyline packing: the largest rectangles first, several widths tried.
#include "bake/atlas/packing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace parity::bake {
namespace {

constexpr int kUnbounded = std::numeric_limits<int>::max() / 2;

// Highest first: equal heights side by side leave a level outline.
std::vector<std::size_t> packingOrder(const std::vector<Rectangle>& rectangles) {
  std::vector<std::size_t> order(rectangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rectangles[a].size.y != rectangles[b].size.y ? rectangles[a].size.y > rectangles[b].size.y
                                                        : rectangles[a].size.x > rectangles[b].size.x;
  });
  return order;
}

std::int64_t areaOf(const std::vector<Rectangle>& rectangles) {
  std::int64_t area = 0;
  for (const Rectangle& rectangle : rectangles) area += static_cast<std::int64_t>(rectangle.size.x) * rectangle.size.y;
  return area;
}

glm::ivec2 largestOf(const std::vector<Rectangle>& rectangles) {
  glm::ivec2 largest(0);
  for (const Rectangle& rectangle : rectangles) largest = glm::max(largest, rectangle.size);
  return largest;
}

int roundUpTo4(double side) { return static_cast<int>(std::ceil(side / 4)) * 4; }

std::optional<glm::ivec2> placeOn(Skyline& page, const Rectangle& rectangle) {
  return page.place(rectangle.size.x, rectangle.size.y);
}

std::optional<glm::ivec2> placeOn(Horizon& page, const Rectangle& rectangle) {
  if (rectangle.profile) return page.place(rectangle.size, *rectangle.profile);
  const auto columns = static_cast<std::size_t>(rectangle.size.x);
  const Profile whole{std::vector<std::uint16_t>(columns, 0),
                      std::vector<std::uint16_t>(columns, static_cast<std::uint16_t>(rectangle.size.y))};
  return page.place(rectangle.size, whole);
}

// Nothing (no pages) where more than maxPages would be needed.
template <typename Page> Packing packOn(const std::vector<Rectangle>& rectangles, const std::vector<std::size_t>& order,
                                        int width, int height, int maxPages) {
  Packing packing{width, height, 0, std::vector<glm::ivec2>(order.size()), std::vector<int>(order.size())};
  std::vector<Page> pages;
  for (const std::size_t i : order) {
    std::optional<glm::ivec2> corner;
    std::size_t page = 0;
    for (; page < pages.size() && !corner; ++page) corner = placeOn(pages[page], rectangles[i]);
    if (!corner) {
      if (static_cast<int>(pages.size()) == maxPages) return {};
      pages.emplace_back(width, height);
      corner = placeOn(pages.back(), rectangles[i]);
      page = pages.size();
    }
    packing.corners[i] = *corner;
    packing.page[i] = static_cast<int>(page) - 1;
  }
  packing.pages = static_cast<int>(pages.size());
  if (height == kUnbounded) packing.height = pages.front().usedHeight();
  return packing;
}

// By rectangles, and by profiles where there are any and it does not take too long; whichever serves better.
Packing packInto(const std::vector<Rectangle>& rectangles, const std::vector<std::size_t>& order, int width, int height,
                 int maxPages) {
  constexpr double kMostColumns = 1e8; // looked at for profiles
  double columns = 0;
  bool hasProfiles = false;
  for (const Rectangle& rectangle : rectangles) {
    columns += static_cast<double>(width) * rectangle.size.x;
    hasProfiles = hasProfiles || rectangle.profile;
  }
  Packing byRectangles = packOn<Skyline>(rectangles, order, width, height, maxPages);
  if (!hasProfiles || columns > kMostColumns) return byRectangles;
  Packing byProfiles = packOn<Horizon>(rectangles, order, width, height, maxPages);
  if (byProfiles.pages == 0) return byRectangles;
  const bool isBetter = byRectangles.pages == 0 || byProfiles.pages < byRectangles.pages ||
                        (byProfiles.pages == byRectangles.pages && byProfiles.height < byRectangles.height);
  return isBetter ? byProfiles : byRectangles;
}

// The smallest side that serves for so many pages.
std::optional<Packing> packSmallest(const std::vector<Rectangle>& rectangles, const std::vector<std::size_t>& order,
                                    int maxSide, int pages) {
  const glm::ivec2 largest = largestOf(rectangles);
  const double least =
      std::max<double>(std::max(largest.x, largest.y), std::sqrt(static_cast<double>(areaOf(rectangles)) / pages));
  for (double side = least; roundUpTo4(side) <= maxSide; side = std::max(side * 1.01, roundUpTo4(side) + 1.0)) {
    Packing packing = packInto(rectangles, order, roundUpTo4(side), roundUpTo4(side), pages);
    if (packing.pages > 0) return packing;
  }
  return std::nullopt;
}

} // namespace

Skyline::Skyline(int width, int height) : m_width(width), m_height(height), m_steps{{0, 0, width}} {}

std::optional<glm::ivec2> Skyline::place(int width, int height) {
  if (width > m_width || height > m_height) return std::nullopt;
  if (m_refused.x > 0 && width >= m_refused.x && height >= m_refused.y) return std::nullopt;
  std::size_t best = m_steps.size();
  int bestY = m_height - height + 1;
  for (std::size_t i = 0; i < m_steps.size() && m_steps[i].x + width <= m_width; ++i) {
    int y = 0;
    for (std::size_t k = i; k < m_steps.size() && m_steps[k].x < m_steps[i].x + width && y < bestY; ++k)
      y = std::max(y, m_steps[k].y);
    if (y < bestY) {
      best = i;
      bestY = y;
    }
  }
  if (best == m_steps.size()) {
    m_refused = {width, height};
    return std::nullopt;
  }
  const int x = m_steps[best].x, end = x + width;
  std::size_t covered = best;
  while (covered < m_steps.size() && m_steps[covered].x + m_steps[covered].width <= end) ++covered;
  if (covered < m_steps.size() && m_steps[covered].x < end) {
    m_steps[covered].width -= end - m_steps[covered].x;
    m_steps[covered].x = end;
  }
  const auto begin = m_steps.begin() + static_cast<std::ptrdiff_t>(best);
  const auto step = m_steps.insert(m_steps.erase(begin, m_steps.begin() + static_cast<std::ptrdiff_t>(covered)),
                                   Step{x, bestY + height, width});
  if (step + 1 != m_steps.end() && (step + 1)->y == step->y) {
    step->width += (step + 1)->width;
    m_steps.erase(step + 1);
  }
  m_usedHeight = std::max(m_usedHeight, bestY + height);
  if (best > 0 && m_steps[best - 1].y == m_steps[best].y) {
    m_steps[best - 1].width += m_steps[best].width;
    m_steps.erase(m_steps.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return glm::ivec2(x, bestY);
}

Packing packTight(const std::vector<Rectangle>& rectangles) {
  const std::vector<std::size_t> order = packingOrder(rectangles);
  const double side = std::sqrt(static_cast<double>(areaOf(rectangles)));
  Packing best;
  std::int64_t bestCost = std::numeric_limits<std::int64_t>::max();
  int lastWidth = 0;
  constexpr int kWidths = 18;
  double factor = 1; // of the side of a square
  for (int i = 0; i < kWidths; ++i, factor += 0.02) {
    const int width = std::max(largestOf(rectangles).x, static_cast<int>(std::ceil(side * factor)));
    if (width == lastWidth) continue;
    lastWidth = width;
    Packing packing = packInto(rectangles, order, width, kUnbounded, 1);
    // Of the square around it, and less of itself: a page is square, but may hold others beside.
    const std::int64_t longer = std::max(packing.width, packing.height);
    const std::int64_t cost = longer * longer + 2 * static_cast<std::int64_t>(packing.width) * packing.height;
    if (cost >= bestCost) continue;
    bestCost = cost;
    best = std::move(packing);
  }
  return best;
}

std::optional<Packing> packPage(const std::vector<Rectangle>& rectangles, int maxSide) {
  return packSmallest(rectangles, packingOrder(rectangles), maxSide, 1);
}

Packing packPages(const std::vector<Rectangle>& rectangles, int maxSide) {
  const std::vector<std::size_t> order = packingOrder(rectangles);
  const Packing widest = packInto(rectangles, order, maxSide, maxSide, std::numeric_limits<int>::max());
  return packSmallest(rectangles, order, maxSide, widest.pages).value_or(widest);
}

} // namespace parity::bake

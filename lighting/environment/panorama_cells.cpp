#include "lighting/environment/panorama_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "lighting/environment/panorama.h"
#include "shading/shading.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;
constexpr int kMinWidth = 1024, kMinHeight = 512; // as reference/environment_sampler.cpp has them

// A cell of a halved side covers [begin, end) of `size` cells.
struct Span {
  double begin, end;
  Span(int i, int size, int halved)
      : begin(static_cast<double>(i) * size / halved), end(static_cast<double>(i + 1) * size / halved) {}
  int first() const { return static_cast<int>(begin); }
  int last() const { return static_cast<int>(std::ceil(end)) - 1; }
  double from(int cell) const { return std::max(begin, static_cast<double>(cell)); }
  double to(int cell) const { return std::min(end, static_cast<double>(cell + 1)); }
};

std::vector<glm::vec4> halve(const std::vector<glm::vec4>& cells, int width, int height) {
  const int w = width / 2, h = height / 2;
  std::vector<glm::vec4> halved(static_cast<std::size_t>(w) * h);
  base::parallelFor(static_cast<std::size_t>(h), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < w; ++x) {
        const Span rows(static_cast<int>(y), height, h), columns(x, width, w);
        glm::dvec4 sum(0);
        double area = 0;
        for (int j = rows.first(); j <= rows.last(); ++j)
          for (int i = columns.first(); i <= columns.last(); ++i) {
            const double share = (std::cos(pi * rows.from(j) / height) - std::cos(pi * rows.to(j) / height)) *
                                 (columns.to(i) - columns.from(i));
            sum += share * glm::dvec4(cells[static_cast<std::size_t>(j) * width + i]);
            area += share;
          }
        halved[y * w + x] = glm::vec4(sum / area);
      }
  });
  return halved;
}

// Of `cells` places the one at or below a place, and how much of a box of `width` <= 1 around it lies in the next:
// places of middles are whole numbers.
struct Place {
  int below;
  double shareAbove;
  Place(double place, double width) : below(static_cast<int>(std::floor(place))) {
    const double beyond = place - below - 0.5; // the border between the two
    shareAbove = width > 0 ? std::clamp(beyond / width + 0.5, 0.0, 1.0) : beyond >= 0 ? 1.0 : 0.0;
  }
};

} // namespace

int widthOf(const PanoramaCells& cells, int mip) { return cells.width >> mip; }
int heightOf(const PanoramaCells& cells, int mip) { return cells.height >> mip; }

PanoramaCells makePanoramaCells(const scenes::Environment& environment) {
  checkRadiance(environment);
  const base::Image& image = environment.radiance;
  const int growX = (kMinWidth + image.width - 1) / image.width, growY = (kMinHeight + image.height - 1) / image.height;
  PanoramaCells cells;
  cells.width = image.width * growX;
  cells.height = image.height * growY;
  cells.turns = static_cast<float>(panoramaAzimuth(0, environment.rotationDeg) / (2 * pi));
  std::vector<glm::vec4> mip(static_cast<std::size_t>(cells.width) * cells.height);
  base::parallelFor(static_cast<std::size_t>(cells.height), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (int x = 0; x < cells.width; ++x)
        mip[y * cells.width + x] =
            glm::vec4(interpolateRadiance(image, (x + 0.5) / growX, (static_cast<double>(y) + 0.5) / growY), 1);
  });
  for (; cells.width > kMaxPanoramaWidth || cells.height > kMaxPanoramaHeight; cells.width /= 2, cells.height /= 2)
    mip = halve(mip, cells.width, cells.height);
  cells.mips.push_back(std::move(mip));
  const double widest = shading::f64::sharpLobe(static_cast<double>(shading::f64::kSharpestPrefilteredMip)).width;
  for (int m = 0; widest > pi / heightOf(cells, m) && heightOf(cells, m + 1) > 0; ++m)
    cells.mips.push_back(halve(cells.mips.back(), widthOf(cells, m), heightOf(cells, m)));
  return cells;
}

glm::vec3 readCells(const PanoramaCells& cells, const glm::dvec3& direction, double boxWidth) {
  const int last = static_cast<int>(cells.mips.size()) - 1;
  const double rowsWide = boxWidth * cells.height / pi;
  const int mip = rowsWide > 1 ? std::min(last, static_cast<int>(std::ceil(std::log2(rowsWide)))) : 0;
  const int width = widthOf(cells, mip), height = heightOf(cells, mip);
  const double horizontal = std::hypot(direction.x, direction.z);
  double turns = std::atan2(direction.z, direction.x) / (2 * pi) + 0.5 + cells.turns;
  turns -= std::floor(turns);
  const double polar = std::atan2(horizontal, direction.y), sine = horizontal / glm::length(direction);
  const double columnWidth = 2 * pi / width * sine;
  const Place x(turns * width - 0.5, boxWidth < columnWidth ? boxWidth / columnWidth : boxWidth > 0 ? 1 : 0);
  const Place y(polar / pi * height - 0.5, std::min(1.0, boxWidth * height / pi));
  const auto at = [&](int column, int row) {
    return glm::dvec3(
        cells.mips[mip][static_cast<std::size_t>(std::clamp(row, 0, height - 1)) * width + (column + width) % width]);
  };
  const glm::dvec3 upper = glm::mix(at(x.below, y.below), at(x.below + 1, y.below), x.shareAbove);
  const glm::dvec3 lower = glm::mix(at(x.below, y.below + 1), at(x.below + 1, y.below + 1), x.shareAbove);
  return glm::vec3(glm::mix(upper, lower, y.shareAbove));
}

} // namespace parity::lighting

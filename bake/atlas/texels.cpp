// The raster of an atlas, in bands of rows at the same time.
#include "bake/atlas/texels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "bake/atlas/raster.h"
#include "base/error.h"
#include "base/parallel.h"

namespace parity::bake {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr std::uint32_t kMixed = 0x80000000u;
constexpr int kBandRows = 64;
// Sub-texels: charts that end at a texel's border keep the middles on it, whatever floats have made of the uvs.
constexpr double kOutset = 1e-3;
// Texels: more than uvs in floats are wrong by, so that no texel counts as touched that the packing did not reserve.
constexpr double kTouched = 4 * kTouchSlack;

// The corners of a triangle in sub-texels of its page.
std::array<glm::dvec2, 3> cornersOf(const Atlas& atlas, const scenes::LightmapUvs::Place& place, std::size_t triangle,
                                    double subTexelsPerPage) {
  std::array<glm::dvec2, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = (glm::dvec2(atlas.uvs.corners[place.firstCorner + 3 * triangle + k]) + glm::dvec2(place.offset)) *
                 subTexelsPerPage;
  return corners;
}

// The weights of the corners at p: those of a point outside, beside a sliver, are drawn to its border.
std::array<double, 3> weightsAt(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& p) {
  const double area = doubleArea(corners);
  if (area == 0) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  std::array<double, 3> weights;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] = std::max(0.0, doubleArea({p, corners[(k + 1) % 3], corners[(k + 2) % 3]}) / area);
    sum += weights[k];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0 ? v / length : otherwise;
}

// Of the triangle's border, in the plane.
glm::dvec2 nearestPoint(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& p) {
  glm::dvec2 best = corners[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 edge = corners[(k + 1) % 3] - corners[k];
    const double length2 = glm::dot(edge, edge);
    const double along = length2 > 0 ? std::clamp(glm::dot(p - corners[k], edge) / length2, 0.0, 1.0) : 0;
    const glm::dvec2 point = corners[k] + along * edge;
    if (glm::length(p - point) < glm::length(p - best)) best = point;
  }
  return best;
}

// Where an instance lies on its page.
struct Extent {
  std::int32_t page = -1;
  int yBegin = 0, yEnd = 0; // rows of texels
};

std::vector<Extent> extentsOf(const scenes::Scene& scene, const Atlas& atlas) {
  std::vector<Extent> extents(scene.instances.size());
  base::parallelFor(extents.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const scenes::LightmapUvs::Place& place = atlas.uvs.places[i];
      const std::size_t corners = scene.meshes[scene.instances[i].mesh].indices.size();
      if (place.page < 0 || corners == 0) continue;
      float lowest = std::numeric_limits<float>::max(), highest = 0;
      for (std::size_t k = 0; k < corners; ++k) {
        const float y = atlas.uvs.corners[place.firstCorner + k].y + place.offset.y;
        lowest = std::min(lowest, y);
        highest = std::max(highest, y);
      }
      const auto side = static_cast<float>(atlas.pageSide);
      extents[i] = {place.page, static_cast<int>(std::floor(lowest * side - 0.01f)),
                    static_cast<int>(std::ceil(highest * side + 0.01f))};
    }
  });
  return extents;
}

} // namespace

// One band at full resolution, before texels of one triangle are folded.
class TexelGrid::BandRaster {
public:
  BandRaster(const TexelGrid& grid, std::int32_t page, int yBegin, int rows)
      : m_grid(grid), m_page(page), m_yBegin(yBegin), m_rows(rows), m_width(grid.m_atlas.pageSide * grid.m_factor),
        m_triangles(static_cast<std::size_t>(m_width) * rows * grid.m_factor, kNone) {}

  void add(const std::vector<std::uint32_t>& instances) {
    for (const auto pass : {&BandRaster::addSpans, &BandRaster::addSliver, &BandRaster::addTouched})
      for (const std::uint32_t instance : instances) addInstance(instance, pass);
  }

  Band fold() const {
    const int factor = m_grid.m_factor, width = m_grid.m_atlas.pageSide;
    Band band;
    band.texels.reserve(static_cast<std::size_t>(width) * m_rows);
    std::vector<std::uint32_t> block(static_cast<std::size_t>(factor) * factor);
    for (int y = 0; y < m_rows; ++y)
      for (int x = 0; x < width; ++x) {
        for (int row = 0; row < factor; ++row)
          std::copy_n(m_triangles.data() + static_cast<std::size_t>(y * factor + row) * m_width + x * factor, factor,
                      block.data() + row * factor);
        const bool isUniform = std::all_of(block.begin(), block.end(), [&](std::uint32_t t) { return t == block[0]; });
        const auto first = std::find_if(block.begin(), block.end(), [](std::uint32_t t) { return t != kNone; });
        if (first != block.end())
          band.covered.push_back({static_cast<std::uint32_t>(m_page), m_grid.instanceOf(*first),
                                  static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(m_yBegin + y)});
        band.texels.push_back(isUniform ? block[0]
                                        : kMixed + static_cast<std::uint32_t>(band.mixed.size() / block.size()));
        if (!isUniform) band.mixed.insert(band.mixed.end(), block.begin(), block.end());
      }
    band.mixed.shrink_to_fit();
    band.covered.shrink_to_fit();
    return band;
  }

private:
  using Corners = std::array<glm::dvec2, 3>; // in sub-texels of the page

  void addInstance(std::uint32_t instance, void (BandRaster::*pass)(const Corners&, std::uint32_t)) {
    const Atlas& atlas = m_grid.m_atlas;
    const scenes::LightmapUvs::Place& place = atlas.uvs.places[instance];
    const std::uint32_t first = m_grid.m_firstTriangle[instance], count = m_grid.m_firstTriangle[instance + 1] - first;
    const double begin = m_yBegin * m_grid.m_factor - 1, end = (m_yBegin + m_rows) * m_grid.m_factor + 1;
    for (std::uint32_t t = 0; t < count; ++t) {
      const Corners corners = cornersOf(atlas, place, t, m_width);
      if (std::max({corners[0].y, corners[1].y, corners[2].y}) >= begin &&
          std::min({corners[0].y, corners[1].y, corners[2].y}) <= end && doubleArea(corners) != 0)
        (this->*pass)(corners, first + t);
    }
  }

  std::uint32_t& subTexel(int x, int y) {
    return m_triangles[static_cast<std::size_t>(y - m_yBegin * m_grid.m_factor) * m_width + x];
  }

  void addSpans(const Corners& corners, std::uint32_t number) {
    Corners inBand = corners;
    for (glm::dvec2& corner : inBand) corner.y -= m_yBegin * m_grid.m_factor;
    forEachSpan(inBand, -kOutset, m_width, m_rows * m_grid.m_factor, [&](int y, int begin, int end) {
      std::uint32_t* row = m_triangles.data() + static_cast<std::size_t>(y) * m_width;
      for (int x = begin; x < end; ++x)
        if (row[x] == kNone) row[x] = number;
    });
  }

  void addSliver(const Corners& corners, std::uint32_t number) {
    const glm::dvec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const int x = static_cast<int>(std::floor(middle.x)), y = static_cast<int>(std::floor(middle.y));
    const int begin = m_yBegin * m_grid.m_factor, end = begin + m_rows * m_grid.m_factor;
    if (x < 0 || x >= m_width || y < begin || y >= end || subTexel(x, y) != kNone) return;
    bool holdsMiddle = false;
    forEachSpan(corners, -kOutset, m_width, m_width, [&](int, int, int) { holdsMiddle = true; });
    if (!holdsMiddle) subTexel(x, y) = number;
  }

  // The texels that the triangle reaches into and that have no surface yet.
  void addTouched(const Corners& corners, std::uint32_t number) {
    const int factor = m_grid.m_factor, side = m_grid.m_atlas.pageSide;
    Corners texels = corners;
    for (glm::dvec2& corner : texels) corner /= factor;
    forEachTouched(texels, kTouched, side, side, [&](int x, int begin, int end) {
      for (int y = std::max(begin, m_yBegin); y < std::min(end, m_yBegin + m_rows); ++y) {
        if (!isFree(x, y)) continue;
        const glm::dvec2 nearest = nearestPoint(texels, {x + 0.5, y + 0.5}) - glm::dvec2(x, y);
        const glm::ivec2 cell(glm::clamp(glm::floor(nearest * static_cast<double>(factor)), 0.0, factor - 1.0));
        subTexel(x * factor + cell.x, y * factor + cell.y) = number;
      }
    });
  }

  bool isFree(int x, int y) {
    const int factor = m_grid.m_factor;
    for (int row = 0; row < factor; ++row) {
      const std::uint32_t* first = &subTexel(x * factor, y * factor + row);
      if (std::any_of(first, first + factor, [](std::uint32_t t) { return t != kNone; })) return false;
    }
    return true;
  }

  const TexelGrid& m_grid;
  std::int32_t m_page;
  int m_yBegin, m_rows, m_width;
  std::vector<std::uint32_t> m_triangles;
};

TexelGrid::TexelGrid(const scenes::Scene& scene, const Atlas& atlas, int factor)
    : m_scene(scene), m_atlas(atlas), m_factor(factor) {
  assert(factor >= 1 && factor <= 16 && atlas.uvs.places.size() == scene.instances.size());
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    m_firstTriangle.push_back(static_cast<std::uint32_t>(triangles));
    if (atlas.uvs.places[i].page >= 0) triangles += scene.meshes[scene.instances[i].mesh].indices.size() / 3;
    if (triangles >= kMixed) throw base::fileError(scene.name, "", "has too many triangles for a lightmap");
  }
  m_firstTriangle.push_back(static_cast<std::uint32_t>(triangles));

  m_bandsPerPage = static_cast<std::size_t>((atlas.pageSide + kBandRows - 1) / kBandRows);
  m_bands.resize(m_bandsPerPage * static_cast<std::size_t>(atlas.pageCount));
  std::vector<std::vector<std::uint32_t>> instances(m_bands.size());
  const std::vector<Extent> extents = extentsOf(scene, atlas);
  for (std::uint32_t i = 0; i < extents.size(); ++i) {
    if (extents[i].page < 0) continue;
    const auto firstBand = static_cast<std::size_t>(std::max(0, extents[i].yBegin) / kBandRows);
    const auto lastBand = static_cast<std::size_t>(std::min(atlas.pageSide, extents[i].yEnd) - 1) / kBandRows;
    for (std::size_t band = firstBand; band <= lastBand; ++band)
      instances[static_cast<std::size_t>(extents[i].page) * m_bandsPerPage + band].push_back(i);
  }
  base::parallelFor(m_bands.size(), 1, [&](std::size_t i, std::size_t) {
    const int yBegin = static_cast<int>(i % m_bandsPerPage) * kBandRows;
    BandRaster raster(*this, static_cast<std::int32_t>(i / m_bandsPerPage), yBegin,
                      std::min(kBandRows, m_atlas.pageSide - yBegin));
    raster.add(instances[i]);
    m_bands[i] = raster.fold();
  });
  std::size_t covered = 0;
  for (const Band& band : m_bands) covered += band.covered.size();
  m_texels.reserve(covered);
  for (Band& band : m_bands) {
    m_texels.insert(m_texels.end(), band.covered.begin(), band.covered.end());
    band.covered = {};
  }
}

std::uint32_t TexelGrid::instanceOf(std::uint32_t triangle) const {
  // The last instance that begins at or before it; instances without triangles begin where the next one does.
  const auto next = std::upper_bound(m_firstTriangle.begin(), m_firstTriangle.end() - 1, triangle);
  return static_cast<std::uint32_t>(next - m_firstTriangle.begin()) - 1;
}

std::uint32_t TexelGrid::triangleAt(std::uint32_t page, int x, int y) const {
  const int texelX = x / m_factor, texelY = y / m_factor;
  const Band& band = m_bands[page * m_bandsPerPage + static_cast<std::size_t>(texelY / kBandRows)];
  const std::uint32_t entry =
      band.texels[static_cast<std::size_t>(texelY % kBandRows) * static_cast<std::size_t>(m_atlas.pageSide) +
                  static_cast<std::size_t>(texelX)];
  if (entry == kNone || entry < kMixed) return entry;
  const auto area = static_cast<std::size_t>(m_factor * m_factor);
  return band.mixed[(entry - kMixed) * area + static_cast<std::size_t>((y % m_factor) * m_factor + x % m_factor)];
}

std::optional<SurfacePoint> TexelGrid::at(std::uint32_t page, int x, int y) const {
  const std::uint32_t number = triangleAt(page, x, y);
  if (number == kNone) return std::nullopt;
  SurfacePoint point;
  point.instance = instanceOf(number);
  const scenes::Instance& instance = m_scene.instances[point.instance];
  const scenes::Mesh& mesh = m_scene.meshes[instance.mesh];
  const std::size_t triangle = number - m_firstTriangle[point.instance];
  const std::array<glm::dvec2, 3> corners =
      cornersOf(m_atlas, m_atlas.uvs.places[point.instance], triangle, m_atlas.pageSide * m_factor);
  const std::array<double, 3> weights = weightsAt(corners, {x + 0.5, y + 0.5});
  std::array<glm::dvec3, 3> p;
  glm::dvec3 position(0), normal(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = mesh.indices[3 * triangle + k];
    p[k] = mesh.positions[vertex];
    position += weights[k] * p[k];
    normal += weights[k] * glm::dvec3(mesh.normals[vertex]);
  }
  point.position = glm::vec3(glm::dmat4(instance.toWorld) * glm::dvec4(position, 1));
  // The matrix of cofactors, det(M) times the inverse transpose: it turns normals also where M flattens, and flips them
  // where M mirrors, which the sign puts right.
  const glm::dmat3 m(instance.toWorld);
  glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  if (glm::dot(m[0], cofactors[0]) < 0) cofactors *= -1.0;
  // A transform may flatten the triangle to a line, and normals may cancel each other.
  const glm::dvec3 geometric = unitOr(cofactors * glm::cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0});
  point.geometric = glm::vec3(geometric);
  point.normal = glm::vec3(unitOr(cofactors * normal, geometric));
  return point;
}

std::size_t TexelGrid::bytes() const {
  std::size_t bytes = m_texels.capacity() * sizeof(Texel) + m_firstTriangle.capacity() * sizeof(std::uint32_t);
  for (const Band& band : m_bands)
    bytes += sizeof(Band) + (band.texels.capacity() + band.mixed.capacity()) * sizeof(std::uint32_t);
  return bytes;
}

} // namespace parity::bake

// From an equirectangular panorama to a cube by exact areas. Along a meridian the texels of the cube and the rows of
// the panorama cut the sphere at known heights y = cos(theta), and area is width in azimuth times difference in y: so
// each face is summed meridian by meridian, and what one texel loses at a border its neighbour gains.
#include "lighting/environment/equirect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "base/parallel.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/equirect_lines.h"
#include "lighting/environment/panorama.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;

// Panoramas of the same shape, which differ in their radiance.
using Panoramas = std::span<const Panorama* const>;

// Calls visit(azimuth, width, column) for the parts of [from, to] (azimuths) within each column of the panorama.
template <typename Visit> void forEachColumn(const Panorama& p, double from, double to, const Visit& visit) {
  const double end = p.columnAt(to);
  for (double begin = p.columnAt(from); begin < end;) {
    const double next = std::min(end, std::floor(begin) + 1);
    visit(p.azimuthAt(begin), (next - begin) / p.width * 2 * pi, static_cast<long long>(std::floor(begin)));
    begin = next;
  }
}

// The steps of a line of texels, and what its loops write to.
class Line {
public:
  template <typename Step> Line(const Panorama& p, int texels, const Step& step) : m_rowY(p.rowY), m_texels(texels) {
    for (int i = 0; i < texels; ++i) m_steps.push_back(step(i));
    m_steps.resize(m_steps.size() + kLinePadding, 1.0);
    m_borders.resize(2 * m_steps.size());
  }
  LineShape shape() { return {m_rowY, m_steps, m_borders, m_texels}; }

private:
  std::span<const double> m_rowY;
  std::vector<double> m_steps, m_borders;
  int m_texels;
};

// Column x of a side face, whose middle looks to `faceAzimuth`: its texels' borders lie at y = -t c / sqrt(1 + t^2 c^2)
// with c = cos(azimuth - faceAzimuth). Where such a border crosses one of the panorama's rows, within a part, the
// shares have a kink: six meridians a part meet a texel's share in another to 1e-3, and the energy to 1e-6.
void gatherSideColumn(Panoramas panoramas, double faceAzimuth, int x, int n, Line& line,
                      std::vector<Gathered>& texels) {
  texels.assign(n * panoramas.size(), {});
  const auto azimuthOfEdge = [&](int i) { return faceAzimuth - std::atan(2.0 * i / n - 1); };
  std::array<CellLine, kMaxCellLines> cells;
  forEachColumn(*panoramas[0], azimuthOfEdge(x + 1), azimuthOfEdge(x),
                [&](double azimuth, double width, long long column) {
                  constexpr int kMeridians = 6;
                  const double weight = width / kMeridians;
                  for (std::size_t k = 0; k < panoramas.size(); ++k) cells[k] = {panoramas[k]->column(column), 1};
                  for (int meridian = 0; meridian < kMeridians; ++meridian)
                    gatherMeridian(line.shape(), std::cos(azimuth + (meridian + 0.5) * weight - faceAzimuth), weight,
                                   std::span(cells).first(panoramas.size()), texels.data());
                });
}

// A quarter of both polar faces: the texels between azimuths q pi/2 and (q + 1) pi/2, indexed by their distance from
// the pole along |x| and |z|, the lines of the upper face first. On the ray of an azimuth, borders lie where tan(theta)
// = |x| / |cos| or |z| / |sin|. The rows lie alike around both poles.
std::vector<Gathered> gatherPolarQuarter(Panoramas panoramas, int quarter, int n) {
  const Panorama& p = *panoramas[0];
  const int half = n / 2;
  const std::size_t lines = 2 * panoramas.size();
  Line line(p, half, [](int i) { return i + 1.0; });
  std::vector<Gathered> texels(static_cast<std::size_t>(half) * half * lines);
  // At the face's rim some 20 rays to a texel's width: the coverage of a texel is met to 1e-3, its radiance (divided by
  // that coverage) better.
  const int rays = std::max(1, (64 * n + p.width - 1) / p.width);
  std::array<CellLine, kMaxCellLines> cells;
  forEachColumn(p, quarter * pi / 2, (quarter + 1) * pi / 2, [&](double azimuth, double width, long long column) {
    for (std::size_t k = 0; k < panoramas.size(); ++k) {
      cells[k] = {panoramas[k]->column(column), 1};
      cells[panoramas.size() + k] = {panoramas[k]->column(column) + p.height - 1, -1};
    }
    for (int ray = 0; ray < rays; ++ray) {
      const double a = azimuth + (ray + 0.5) / rays * width, weight = width / rays;
      gatherRay(line.shape(), 1 / (half * std::abs(std::cos(a))), 1 / (half * std::abs(std::sin(a))), weight,
                std::span(cells).first(lines), texels.data());
    }
  });
  return texels;
}

using Cubes = std::vector<std::vector<glm::vec4>>; // of each panorama

void resampleSides(Panoramas panoramas, int n, Cubes& cubes) {
  struct Side {
    int face;
    double azimuth; // atan2(z, x) of its middle
  };
  constexpr Side kSides[] = {{0, 0.0}, {1, pi}, {4, pi / 2}, {5, -pi / 2}};
  base::parallelFor(4 * static_cast<std::size_t>(n), 8, [&](std::size_t begin, std::size_t end) {
    Line line(*panoramas[0], n, [n](int i) { return 2.0 * (i + 1) / n - 1; });
    std::vector<Gathered> texels;
    for (std::size_t i = begin; i < end; ++i) {
      const Side& side = kSides[i / n];
      const int x = static_cast<int>(i % n);
      gatherSideColumn(panoramas, side.azimuth, x, n, line, texels);
      for (int y = 0; y < n; ++y)
        for (std::size_t k = 0; k < cubes.size(); ++k)
          cubes[k][texelIndex(side.face, x, y, n)] = texels[y * cubes.size() + k].mean();
    }
  });
}

void resamplePoles(Panoramas panoramas, int n, Cubes& cubes) {
  base::parallelFor(4, 1, [&](std::size_t task, std::size_t) {
    const int quarter = static_cast<int>(task), half = n / 2;
    const std::vector<Gathered> texels = gatherPolarQuarter(panoramas, quarter, n);
    const bool positiveX = quarter == 0 || quarter == 3, positiveZ = quarter < 2;
    const Gathered* texel = texels.data();
    for (int z = 0; z < half; ++z)
      for (int x = 0; x < half; ++x)
        for (const bool top : {true, false})
          for (std::vector<glm::vec4>& cube : cubes) {
            const int column = positiveX ? half + x : half - 1 - x;
            const int row = positiveZ == top ? half + z : half - 1 - z; // t runs along +z on +Y and along -z on -Y
            cube[texelIndex(top ? 2 : 3, column, row, n)] = (texel++)->mean();
          }
  });
}

Cubes resample(Panoramas panoramas, int n) {
  Cubes cubes(panoramas.size(), std::vector<glm::vec4>(texelIndex(kCubeFaces, 0, 0, n)));
  resampleSides(panoramas, n, cubes);
  resamplePoles(panoramas, n, cubes);
  return cubes;
}

} // namespace

std::vector<glm::vec4> resampleEquirect(const scenes::Environment& environment, int n) {
  return resampleEquirect(makePanorama(environment, n), n);
}

std::vector<glm::vec4> resampleEquirect(const Panorama& panorama, int n) {
  const std::array panoramas{&panorama};
  return std::move(resample(panoramas, n)[0]);
}

std::pair<std::vector<glm::vec4>, std::vector<glm::vec4>> resampleEquirect(const Panorama& a, const Panorama& b,
                                                                           int n) {
  const std::array panoramas{&a, &b};
  Cubes cubes = resample(panoramas, n);
  return {std::move(cubes[0]), std::move(cubes[1])};
}

} // namespace parity::lighting

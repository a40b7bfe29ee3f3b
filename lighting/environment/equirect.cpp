// From an equirectangular panorama to a cube by exact areas. Along a meridian the texels of the cube and the rows of
// the panorama cut the sphere at known heights y = cos(theta), and area is width in azimuth times difference in y: so
// each face is summed meridian by meridian, and what one texel loses at a border its neighbour gains.
#include "lighting/environment/equirect.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/parallel.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/panorama.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;

// The weighted sum of what falls into a cube texel.
struct Gathered {
  glm::dvec3 sum{0.0};
  double weight = 0;
  void add(double w, const glm::vec3& radiance) {
    sum += w * glm::dvec3(radiance);
    weight += w;
  }
  glm::vec4 mean() const { return {glm::vec3(sum / weight), 1.f}; }
};

// Calls visit(azimuth, width, column) for the parts of [from, to] (azimuths) within each column of the panorama.
template <typename Visit> void forEachColumn(const Panorama& p, double from, double to, const Visit& visit) {
  const double end = p.columnAt(to);
  for (double begin = p.columnAt(from); begin < end;) {
    const double next = std::min(end, std::floor(begin) + 1);
    visit(p.azimuthAt(begin), (next - begin) / p.width * 2 * pi, p.column(static_cast<long long>(std::floor(begin))));
    begin = next;
  }
}

// Column x of a side face, whose middle looks to `faceAzimuth`: its texels' borders lie at y = -t c / sqrt(1 + t^2 c^2)
// with c = cos(azimuth - faceAzimuth). Where such a border crosses one of the panorama's rows, within a part, the
// shares have a kink: six meridians a part meet a texel's share in another to 1e-3, and the energy to 1e-6.
void gatherSideColumn(const Panorama& p, double faceAzimuth, int x, int n, std::vector<Gathered>& texels) {
  texels.assign(n, {});
  const auto azimuthOfEdge = [&](int i) { return faceAzimuth - std::atan(2.0 * i / n - 1); };
  forEachColumn(p, azimuthOfEdge(x + 1), azimuthOfEdge(x), [&](double azimuth, double width, const glm::vec3* column) {
    constexpr int kMeridians = 6;
    const double weight = width / kMeridians;
    for (int meridian = 0; meridian < kMeridians; ++meridian) {
      const double c = std::cos(azimuth + (meridian + 0.5) * weight - faceAzimuth);
      double y = c / std::sqrt(1 + c * c);
      int row =
          static_cast<int>(std::upper_bound(p.rowY.begin(), p.rowY.end(), y, std::greater<>()) - p.rowY.begin()) - 1;
      for (int i = 0; i < n; ++i) {
        const double tc = (2.0 * (i + 1) / n - 1) * c;
        const double bottom = -tc / std::sqrt(1 + tc * tc);
        for (; p.rowY[row + 1] > bottom; ++row) {
          texels[i].add(weight * (y - p.rowY[row + 1]), column[row]);
          y = p.rowY[row + 1];
        }
        texels[i].add(weight * (y - bottom), column[row]);
        y = bottom;
      }
    }
  });
}

// A quarter of a polar face: the texels between azimuths q pi/2 and (q + 1) pi/2, indexed by their distance from the
// pole along |x| and |z|. On the ray of an azimuth, borders lie where tan(theta) = |x| / |cos| or |z| / |sin|.
std::vector<Gathered> gatherPolarQuarter(const Panorama& p, bool top, int quarter, int n) {
  const int half = n / 2;
  std::vector<Gathered> texels(static_cast<std::size_t>(half) * half);
  // At the face's rim some 20 rays to a texel's width: the coverage of a texel is met to 1e-3, its radiance (divided by
  // that coverage) better.
  const int rays = std::max(1, (64 * n + p.width - 1) / p.width);
  forEachColumn(
      p, quarter * pi / 2, (quarter + 1) * pi / 2, [&](double azimuth, double width, const glm::vec3* column) {
        for (int ray = 0; ray < rays; ++ray) {
          const double a = azimuth + (ray + 0.5) / rays * width, weight = width / rays;
          const double stepX = 1 / (half * std::abs(std::cos(a))), stepZ = 1 / (half * std::abs(std::sin(a)));
          double y = 1;
          for (int x = 0, z = 0, row = 0; x < half && z < half;) {
            const double tangentX = (x + 1) * stepX, tangentZ = (z + 1) * stepZ;
            const double tangent = std::min(tangentX, tangentZ), bottom = 1 / std::sqrt(1 + tangent * tangent);
            Gathered& texel = texels[static_cast<std::size_t>(z) * half + x];
            for (; p.rowY[row + 1] > bottom; ++row) { // the rows lie alike around both poles
              texel.add(weight * (y - p.rowY[row + 1]), column[top ? row : p.height - 1 - row]);
              y = p.rowY[row + 1];
            }
            texel.add(weight * (y - bottom), column[top ? row : p.height - 1 - row]);
            y = bottom;
            tangentX <= tangentZ ? ++x : ++z;
          }
        }
      });
  return texels;
}

} // namespace

std::vector<glm::vec4> resampleEquirect(const scenes::Environment& environment, int n) {
  return resampleEquirect(makePanorama(environment, n), n);
}

std::vector<glm::vec4> resampleEquirect(const Panorama& panorama, int n) {
  std::vector<glm::vec4> base(texelIndex(kCubeFaces, 0, 0, n));

  struct Side {
    int face;
    double azimuth; // atan2(z, x) of its middle
  };
  constexpr Side kSides[] = {{0, 0.0}, {1, pi}, {4, pi / 2}, {5, -pi / 2}};
  base::parallelFor(4 * static_cast<std::size_t>(n), 8, [&](std::size_t begin, std::size_t end) {
    std::vector<Gathered> texels;
    for (std::size_t i = begin; i < end; ++i) {
      const Side& side = kSides[i / n];
      const int x = static_cast<int>(i % n);
      gatherSideColumn(panorama, side.azimuth, x, n, texels);
      for (int y = 0; y < n; ++y) base[texelIndex(side.face, x, y, n)] = texels[y].mean();
    }
  });

  base::parallelFor(8, 1, [&](std::size_t task, std::size_t) {
    const bool top = task < 4;
    const int quarter = static_cast<int>(task % 4), half = n / 2;
    const std::vector<Gathered> texels = gatherPolarQuarter(panorama, top, quarter, n);
    const bool positiveX = quarter == 0 || quarter == 3, positiveZ = quarter < 2;
    for (int z = 0; z < half; ++z)
      for (int x = 0; x < half; ++x) {
        const int column = positiveX ? half + x : half - 1 - x;
        const int row = positiveZ == top ? half + z : half - 1 - z; // t runs along +z on +Y and along -z on -Y
        base[texelIndex(top ? 2 : 3, column, row, n)] = texels[static_cast<std::size_t>(z) * half + x].mean();
      }
  });
  return base;
}

} // namespace parity::lighting

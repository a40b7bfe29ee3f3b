// From an equirectangular panorama to a cube by exact areas. Along a meridian the texels of the cube and the rows of
// the panorama cut the sphere at known heights y = cos(theta), and area is width in azimuth times difference in y: so
// each face is summed meridian by meridian, and what one texel loses at a border its neighbour gains.
#include "lighting/equirect.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "lighting/cube.h"

namespace parity::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kMaxRadiance = 1e30f;

// The panorama in columns (each from +Y down), at a width and height that suit the faces, and turned as told.
struct Panorama {
  int width = 0, height = 0;
  std::vector<glm::vec3> columns;
  std::vector<double> rowY; // height + 1 bounds of the rows, cos(theta): 1 .. -1
  float rotationDeg = 0;

  const glm::vec3* column(long long i) const {
    const long long wrapped = ((i % width) + width) % width;
    return columns.data() + static_cast<std::size_t>(wrapped) * height;
  }
  // In columns; grows with the azimuth without wrapping around.
  double columnAt(double azimuth) const { return (azimuth + rotation() + kPi) / (2 * kPi) * width; }
  double azimuthAt(double columnPosition) const { return columnPosition / width * 2 * kPi - kPi - rotation(); }
  double rotation() const { return panoramaAzimuth(0, rotationDeg); }
};

void checkRadiance(const scenes::Environment& environment) {
  const base::Image& image = environment.radiance;
  const auto fail = [&](const std::string& reason) {
    throw base::fileError("environment " + environment.name, "", reason);
  };
  if (image.empty() || image.width < 1 || image.height < 1) fail("has no pixels");
  if (image.channels != 3) fail("has " + std::to_string(image.channels) + " channels instead of 3");
  if (image.pixels.size() != image.pixelCount() * 3) fail("has a size that is not that of its pixels");
  for (const float value : image.pixels)
    if (!(value >= 0 && std::isfinite(value))) fail("holds a radiance that is negative or not finite");
  if (!std::isfinite(environment.rotationDeg)) fail("has a rotation that is not finite");
}

glm::vec3 texelAt(const base::Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return glm::min(glm::vec3(p[0], p[1], p[2]), kMaxRadiance);
}

// Bilinear, wrapped around horizontally and clamped at the poles. x, y in texels, the middle of the first at 0.5.
glm::vec3 bilinearAt(const base::Image& image, double x, double y) {
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const float fx = static_cast<float>(x - 0.5 - left), fy = static_cast<float>(y - 0.5 - top);
  const int x0 = (static_cast<int>(left) + image.width) % image.width, x1 = (x0 + 1) % image.width;
  const int y0 = std::clamp(static_cast<int>(top), 0, image.height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, image.height - 1);
  const glm::vec3 upper = glm::mix(texelAt(image, x0, y0), texelAt(image, x1, y0), fx);
  const glm::vec3 lower = glm::mix(texelAt(image, x0, y1), texelAt(image, x1, y1), fx);
  return glm::mix(upper, lower, fy);
}

// The largest divisor of `size` that leaves at least `least`.
int divisorLeaving(int size, int least) {
  for (int divisor = std::max(1, size / least); divisor > 1; --divisor)
    if (size % divisor == 0) return divisor;
  return 1;
}

// Between about 4 and 16 columns for each of a face's: fewer would show as blocks, more would only cost time.
Panorama makePanorama(const scenes::Environment& environment, int faceSize) {
  const base::Image& image = environment.radiance;
  const int growX = (4 * faceSize + image.width - 1) / image.width;
  const int growY = (2 * faceSize + image.height - 1) / image.height;
  const bool grows = growX > 1 || growY > 1;
  const int shrinkX = grows ? 1 : divisorLeaving(image.width, 8 * faceSize);
  const int shrinkY = grows ? 1 : divisorLeaving(image.height, 4 * faceSize);
  Panorama p;
  p.width = image.width * growX / shrinkX;
  p.height = image.height * growY / shrinkY;
  p.rotationDeg = environment.rotationDeg;
  p.rowY.resize(static_cast<std::size_t>(p.height) + 1);
  for (int y = 0; y <= p.height; ++y) p.rowY[y] = std::cos(kPi * y / p.height);
  p.columns.resize(static_cast<std::size_t>(p.width) * p.height);
  base::parallelFor(p.width, 16, [&](std::size_t begin, std::size_t end) {
    for (int y = 0; y < p.height; ++y)
      for (std::size_t x = begin; x < end; ++x) {
        glm::vec3& texel = p.columns[x * p.height + y];
        if (grows) {
          texel = bilinearAt(image, (x + 0.5) / growX, (y + 0.5) / growY);
          continue;
        }
        glm::dvec3 sum{0.0};
        double area = 0;
        for (int sy = y * shrinkY; sy < (y + 1) * shrinkY; ++sy) {
          const double height = std::cos(kPi * sy / image.height) - std::cos(kPi * (sy + 1) / image.height);
          for (int sx = 0; sx < shrinkX; ++sx)
            sum += height * glm::dvec3(texelAt(image, static_cast<int>(x) * shrinkX + sx, sy));
          area += height * shrinkX;
        }
        texel = glm::vec3(sum / area);
      }
  });
  return p;
}

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
    visit(p.azimuthAt(begin), (next - begin) / p.width * 2 * kPi, p.column(static_cast<long long>(std::floor(begin))));
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
      p, quarter * kPi / 2, (quarter + 1) * kPi / 2, [&](double azimuth, double width, const glm::vec3* column) {
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

double panoramaAzimuth(double a, float rotationDeg) {
  // A turn by +r about +Y takes azimuth a to a - r, so what is seen at a stood at a + r.
  return a + static_cast<double>(rotationDeg) * kPi / 180;
}

std::vector<glm::vec4> resampleEquirect(const scenes::Environment& environment, int n) {
  checkRadiance(environment);
  const Panorama panorama = makePanorama(environment, n);
  std::vector<glm::vec4> base(texelIndex(kCubeFaces, 0, 0, n));

  struct Side {
    int face;
    double azimuth; // atan2(z, x) of its middle
  };
  constexpr Side kSides[] = {{0, 0.0}, {1, kPi}, {4, kPi / 2}, {5, -kPi / 2}};
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

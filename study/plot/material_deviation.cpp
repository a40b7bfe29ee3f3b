#include "study/plot/material_deviation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "lighting/surface/texture_read.h"
#include "shading/shading.h"

namespace parity::plot {

namespace f64 = shading::f64;

namespace {

constexpr int kPoints = 256, kCosines = 64;

bool isTextured(const scenes::Material& m) {
  return std::ranges::any_of(
      std::initializer_list<const scenes::TextureSlot*>{&m.baseColorTexture, &m.metallicRoughnessTexture,
                                                        &m.specularTexture, &m.specularColorTexture},
      [](const scenes::TextureSlot* slot) { return slot->present(); });
}

glm::dvec3 linearOf(const glm::dvec4& texel) {
  return {f64::srgbToLinear(texel.x), f64::srgbToLinear(texel.y), f64::srgbToLinear(texel.z)};
}

// As gpu/shaders/path.glsl resolves it. mesh: null where the factors alone are wanted.
paths::EnvBrdfMaterial resolve(const scenes::Scene& scene, const scenes::Material& m, const scenes::Mesh* mesh,
                               const lighting::TrianglePoint& point) {
  const auto read = [&](const scenes::TextureSlot& slot) -> std::optional<glm::dvec4> {
    if (!mesh || !slot.present()) return std::nullopt;
    return lighting::readTexture(scene, *mesh, slot, point);
  };
  glm::dvec3 base(m.baseColor.x, m.baseColor.y, m.baseColor.z);
  if (mesh && !mesh->colors.empty()) {
    glm::dvec3 color(0);
    for (std::size_t k = 0; k < 3; ++k) color += point.weights[k] * glm::dvec3(mesh->colors[point.vertices[k]]);
    base *= color;
  }
  if (const auto texel = read(m.baseColorTexture)) base *= linearOf(*texel);
  double metallic = m.metallic, roughness = m.roughness;
  if (const auto texel = read(m.metallicRoughnessTexture)) metallic *= texel->z, roughness *= texel->y;
  const double index = (m.ior - 1.0) / (m.ior + 1.0);
  glm::dvec3 dielectric = index * index * glm::dvec3(m.specularColor);
  if (const auto texel = read(m.specularColorTexture)) dielectric *= linearOf(*texel);
  double F90 = m.specular;
  if (const auto texel = read(m.specularTexture)) F90 *= texel->w;
  dielectric = glm::min(dielectric, glm::dvec3(1)) * F90;
  return {.baseColor = base,
          .metallic = metallic,
          .roughness = std::clamp(roughness, 0.0, 1.0),
          .dielectric = dielectric,
          .dielectricF90 = F90,
          .nonmetal = m.isNonmetal() && !m.fullyRough,
          .fullyRough = m.fullyRough};
}

// Where a material lies: triangles of instances, with their areas summed up.
struct Surfaces {
  struct Triangle {
    const scenes::Mesh* mesh;
    std::size_t first; // of its indices
  };
  std::vector<Triangle> triangles;
  std::vector<double> areaUpTo;
};

Surfaces surfacesOf(const scenes::Scene& scene, std::size_t material) {
  Surfaces surfaces;
  double area = 0;
  for (const scenes::Instance& instance : scene.instances) {
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.material != material) continue;
    const auto corner = [&](std::size_t i) {
      return glm::dvec3(instance.toWorld * glm::vec4(mesh.positions[mesh.indices[i]], 1));
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      area += 0.5 * glm::length(glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i)));
      surfaces.triangles.push_back({&mesh, i});
      surfaces.areaUpTo.push_back(area);
    }
  }
  return surfaces;
}

// The k-th point: the R sequence of three dimensions (Roberts 2018) over area and triangle.
std::pair<const scenes::Mesh*, lighting::TrianglePoint> pointOf(const Surfaces& surfaces, int k) {
  const auto coordinate = [&](double step) { return std::fmod(0.5 + (k + 1) * step, 1.0); };
  const double area = coordinate(0.8191725133961645) * surfaces.areaUpTo.back();
  const auto found = std::ranges::upper_bound(surfaces.areaUpTo, area);
  const auto index =
      std::min<std::size_t>(static_cast<std::size_t>(found - surfaces.areaUpTo.begin()), surfaces.triangles.size() - 1);
  const Surfaces::Triangle& triangle = surfaces.triangles[index];
  const double root = std::sqrt(coordinate(0.6710436067037893)), v = coordinate(0.5497004779019703);
  lighting::TrianglePoint point;
  for (std::size_t c = 0; c < 3; ++c) point.vertices[c] = triangle.mesh->indices[triangle.first + c];
  point.weights = {1 - root, root * (1 - v), root * v};
  return {triangle.mesh, point};
}

MaterialDeviation measure(const std::string& name, const std::vector<paths::EnvBrdfMaterial>& points,
                          const PlottedPair& pair) {
  const paths::EnvBrdf &reference = *pair.reference.brdf, &test = *pair.test.brdf;
  MaterialDeviation d;
  d.name = name;
  d.points = points.size();
  d.form = test.form(points.front());
  d.least = 1;
  for (const paths::EnvBrdfMaterial& r : points) {
    const double share = 1.0 / static_cast<double>(points.size());
    d.roughness += r.roughness * share;
    d.least = std::min(d.least, r.roughness);
    d.greatest = std::max(d.greatest, r.roughness);
    d.F0 += r.F0() * share;
    for (int i = 0; i < kCosines; ++i) {
      const double NoV = (i + 0.5) / kCosines, weight = share * 2 * NoV / kCosines;
      const glm::dvec3 error = test.once(r, NoV) - reference.once(r, NoV);
      const glm::dvec3 referenceMore = reference.multiple(r, NoV), testMore = test.multiple(r, NoV);
      for (int c = 0; c < 3; ++c) {
        d.mean += weight * std::abs(error[c]) / 3;
        d.bias += weight * error[c] / 3;
        d.referenceMultiple += weight * referenceMore[c] / 3;
        d.testMultiple += weight * testMore[c] / 3;
        if (NoV >= 0.05 && std::abs(error[c]) > d.max) d.max = std::abs(error[c]), d.NoVOfMax = NoV;
      }
    }
  }
  return d;
}

} // namespace

std::vector<MaterialDeviation> deviationsOf(const scenes::Scene& scene, const PlottedPair& pair) {
  std::vector<MaterialDeviation> all;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const scenes::Material& material = scene.materials[m];
    if (material.unlit) continue;
    const Surfaces surfaces = surfacesOf(scene, m);
    const bool hasColors =
        std::ranges::any_of(surfaces.triangles, [](const auto& t) { return !t.mesh->colors.empty(); });
    std::vector<paths::EnvBrdfMaterial> points;
    if (!surfaces.triangles.empty() && surfaces.areaUpTo.back() > 0 && (isTextured(material) || hasColors))
      for (int k = 0; k < kPoints; ++k) {
        const auto [mesh, point] = pointOf(surfaces, k);
        points.push_back(resolve(scene, material, mesh, point));
      }
    else
      points.push_back(resolve(scene, material, nullptr, {}));
    all.push_back(measure(material.name, points, pair));
  }
  return all;
}

} // namespace parity::plot

// Layouts of all meshes, by the scales of their instances, and where each instance's block goes.
#include "bake/atlas.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "bake/mesh_layout.h"
#include "bake/packing.h"
#include "base/error.h"
#include "base/image.h"
#include "base/parallel.h"

namespace parity::bake {
namespace {

constexpr double kScaleRange = 2; // of the instances that share a layout

// How much a transform stretches at most: the largest singular value, by the closed form of the eigenvalues of M^T M
// (O. K. Smith, "Eigenvalues of a symmetric 3 x 3 matrix", 1961).
double largestScale(const glm::mat4& toWorld) {
  const glm::dmat3 m(toWorld);
  const glm::dmat3 a = glm::transpose(m) * m;
  const double mean = (a[0][0] + a[1][1] + a[2][2]) / 3;
  const glm::dmat3 b = a - glm::dmat3(mean);
  double spread = 0;
  for (int i = 0; i < 3; ++i) spread += glm::dot(b[i], b[i]);
  spread = std::sqrt(spread / 6);
  if (!(spread > 0)) return std::sqrt(mean);
  const double angle = std::acos(std::clamp(glm::determinant(b) / (2 * spread * spread * spread), -1.0, 1.0)) / 3;
  return std::sqrt(std::max(0.0, mean + 2 * spread * std::cos(angle)));
}

// A mesh at one scale, and who shows it.
struct Use {
  std::uint32_t mesh = 0;
  double scale = 0; // the largest of its instances'
  std::vector<std::uint32_t> instances;
};

// By mesh, then the largest scale first.
std::vector<Use> usesOf(const scenes::Scene& scene) {
  std::vector<double> scales;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const scenes::Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    scales.push_back(largestScale(scene.instances[i].toWorld));
    if (!std::isfinite(scales.back()))
      throw base::fileError(mesh.name, scene.instances[i].node, "its transform is not finite: no lightmap");
    if (!scene.materials[mesh.material].unlit && scales.back() > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t meshA = scene.instances[a].mesh, meshB = scene.instances[b].mesh;
    return meshA != meshB ? meshA < meshB : scales[a] > scales[b];
  });
  std::vector<Use> uses;
  for (const std::uint32_t i : order) {
    const std::uint32_t mesh = scene.instances[i].mesh;
    // The slack keeps instances of one scale together whose rotations round differently.
    if (uses.empty() || uses.back().mesh != mesh || scales[i] * kScaleRange < uses.back().scale * (1 - 1e-5))
      uses.push_back({mesh, scales[i], {}});
    uses.back().instances.push_back(i);
  }
  return uses;
}

void checkOptions(const AtlasOptions& options) {
  const auto refuse = [](const char* option, const char* reason) {
    throw base::Error(base::ExitCode::usage, option, "", reason);
  };
  if (!(options.texelsPerMetre > 0 && std::isfinite(options.texelsPerMetre)))
    refuse("--texels-per-metre", "must be above 0");
  if (options.maxPageSide < 4 || options.maxPageSide % 4 != 0 || options.maxPageSide > base::kMaxImageSide)
    refuse("the largest lightmap page", "must have a side that is a multiple of 4, from 4 to 16384 texels");
  if (options.padding < 0 || options.padding > 64) refuse("the padding of a lightmap", "must be 0 to 64 texels");
}

[[noreturn]] void throwTooMany(const scenes::Scene& scene, double texels) {
  throw base::fileError(scene.name, "",
                        fmt::format("its lightmap needs {:.0f} million texels, and {:.0f} million is the most: lower "
                                    "--texels-per-metre",
                                    std::ceil(texels / 1e6), static_cast<double>(kMaxTexels) / 1e6));
}

std::string noteOf(const scenes::Mesh& mesh, const Use& use, const MeshLayout& layout, bool isOnly) {
  const std::string name = mesh.name.empty() ? fmt::format("mesh {}", use.mesh) : mesh.name;
  return fmt::format("{}{}: {}", name, isOnly ? "" : fmt::format(" at scale {:.3g}", use.scale), layout.note);
}

} // namespace

Atlas makeAtlas(const scenes::Scene& scene, const AtlasOptions& options) {
  checkOptions(options);
  const std::vector<Use> uses = usesOf(scene);
  std::vector<MeshLayout> layouts(uses.size());
  std::vector<std::function<void()>> tasks; // of several refusals the first is thrown
  for (std::size_t i = 0; i < uses.size(); ++i)
    tasks.emplace_back([&, i] {
      layouts[i] = layOutMesh(scene.meshes[uses[i].mesh],
                              {options.texelsPerMetre * uses[i].scale, options.padding, options.maxPageSide});
    });
  base::parallelInvoke(tasks);

  Atlas atlas;
  atlas.uvs.places.resize(scene.instances.size());
  std::vector<glm::ivec2> sizes; // of the instances' blocks
  std::vector<std::uint32_t> owners;
  std::size_t corners = 0;
  double texels = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const bool isOnly =
        (i == 0 || uses[i - 1].mesh != uses[i].mesh) && (i + 1 == uses.size() || uses[i + 1].mesh != uses[i].mesh);
    atlas.notes.push_back(noteOf(scene.meshes[uses[i].mesh], uses[i], layouts[i], isOnly));
    if (layouts[i].size.x == 0) continue;
    for (const std::uint32_t instance : uses[i].instances) {
      atlas.uvs.places[instance].firstCorner = static_cast<std::uint32_t>(corners);
      sizes.push_back(layouts[i].size);
      owners.push_back(instance);
      texels += static_cast<double>(layouts[i].size.x) * layouts[i].size.y;
    }
    corners += layouts[i].corners.size();
  }
  if (sizes.empty()) throw base::fileError(scene.name, "", "has nothing to bake: no object is lit and has an area");
  if (texels > static_cast<double>(kMaxTexels)) throwTooMany(scene, texels);
  if (corners > std::numeric_limits<std::uint32_t>::max())
    throw base::fileError(scene.name, "", "has too many triangles for a lightmap");

  const Packing packing = packPages(sizes, options.maxPageSide);
  atlas.pageSide = packing.width;
  atlas.pageCount = packing.pages;
  const double pages = packing.pages;
  if (pages * atlas.pageSide * atlas.pageSide > static_cast<double>(kMaxTexels))
    throwTooMany(scene, pages * atlas.pageSide * atlas.pageSide);
  const auto side = static_cast<float>(atlas.pageSide);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    atlas.uvs.places[owners[i]].page = packing.page[i];
    atlas.uvs.places[owners[i]].offset = glm::vec2(packing.corners[i]) / side;
  }
  atlas.uvs.corners.reserve(corners);
  for (MeshLayout& layout : layouts) {
    for (const glm::vec2& corner : layout.corners) atlas.uvs.corners.push_back(corner / side);
    layout.corners = {};
  }
  return atlas;
}

} // namespace parity::bake

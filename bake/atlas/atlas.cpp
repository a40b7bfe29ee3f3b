// Layouts of all meshes, by the scales of their instances, and where each instance's block goes.
#include "bake/atlas/atlas.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/atlas/mesh_layout.h"
#include "bake/atlas/packing.h"
#include "base/error.h"
#include "base/image/image.h"
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
      throw base::fileError(mesh.name, scene.instances[i].node, "its transform is not finite, so it gets no lightmap");
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

[[noreturn]] void throwTooMany(const scenes::Scene& scene, double texels, std::size_t pieces, int padding) {
  const double smallest = static_cast<double>(pieces) * (1 + padding) * (1 + padding); // a texel each
  throw base::fileError(
      scene.name, "",
      fmt::format("its lightmap needs {:.0f} million texels, expected at most {:.0f} million; {}",
                  std::ceil(texels / 1e6), static_cast<double>(kMaxTexels) / 1e6,
                  smallest < static_cast<double>(kMaxTexels)
                      ? "lower --texels-per-metre"
                      : fmt::format("its {} charts are too many for any --texels-per-metre", pieces)));
}

void addCorners(const scenes::Scene& scene, const std::vector<Use>& uses, std::vector<MeshLayout>& layouts,
                Atlas& atlas) {
  std::size_t count = 0;
  for (const MeshLayout& layout : layouts) count += layout.corners.size();
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw base::fileError(scene.name, "", "has too many triangles for a lightmap");
  atlas.uvs.corners.reserve(count);
  const auto side = static_cast<float>(atlas.pageSide);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    for (const std::uint32_t instance : uses[i].instances)
      atlas.uvs.places[instance].firstCorner = static_cast<std::uint32_t>(atlas.uvs.corners.size());
    for (const glm::vec2& corner : layouts[i].corners) atlas.uvs.corners.push_back(corner / side);
    layouts[i] = {{}, {}, layouts[i].charts, std::move(layouts[i].note)};
  }
}

void addNotes(const scenes::Scene& scene, const std::vector<Use>& uses, const std::vector<MeshLayout>& layouts,
              Atlas& atlas) {
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const std::string& name = scene.meshes[uses[i].mesh].name;
    const bool isOnly =
        (i == 0 || uses[i - 1].mesh != uses[i].mesh) && (i + 1 == uses.size() || uses[i + 1].mesh != uses[i].mesh);
    atlas.notes.push_back(fmt::format("{}{}: {}", name.empty() ? fmt::format("mesh {}", uses[i].mesh) : name,
                                      isOnly ? "" : fmt::format(" at scale {:.3g}", uses[i].scale), layouts[i].note));
  }
}

// What is placed on a page: a piece of a layout for one instance.
struct Item {
  std::uint32_t use = 0, piece = 0, instance = 0;
};

struct Items {
  std::vector<Item> items;
  std::vector<Rectangle> rectangles;
  double texels = 0;
};

Items itemsOf(const std::vector<Use>& uses, const std::vector<MeshLayout>& layouts) {
  Items result;
  for (std::uint32_t use = 0; use < uses.size(); ++use)
    for (const std::uint32_t instance : uses[use].instances)
      for (std::uint32_t piece = 0; piece < layouts[use].pieces.size(); ++piece) {
        const Rectangle rectangle = layouts[use].pieces[piece].rectangle();
        result.items.push_back({use, piece, instance});
        result.rectangles.push_back(rectangle);
        result.texels += static_cast<double>(rectangle.size.x) * rectangle.size.y;
      }
  return result;
}

// Of several refusals the first is thrown.
void forEachUse(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < count; ++i) tasks.emplace_back([&body, i] { body(i); });
  base::parallelInvoke(tasks);
}

} // namespace

Atlas makeAtlas(const scenes::Scene& scene, const AtlasOptions& options) {
  checkOptions(options);
  const std::vector<Use> uses = usesOf(scene);
  std::vector<MeshLayout> layouts(uses.size());
  const auto join = [&](std::size_t i) { joinPieces(scene.meshes[uses[i].mesh], options.maxPageSide, layouts[i]); };
  forEachUse(uses.size(), [&](std::size_t i) {
    layouts[i] = layOutMesh(scene.meshes[uses[i].mesh],
                            {options.texelsPerMetre * uses[i].scale, options.padding, options.maxPageSide});
    if (uses[i].instances.size() > 1) join(i); // they share the corners: only as a whole can each be moved
  });

  Items items = itemsOf(uses, layouts);
  if (items.items.empty()) throw base::fileError(scene.name, "", "has nothing to bake: no lit object has an area");
  // On one page the pieces of all objects may lie between each other; of several, an object has only one.
  std::optional<Packing> packing = packPage(items.rectangles, options.maxPageSide);
  if (!packing) {
    if (items.texels > static_cast<double>(kMaxTexels))
      throwTooMany(scene, items.texels, items.items.size(), options.padding);
    forEachUse(uses.size(), join);
    items = itemsOf(uses, layouts);
    packing = packPages(items.rectangles, options.maxPageSide);
  }
  const double side = packing->width, texels = packing->pages * side * side;
  if (texels > static_cast<double>(kMaxTexels)) throwTooMany(scene, texels, items.items.size(), options.padding);

  Atlas atlas;
  atlas.pageSide = packing->width;
  atlas.pageCount = packing->pages;
  atlas.uvs.places.resize(scene.instances.size());
  for (std::size_t i = 0; i < items.items.size(); ++i) {
    const Item& item = items.items[i];
    scenes::LightmapUvs::Place& place = atlas.uvs.places[item.instance];
    place.page = packing->page[i];
    if (uses[item.use].instances.size() > 1)
      place.offset = glm::vec2(packing->corners[i]) / static_cast<float>(side);
    else
      movePiece(layouts[item.use], item.piece, packing->corners[i]);
  }
  addCorners(scene, uses, layouts, atlas);
  addNotes(scene, uses, layouts, atlas);
  return atlas;
}

} // namespace parity::bake

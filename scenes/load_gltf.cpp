// A glTF file -> a Scene: the order of the steps, and what binds them.
#include "scenes/load_gltf.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/parallel.h"
#include "scenes/gltf_document.h"
#include "scenes/gltf_image.h"
#include "scenes/gltf_light_camera.h"
#include "scenes/gltf_material.h"
#include "scenes/gltf_mesh.h"
#include "scenes/gltf_nodes.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxInstances = std::size_t{1} << 20;
constexpr std::size_t kMaxTriangles = std::size_t{1} << 27; // drawn, over all instances
constexpr std::size_t kMaxWarnings = 100;

// A primitive that some node shows.
struct UsedPrimitive {
  int mesh = 0, primitive = 0;
  std::uint32_t material = 0;
};

// The primitives of all meshes that are shown, in the order of the file, within the limits.
std::vector<UsedPrimitive> listPrimitives(const GltfDocument& document, const std::vector<PlacedNode>& nodes) {
  std::vector<bool> shown(document.model.meshes.size());
  std::size_t instances = 0;
  for (const PlacedNode& node : nodes)
    if (const int mesh = document.model.nodes[static_cast<std::size_t>(node.node)].mesh; mesh >= 0) {
      shown[static_cast<std::size_t>(mesh)] = true;
      instances += document.model.meshes[static_cast<std::size_t>(mesh)].primitives.size();
      if (instances > kMaxInstances)
        throw document.error("nodes", fmt::format("place more than {} primitives", kMaxInstances));
    }
  std::vector<UsedPrimitive> used;
  std::size_t bytes = 0;
  for (std::size_t m = 0; m < shown.size(); ++m) {
    const auto& primitives = document.model.meshes[m].primitives;
    for (std::size_t p = 0; shown[m] && p < primitives.size(); ++p) {
      used.push_back({static_cast<int>(m), static_cast<int>(p),
                      primitives[p].material < 0 ? static_cast<std::uint32_t>(document.model.materials.size())
                                                 : static_cast<std::uint32_t>(primitives[p].material)});
      bytes += estimateBytes(document, static_cast<int>(m), static_cast<int>(p));
      if (bytes > kMaxMeshBytes)
        throw document.error(fmt::format("meshes[{}]", m),
                             fmt::format("the meshes take more than {} MiB", kMaxMeshBytes >> 20));
    }
  }
  return used;
}

template <typename Body> void forEachSlot(Material& material, const Body& body) {
  for (TextureSlot* slot : {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
                            &material.occlusionTexture, &material.emissiveTexture, &material.specularTexture,
                            &material.specularColorTexture})
    if (slot->present()) body(*slot);
}

// Renumbers the slots to the images that are used, and returns those, as indices into document.images.
std::vector<int> collectImages(std::vector<Material>& materials) {
  std::vector<int> used;
  for (Material& material : materials)
    forEachSlot(material, [&](const TextureSlot& slot) { used.push_back(slot.image); });
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (Material& material : materials)
    forEachSlot(material, [&](TextureSlot& slot) {
      slot.image = static_cast<int>(std::lower_bound(used.begin(), used.end(), slot.image) - used.begin());
    });
  return used;
}

// The images of materials that some primitive shows; the others keep their places, without pixels.
std::vector<SourceFile> readImages(const GltfDocument& document, const std::vector<UsedPrimitive>& primitives,
                                   const std::vector<int>& images, Scene& scene) {
  std::vector<bool> isShown(scene.materials.size()), isRead(images.size());
  for (const UsedPrimitive& used : primitives) isShown[used.material] = true;
  for (std::size_t m = 0; m < isShown.size(); ++m)
    if (isShown[m])
      forEachSlot(scene.materials[m],
                  [&](const TextureSlot& slot) { isRead[static_cast<std::size_t>(slot.image)] = true; });
  std::vector<int> read;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (isRead[i]) read.push_back(images[i]);
  DecodedImages decoded = decodeImages(document, read);
  for (std::size_t i = 0, next = 0; i < images.size(); ++i)
    if (isRead[i])
      scene.images.push_back(std::move(decoded.images[next++]));
    else
      scene.images.push_back({document.images[static_cast<std::size_t>(images[i])].name, {}});
  return std::move(decoded.sources);
}

// Lights, cameras and instances of all nodes. meshesOf: the scene's meshes that stand for a mesh of the file.
void placeAll(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
              const std::map<int, std::vector<std::uint32_t>>& meshesOf, Scene& scene) {
  UniqueNames cameraNames;
  std::size_t triangles = 0;
  for (const PlacedNode& node : nodes) {
    if (auto light = readLight(document, node, scene.warnings)) scene.lights.push_back(std::move(*light));
    if (auto camera = readCamera(document, node)) {
      camera->name = cameraNames.make(camera->name, fmt::format("camera {}", scene.cameras.size()));
      scene.cameras.push_back(std::move(*camera));
    }
    const auto meshes = meshesOf.find(document.model.nodes[static_cast<std::size_t>(node.node)].mesh);
    if (meshes == meshesOf.end()) continue;
    if (glm::determinant(glm::dmat3(node.toWorld)) == 0) {
      scene.warnings.push_back(fmt::format("nodes[{}] '{}': a scale of 0, not shown", node.node, node.path));
      continue;
    }
    for (const std::uint32_t mesh : meshes->second) {
      scene.instances.push_back({mesh, glm::mat4(node.toWorld), node.path});
      triangles += scene.meshes[mesh].indices.size() / 3;
      if (triangles > kMaxTriangles)
        throw document.error("nodes", fmt::format("place more than {} triangles", kMaxTriangles));
    }
  }
}

} // namespace

Scene loadGltf(const std::string& file) {
  const GltfDocument document = readGltfDocument(file);
  Scene scene;
  scene.file = file;
  scene.name = cleanName(scene.file.stem().string());
  scene.warnings = document.warnings;

  const std::vector<PlacedNode> nodes = placeNodes(document, scene.warnings);
  const std::vector<UsedPrimitive> primitives = listPrimitives(document, nodes);
  const bool needsDefault = std::any_of(primitives.begin(), primitives.end(), [&](const UsedPrimitive& used) {
    return used.material == document.model.materials.size();
  });
  scene.materials = readMaterials(document, needsDefault, scene.warnings);

  const std::vector<int> images = collectImages(scene.materials);
  std::vector<GltfPrimitive> built(primitives.size());
  const auto buildMeshes = [&] {
    base::parallelFor(primitives.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const UsedPrimitive& used = primitives[i];
        built[i] = buildPrimitive(document, used.mesh, used.primitive, used.material, scene.materials[used.material]);
      }
    });
  };
  std::vector<SourceFile> imageFiles;
  base::parallelInvoke({buildMeshes, [&] { imageFiles = readImages(document, primitives, images, scene); }});
  scene.sources = document.sources;
  scene.sources.insert(scene.sources.end(), imageFiles.begin(), imageFiles.end());

  std::map<int, std::vector<std::uint32_t>> meshesOf;
  for (std::size_t i = 0; i < built.size(); ++i) {
    scene.warnings.insert(scene.warnings.end(), built[i].warnings.begin(), built[i].warnings.end());
    if (!built[i].mesh) continue;
    meshesOf[primitives[i].mesh].push_back(static_cast<std::uint32_t>(scene.meshes.size()));
    scene.meshes.push_back(std::move(*built[i].mesh));
  }
  placeAll(document, nodes, meshesOf, scene);

  if (scene.warnings.size() > kMaxWarnings) {
    const std::size_t more = scene.warnings.size() - kMaxWarnings;
    scene.warnings.resize(kMaxWarnings);
    scene.warnings.push_back(fmt::format("{} more warnings", more));
  }
  if (scene.instances.empty()) throw document.error("", "the scene is empty: no triangle is placed in it");
  return scene;
}

} // namespace parity::scenes

// A glTF file -> a Scene: the order of the steps, and what binds them.
#include "scenes/gltf/load_gltf.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/parallel.h"
#include "scenes/gltf/animation.h"
#include "scenes/gltf/file/document.h"
#include "scenes/gltf/file/uses.h"
#include "scenes/gltf/instancing.h"
#include "scenes/gltf/light_camera.h"
#include "scenes/gltf/material.h"
#include "scenes/gltf/mesh.h"
#include "scenes/gltf/nodes.h"
#include "scenes/gltf/scene_images.h"
#include "scenes/gltf/variants.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxInstances = std::size_t{1} << 20;
constexpr std::size_t kMaxTriangles = std::size_t{1} << 27; // drawn, over all instances
constexpr std::size_t kMaxWarnings = 100;

// A primitive that some node shows.
struct UsedPrimitive {
  std::size_t use = 0; // in MeshUses
  int mesh = 0, primitive = 0;
  std::uint32_t material = 0;
};

// The primitives of all meshes that are shown, in the order of the file, each for every pose that it is shown in; their
// memory is counted.
std::vector<UsedPrimitive> listPrimitives(const GltfDocument& document, const MeshUses& meshes, Problems& problems,
                                          std::vector<std::string>& warnings) {
  const std::optional<int> variant = chooseVariant(document);
  std::vector<UsedPrimitive> used;
  for (std::size_t u = 0; u < meshes.uses.size(); ++u) {
    const int m = meshes.uses[u].mesh;
    const auto& primitives = document.model.meshes[static_cast<std::size_t>(m)].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::string place = fmt::format("/meshes/{}/primitives/{}", m, p);
      if (!primitives[p].attributes.contains("POSITION")) { // glTF 2.0, 3.7.2.1: to be skipped
        warnings.push_back(place + ": has no POSITION, not drawn");
        continue;
      }
      if (used.size() == kMaxInstances) {
        problems.add("/nodes", fmt::format("place more than {} primitives", kMaxInstances));
        return used;
      }
      const int material = materialOf(primitives[p], variant);
      used.push_back({u, m, static_cast<int>(p),
                      material < 0 ? static_cast<std::uint32_t>(document.model.materials.size())
                                   : static_cast<std::uint32_t>(material)});
      problems.attempt([&] { document.memory.take(estimateBytes(document, m, static_cast<int>(p)), place); });
    }
  }
  return used;
}

// The materials that some primitive shows, or all where the options ask for it.
std::vector<bool> listShown(const GltfDocument& document, const std::vector<UsedPrimitive>& primitives,
                            std::size_t materials) {
  std::vector<bool> isShown(materials, document.options.allMaterials);
  for (const UsedPrimitive& used : primitives) isShown[used.material] = true;
  return isShown;
}

// The scene's mesh that stands for a primitive in one pose.
struct BuiltMesh {
  std::uint32_t mesh = 0;
  bool isSkinned = false;
};

// Beyond it a coordinate is nobody's scene, and Embree's arithmetic ends.
constexpr double kMaxCoordinate = 1e18; // metres

// The corners of what a mesh's triangles use.
Bounds boundsOf(const Mesh& mesh) {
  Bounds bounds{mesh.positions[mesh.indices[0]], mesh.positions[mesh.indices[0]]};
  for (const std::uint32_t index : mesh.indices) {
    bounds.lower = glm::min(bounds.lower, mesh.positions[index]);
    bounds.upper = glm::max(bounds.upper, mesh.positions[index]);
  }
  return bounds;
}

// Whether a transform leaves nothing of an area: it has a rank below 2.
bool flattensAll(const glm::dmat4& m) {
  const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
  return glm::cross(x, y) == glm::dvec3(0) && glm::cross(y, z) == glm::dvec3(0) && glm::cross(z, x) == glm::dvec3(0);
}

// Puts meshes into the world, within the limits.
class Placer {
public:
  Placer(const GltfDocument& document, Scene& scene) : m_document(document), m_scene(scene) {
    for (const Mesh& mesh : scene.meshes) m_bounds.push_back(boundsOf(mesh));
  }

  // meshes: those that the node shows. Throws Error (exit 4); nothing is placed after a limit was reached.
  void place(const PlacedNode& node, const std::vector<BuiltMesh>& meshes) {
    if (meshes.empty() || m_isFull) return;
    m_instances += instanceCount(m_document, node.node);
    if (m_instances > kMaxInstances) throw full("primitives", kMaxInstances);
    const std::vector<glm::dmat4> instances = readInstances(m_document, node.node);
    std::size_t flat = 0;
    for (const glm::dmat4& instance : instances) {
      const glm::dmat4 toWorld = node.toWorld * instance;
      const bool isFlat = flattensAll(toWorld);
      for (const BuiltMesh& built : meshes) {
        flat += isFlat && !built.isSkinned;
        if (!built.isSkinned && !isFlat) add(built.mesh, toWorld, node);
      }
    }
    bool isSkinned = false;
    for (const BuiltMesh& built : meshes)
      if (built.isSkinned) {
        add(built.mesh, glm::dmat4(1.0), node); // where its joints are
        isSkinned = true;
      }
    if (isSkinned && isInstanced(m_document, node.node))
      m_scene.warnings.push_back(fmt::format("/nodes/{} '{}': EXT_mesh_gpu_instancing does not move a skinned mesh, "
                                             "so it is shown once, at its joints",
                                             node.node, node.path));
    if (flat)
      m_scene.warnings.push_back(fmt::format("/nodes/{} '{}': has a scale of 0, not shown", node.node, node.path));
  }

private:
  base::Error full(const char* what, std::size_t limit) {
    m_isFull = true;
    return m_document.error("/nodes", fmt::format("place more than {} {}", limit, what));
  }

  void add(std::uint32_t mesh, const glm::dmat4& toWorld, const PlacedNode& node) {
    for (int corner = 0; corner < 8; ++corner) {
      const Bounds& b = m_bounds[mesh];
      const glm::dvec4 p(corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y,
                         corner & 4 ? b.upper.z : b.lower.z, 1);
      const glm::dvec3 placed = glm::abs(glm::dvec3(toWorld * p));
      if (!(std::max({placed.x, placed.y, placed.z}) <= kMaxCoordinate)) // NaN too
        throw m_document.error(
            fmt::format("/nodes/{}", node.node),
            fmt::format("places '{}' farther than {:g} m, or at NaN", m_scene.meshes[mesh].name, kMaxCoordinate));
    }
    m_document.memory.take(sizeof(Instance) + node.path.size(), "/nodes");
    m_scene.instances.push_back({mesh, glm::mat4(toWorld), node.path});
    m_triangles += m_scene.meshes[mesh].indices.size() / 3;
    if (m_scene.instances.size() > kMaxInstances) throw full("primitives", kMaxInstances);
    if (m_triangles > kMaxTriangles) throw full("triangles", kMaxTriangles);
  }

  const GltfDocument& m_document;
  Scene& m_scene;
  std::vector<Bounds> m_bounds; // of the scene's meshes
  std::size_t m_instances = 0, m_triangles = 0;
  bool m_isFull = false;
};

// Lights, cameras and instances of the nodes shown. meshesOf: for each of `uses` the scene's meshes.
void placeAll(const GltfDocument& document, std::span<const PlacedNode> shown, const MeshUses& uses,
              const std::vector<std::vector<BuiltMesh>>& meshesOf, Scene& scene, Problems& problems) {
  UniqueNames cameraNames;
  Placer placer(document, scene);
  for (std::size_t place = 0; place < shown.size(); ++place)
    problems.attempt([&] {
      const PlacedNode& node = shown[place];
      if (auto light = readLight(document, node, scene.warnings)) scene.lights.push_back(std::move(*light));
      if (auto camera = readCamera(document, node, scene.warnings)) {
        camera->name = cameraNames.make(camera->name, fmt::format("camera {}", scene.cameras.size()));
        scene.cameras.push_back(std::move(*camera));
      }
      if (uses.ofNode[place] != MeshUses::kNone) placer.place(node, meshesOf[uses.ofNode[place]]);
    });
}

void dropRepeated(std::vector<std::string>& lines) {
  std::set<std::string> known;
  std::erase_if(lines, [&](const std::string& line) { return !known.insert(line).second; });
}

// Why no triangle is placed, in words.
std::string whyEmpty(const GltfDocument& document, const NodeList& list, const MeshUses& uses,
                     const std::vector<std::string>& warnings) {
  if (document.model.meshes.empty()) return "the file has no mesh";
  if (list.shown == 0) return "it has no nodes";
  if (uses.uses.empty()) return "none of its nodes has a mesh";
  // All that it has was left out, each with a warning.
  constexpr std::size_t kMostNamed = 3;
  std::vector<std::string> reasons;
  for (const std::string& warning : warnings)
    if (warning.ends_with("not drawn") || warning.ends_with("not shown")) reasons.push_back(warning);
  dropRepeated(reasons);
  if (reasons.empty()) return warnings.empty() ? "no object has a triangle" : warnings.back();
  const std::size_t more = reasons.size() - std::min(reasons.size(), kMostNamed);
  reasons.resize(reasons.size() - more);
  return fmt::format("every object is ignored: {}{}", fmt::join(reasons, "; "),
                     more > 0 ? fmt::format("; and {} more", more) : "");
}

} // namespace

Scene loadGltf(const std::string& file, const LoadOptions& options) {
  if (!std::isfinite(options.timeSeconds))
    throw base::Error(base::ExitCode::usage, "--time", "", "is not a finite number of seconds");
  const std::unique_ptr<GltfDocument> read = readGltfDocument(file, options);
  const GltfDocument& document = *read;
  Scene scene;
  scene.file = file;
  scene.name = cleanName(scene.file.stem().string());
  scene.warnings = document.warnings;
  scene.facts = document.facts;
  scene.facts.animationSeconds = animationLengths(document);

  Problems problems(file);
  const NodeList list = listNodes(document, scene.warnings);
  const auto isNeeded = [&](int node) { return list.placeOf[static_cast<std::size_t>(node)] != NodeList::kNone; };
  const Pose pose = poseAt(document, isNeeded, problems, scene.warnings);
  problems.throwIfAny(); // a node of no transform places nothing
  const std::vector<PlacedNode> nodes = placeNodes(document, list, pose, problems);
  problems.throwIfAny(); // as above
  const MeshUses uses = listMeshUses(document, list, nodes, pose, problems);
  const std::vector<UsedPrimitive> primitives = listPrimitives(document, uses, problems, scene.warnings);
  const bool needsDefault = std::any_of(primitives.begin(), primitives.end(), [&](const UsedPrimitive& used) {
    return used.material == document.model.materials.size();
  });
  GltfMaterials materials = readMaterials(document, needsDefault, problems, scene.warnings);
  scene.materials = std::move(materials.materials);
  problems.throwIfAny(); // before much memory is taken

  std::vector<GltfPrimitive> built(primitives.size());
  std::vector<std::optional<base::Error>> failed(primitives.size());
  const std::vector<Material> asRead = scene.materials; // reading the images renumbers those of the scene meanwhile
  const auto buildMeshes = [&] {
    base::parallelFor(primitives.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) try {
          const UsedPrimitive& used = primitives[i];
          const MeshUse& use = uses.uses[used.use];
          const SkinPose* skin = use.skin < 0 ? nullptr : &uses.skins[static_cast<std::size_t>(use.skin)];
          built[i] = buildPrimitive(document, used.mesh, used.primitive, used.material, asRead[used.material],
                                    materials.uvSets[used.material], {use.weights, skin});
        } catch (const base::Error& error) {
          failed[i] = error;
        }
    });
  };
  std::vector<SourceFile> imageFiles;
  const auto readImages = [&] {
    imageFiles = readSceneImages(document, materials.derived.list,
                                 listShown(document, primitives, scene.materials.size()), scene, problems);
  };
  base::parallelInvoke({buildMeshes, readImages});
  for (const std::optional<base::Error>& error : failed)
    if (error) problems.add(*error);
  scene.sources = {document.source};
  for (const std::vector<SourceFile>& files : {document.buffers->sources(), imageFiles})
    scene.sources.insert(scene.sources.end(), files.begin(), files.end());

  std::vector<std::vector<BuiltMesh>> meshesOf(uses.uses.size());
  for (std::size_t i = 0; i < built.size(); ++i) {
    scene.warnings.insert(scene.warnings.end(), built[i].warnings.begin(), built[i].warnings.end());
    if (!built[i].mesh) continue;
    meshesOf[primitives[i].use].push_back({static_cast<std::uint32_t>(scene.meshes.size()), built[i].isSkinned});
    scene.meshes.push_back(std::move(*built[i].mesh));
  }
  placeAll(document, std::span(nodes).first(list.shown), uses, meshesOf, scene, problems);
  problems.throwIfAny();

  if (scene.instances.empty() && !options.allMaterials)
    throw document.error("", "the scene is empty: " + whyEmpty(document, list, uses, scene.warnings));
  dropRepeated(scene.warnings); // a mesh in several poses says the same several times
  if (scene.warnings.size() > kMaxWarnings) {
    const std::size_t more = scene.warnings.size() - kMaxWarnings;
    scene.warnings.resize(kMaxWarnings);
    scene.warnings.push_back(fmt::format("{} more warnings", more));
  }
  return scene;
}

} // namespace parity::scenes

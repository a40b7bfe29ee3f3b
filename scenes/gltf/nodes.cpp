// The node hierarchy of a glTF file.
#include "scenes/gltf/nodes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scenes/gltf/variants.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

bool isFinite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(static_cast<float>(m[c][r]))) return false;
  return true;
}

} // namespace

bool makeAffine(glm::dmat4& m) {
  constexpr double kRounding = 1e-5; // of exporters that multiply in 32 bits
  glm::dmat4 rows = glm::transpose(m);
  const glm::dvec4 off = glm::abs(rows[3] - glm::dvec4(0, 0, 0, 1));
  if (!(std::max({off.x, off.y, off.z, off.w}) <= kRounding)) return false;
  rows[3] = {0, 0, 0, 1};
  m = glm::transpose(rows);
  return true;
}

namespace {

glm::dmat4 localTransform(const GltfDocument& document, int index, const NodePose& pose) {
  const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("/nodes/{}", index);
  glm::dmat4 local(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    if (!makeAffine(local)) throw document.error(place + "/matrix", "is not affine: its last row is not 0 0 0 1");
    return local;
  }
  const auto own = [](const std::vector<double>& v) { return glm::dvec3(v[0], v[1], v[2]); };
  if (pose.translation || !node.translation.empty())
    local = glm::translate(local, pose.translation ? *pose.translation : own(node.translation));
  if (pose.rotation)
    local *= glm::mat4_cast(*pose.rotation);
  else if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(glm::length(rotation) > 0)) throw document.error(place + "/rotation", "is a quaternion of length 0");
    local *= glm::mat4_cast(glm::normalize(rotation));
  }
  if (pose.scale || !node.scale.empty()) local = glm::scale(local, pose.scale ? *pose.scale : own(node.scale));
  return local;
}

std::vector<int> rootsToShow(const GltfDocument& document, const std::vector<int>& parents,
                             std::vector<std::string>& warnings) {
  const tinygltf::Model& model = document.model;
  if (!model.scenes.empty()) {
    const std::string& wanted = document.options.scene;
    const std::size_t scene = wanted.empty()
                                  ? static_cast<std::size_t>(std::max(model.defaultScene, 0))
                                  : findNamed(document.facts.scenes, wanted, document.label, "--scene", "scene");
    if (model.scenes.size() > 1 && wanted.empty())
      warnings.push_back(
          fmt::format("the file has {} scenes, scene {} is shown (--scene chooses one)", model.scenes.size(), scene));
    return model.scenes[scene].nodes;
  }
  if (!document.options.scene.empty()) findNamed({}, document.options.scene, document.label, "--scene", "scene");
  std::vector<int> roots;
  for (std::size_t n = 0; n < parents.size(); ++n)
    if (parents[n] < 0) roots.push_back(static_cast<int>(n));
  warnings.push_back("the file has no scene, so all its root nodes are shown");
  return roots;
}

// Appends a tree. Its nodes have one parent each and no cycle (gltf_structure.h).
void appendTree(const GltfDocument& document, int root, NodeList& list) {
  std::vector<NodeList::Entry> stack = {{root, NodeList::kNone}};
  while (!stack.empty()) {
    const NodeList::Entry entry = stack.back();
    stack.pop_back();
    const std::size_t place = list.entries.size();
    list.placeOf[static_cast<std::size_t>(entry.node)] = place;
    list.entries.push_back(entry);
    const std::vector<int>& children = document.model.nodes[static_cast<std::size_t>(entry.node)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) stack.push_back({*child, place});
  }
}

// "parent/name", of which the last components within kMaxNodePath are kept.
std::string joinPath(const std::string& parent, const std::string& name) {
  constexpr std::string_view kCut = "...";
  std::string path = parent.empty() ? name : parent + "/" + name;
  if (path.size() <= kMaxNodePath) return path;
  std::size_t begin = path.size() - (kMaxNodePath - kCut.size());
  while (path[begin] != '/') ++begin; // there is one: a name has at most 128 bytes
  return std::string(kCut) + path.substr(begin);
}

} // namespace

NodeList listNodes(const GltfDocument& document, std::vector<std::string>& warnings) {
  const std::vector<tinygltf::Node>& nodes = document.model.nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const int child : nodes[n].children) parents[static_cast<std::size_t>(child)] = static_cast<int>(n);

  NodeList list;
  list.placeOf.assign(nodes.size(), NodeList::kNone);
  for (const int root : rootsToShow(document, parents, warnings)) appendTree(document, root, list);
  list.shown = list.entries.size();
  std::vector<bool> isSkinKnown(document.model.skins.size());
  for (std::size_t place = 0; place < list.shown; ++place) {
    const tinygltf::Node& node = nodes[static_cast<std::size_t>(list.entries[place].node)];
    if (node.mesh < 0 || node.skin < 0 || isSkinKnown[static_cast<std::size_t>(node.skin)]) continue;
    isSkinKnown[static_cast<std::size_t>(node.skin)] = true;
    for (int joint : document.model.skins[static_cast<std::size_t>(node.skin)].joints) {
      if (list.placeOf[static_cast<std::size_t>(joint)] != NodeList::kNone) continue;
      while (parents[static_cast<std::size_t>(joint)] >= 0) joint = parents[static_cast<std::size_t>(joint)];
      appendTree(document, joint, list);
    }
  }
  return list;
}

std::vector<PlacedNode> placeNodes(const GltfDocument& document, const NodeList& list, const Pose& pose,
                                   Problems& problems) {
  std::vector<PlacedNode> placed;
  placed.reserve(list.entries.size());
  for (const NodeList::Entry& entry : list.entries) {
    const auto found = pose.find(entry.node);
    glm::dmat4 toWorld(1.0);
    problems.attempt(
        [&] { toWorld = localTransform(document, entry.node, found == pose.end() ? NodePose{} : found->second); });
    std::string name = cleanName(document.model.nodes[static_cast<std::size_t>(entry.node)].name);
    if (name.empty()) name = fmt::format("node {}", entry.node);
    if (entry.parent != NodeList::kNone) {
      toWorld = placed[entry.parent].toWorld * toWorld;
      name = joinPath(placed[entry.parent].path, name);
    } else
      name = joinPath("", name);
    if (!isFinite(toWorld))
      problems.add(fmt::format("/nodes/{}", entry.node), "its transform to the world is not finite");
    placed.push_back({entry.node, toWorld, std::move(name)});
  }
  return placed;
}

} // namespace parity::scenes

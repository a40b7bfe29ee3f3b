// The node hierarchy of a glTF file.
#include "scenes/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scenes/names.h"

namespace parity::scenes {
namespace {

constexpr int kNoParent = -1;

// Each node's parent. No node may be listed twice as a child: the hierarchy is a set of trees.
std::vector<int> findParents(const GltfDocument& document) {
  const auto& nodes = document.model.nodes;
  std::vector<int> parents(nodes.size(), kNoParent);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const int child : nodes[n].children) {
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent != kNoParent)
        throw document.error(fmt::format("nodes[{}]", child),
                             parent == static_cast<int>(n)
                                 ? fmt::format("is a child of nodes[{}] twice", n)
                                 : fmt::format("has two parents: nodes[{}] and nodes[{}]", parent, n));
      parent = static_cast<int>(n);
    }
  return parents;
}

// With one parent each, a cycle is a chain of parents that never ends. Also those that no scene shows are refused.
void checkCycles(const GltfDocument& document, const std::vector<int>& parents) {
  std::vector<std::size_t> visitedBy(parents.size(), 0); // walk number, from 1
  for (std::size_t start = 0; start < parents.size(); ++start)
    for (int n = static_cast<int>(start); n != kNoParent; n = parents[static_cast<std::size_t>(n)]) {
      std::size_t& visited = visitedBy[static_cast<std::size_t>(n)];
      if (visited == start + 1)
        throw document.error(fmt::format("nodes[{}]", n), "is its own ancestor: the hierarchy has a cycle");
      if (visited) break; // an earlier walk came through and ended
      visited = start + 1;
    }
}

bool isFinite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(static_cast<float>(m[c][r]))) return false;
  return true;
}

glm::dmat4 localTransform(const GltfDocument& document, int index) {
  const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("nodes[{}]", index);
  glm::dmat4 local(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    if (local[0][3] != 0 || local[1][3] != 0 || local[2][3] != 0 || local[3][3] != 1)
      throw document.error(place + ".matrix", "is not affine: its last row is not 0 0 0 1");
    return local;
  }
  if (!node.translation.empty())
    local = glm::translate(local, {node.translation[0], node.translation[1], node.translation[2]});
  if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(glm::length(rotation) > 0)) throw document.error(place + ".rotation", "a quaternion of length 0");
    local *= glm::mat4_cast(glm::normalize(rotation));
  }
  if (!node.scale.empty()) local = glm::scale(local, {node.scale[0], node.scale[1], node.scale[2]});
  return local;
}

std::vector<int> rootsToShow(const GltfDocument& document, const std::vector<int>& parents,
                             std::vector<std::string>& warnings) {
  const tinygltf::Model& model = document.model;
  if (!model.scenes.empty()) {
    const int scene = std::max(model.defaultScene, 0);
    if (model.scenes.size() > 1)
      warnings.push_back(fmt::format("{} scenes in the file, scene {} is shown", model.scenes.size(), scene));
    const std::vector<int>& roots = model.scenes[static_cast<std::size_t>(scene)].nodes;
    for (const int root : roots)
      if (parents[static_cast<std::size_t>(root)] != kNoParent || std::count(roots.begin(), roots.end(), root) > 1)
        throw document.error(fmt::format("scenes[{}].nodes", scene),
                             fmt::format("nodes[{}] is not a root, or listed twice", root));
    return roots;
  }
  std::vector<int> roots;
  for (std::size_t n = 0; n < parents.size(); ++n)
    if (parents[n] == kNoParent) roots.push_back(static_cast<int>(n));
  warnings.push_back("the file has no scene: all its root nodes are shown");
  return roots;
}

} // namespace

std::vector<PlacedNode> placeNodes(const GltfDocument& document, std::vector<std::string>& warnings) {
  const std::vector<int> parents = findParents(document);
  checkCycles(document, parents);

  struct Pending {
    int node, depth;
    glm::dmat4 parent;
    std::string path; // of the parent, with its '/'
  };
  std::vector<Pending> stack;
  const std::vector<int> roots = rootsToShow(document, parents, warnings);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, 1, glm::dmat4(1.0), ""});
  std::vector<PlacedNode> placed;
  while (!stack.empty()) {
    Pending next = std::move(stack.back());
    stack.pop_back();
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(next.node)];
    const std::string place = fmt::format("nodes[{}]", next.node);
    if (next.depth > kMaxNodeDepth)
      throw document.error(place, fmt::format("lies deeper than {} levels", kMaxNodeDepth));
    std::string name = cleanName(node.name);
    if (name.empty()) name = fmt::format("node {}", next.node);
    const glm::dmat4 toWorld = next.parent * localTransform(document, next.node);
    if (!isFinite(toWorld)) throw document.error(place, "its transform to the world is not finite");
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      stack.push_back({*child, next.depth + 1, toWorld, next.path + name + "/"});
    placed.push_back({next.node, toWorld, next.path + name});
  }
  return placed;
}

} // namespace parity::scenes

// Morph targets of a glTF primitive, on the CPU.
#include "scenes/gltf/morph.h"

#include <algorithm>

#include <fmt/format.h>

namespace parity::scenes {
namespace {

// values += weight * deltas, in all components that both have.
template <typename Value, typename Delta>
void add(std::vector<Value>& values, const std::vector<Delta>& deltas, float weight) {
  constexpr auto kShared = static_cast<int>(std::min(sizeof(Value), sizeof(Delta)) / sizeof(float));
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < kShared; ++c) values[i][c] += weight * deltas[i][c];
}

std::vector<float> toFloats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

} // namespace

std::vector<float> morphWeights(const GltfDocument& document, int node, const Pose& pose) {
  const tinygltf::Node& source = document.model.nodes[static_cast<std::size_t>(node)];
  const tinygltf::Mesh& mesh = document.model.meshes[static_cast<std::size_t>(source.mesh)];
  const std::size_t count = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
    if (const std::size_t targets = mesh.primitives[p].targets.size(); targets != count)
      throw document.error(
          fmt::format("/meshes/{}/primitives/{}/targets", source.mesh, p),
          fmt::format("has {} targets, expected {} as in the first primitive of the mesh", targets, count));
  if (count == 0) return {};
  document.memory.take(count * sizeof(float), fmt::format("/nodes/{}/weights", node));
  const auto check = [&](const std::vector<double>& weights, const std::string& place) {
    if (!weights.empty() && weights.size() != count)
      throw document.error(place,
                           fmt::format("holds {} weights, expected {}, one for each target", weights.size(), count));
  };
  check(mesh.weights, fmt::format("/meshes/{}/weights", source.mesh));
  check(source.weights, fmt::format("/nodes/{}/weights", node));
  if (const auto found = pose.find(node); found != pose.end() && found->second.weights) return *found->second.weights;
  if (!source.weights.empty()) return toFloats(source.weights);
  return mesh.weights.empty() ? std::vector<float>(count, 0.f) : toFloats(mesh.weights);
}

void applyMorphTargets(const PrimitiveReader& reader, std::span<const float> weights, const UvSets& uvSets, Mesh& mesh,
                       std::vector<std::string>& warnings) {
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const float weight = weights[t];
    if (weight == 0) continue;
    const auto target = [&](const std::string& name, bool isWanted) {
      return isWanted ? reader.target(t, name, warnings) : std::nullopt;
    };
    if (const auto view = target("POSITION", true)) add(mesh.positions, view->readVec3(), weight);
    if (const auto view = target("NORMAL", !mesh.normals.empty())) add(mesh.normals, view->readVec3Unchecked(), weight);
    if (const auto view = target("TANGENT", !mesh.tangents.empty()))
      add(mesh.tangents, view->readVec3Unchecked(), weight);
    if (const auto view = target(fmt::format("TEXCOORD_{}", uvSets.first), !mesh.uv0.empty()))
      add(mesh.uv0, view->readVec2(), weight);
    if (const auto view = target(fmt::format("TEXCOORD_{}", uvSets.second), !mesh.uv1.empty()))
      add(mesh.uv1, view->readVec2(), weight);
    if (const auto view = target("COLOR_0", !mesh.colors.empty())) add(mesh.colors, view->readVec4(0.f), weight);
  }
  for (glm::vec4& color : mesh.colors) color = glm::clamp(color, 0.f, 1.f);
}

} // namespace parity::scenes

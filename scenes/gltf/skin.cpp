// Skins of a glTF file: linear blend skinning on the CPU.
#include "scenes/gltf/skin.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.h"
#include "scenes/gltf/nodes.h"

namespace parity::scenes {
namespace {

// One pair of JOINTS_n and WEIGHTS_n.
struct InfluenceSet {
  std::vector<glm::u16vec4> joints;
  std::vector<glm::vec4> weights;
};

std::vector<InfluenceSet> readInfluences(const PrimitiveReader& reader, std::size_t jointCount,
                                         std::vector<std::string>& warnings) {
  std::vector<InfluenceSet> sets;
  for (int n = 0;; ++n) {
    const auto joints = reader.attribute(fmt::format("JOINTS_{}", n), warnings);
    const auto weights = reader.attribute(fmt::format("WEIGHTS_{}", n), warnings);
    if (!joints && !weights) return sets;
    if (!joints || !weights)
      throw reader.document().error(reader.place() + "/attributes",
                                    fmt::format("has only one of JOINTS_{0} and WEIGHTS_{0}, expected both", n));
    InfluenceSet set{joints->readJoints(), weights->readVec4(0.f)};
    for (std::size_t v = 0; v < set.weights.size(); ++v)
      for (int i = 0; i < 4; ++i) {
        if (set.weights[v][i] < 0)
          throw weights->error(fmt::format("element {} holds {}, expected at least 0", v, set.weights[v][i]));
        if (set.joints[v][i] < jointCount) continue;
        if (set.weights[v][i] > 0)
          throw joints->error(
              fmt::format("element {} holds joint {}, expected one of the skin's {}", v, set.joints[v][i], jointCount));
        set.joints[v][i] = 0; // what has no weight may be anything
      }
    sets.push_back(std::move(set));
  }
}

// The inverse transpose times the determinant's size: right for directions, and defined for any matrix.
glm::dmat3 normalMatrix(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

} // namespace

SkinPose poseSkin(const GltfDocument& document, int index, const std::function<const glm::dmat4&(int)>& worldOf) {
  const tinygltf::Skin& skin = document.model.skins[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("/skins/{}", index);
  if (skin.joints.empty()) throw document.error(place + "/joints", "is empty, expected at least one");
  std::vector<glm::dmat4> inverseBind;
  if (skin.inverseBindMatrices >= 0) {
    const AccessorView view(document, skin.inverseBindMatrices, place + "/inverseBindMatrices");
    const MemoryCharge charge(document.memory, view.count() * sizeof(glm::mat4), view.place());
    const std::vector<glm::mat4> matrices = view.readMat4();
    inverseBind.assign(matrices.begin(), matrices.end());
    if (inverseBind.size() < skin.joints.size())
      throw view.error(
          fmt::format("has {} matrices, expected {}, one for each joint", inverseBind.size(), skin.joints.size()));
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
      if (!makeAffine(inverseBind[i]))
        throw view.error(fmt::format("element {} is not affine: its last row is not 0 0 0 1", i));
  }
  SkinPose pose;
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    pose.matrices.push_back(worldOf(skin.joints[i]) *
                            (inverseBind.empty() ? glm::dmat4(1.0) : glm::dmat4(inverseBind[i])));
  return pose;
}

bool applySkin(const PrimitiveReader& reader, const SkinPose& pose, Mesh& mesh, std::vector<std::string>& warnings) {
  const std::vector<InfluenceSet> sets = readInfluences(reader, pose.matrices.size(), warnings);
  if (sets.empty()) {
    warnings.push_back(reader.place() + ": has a skin but no JOINTS_0 and WEIGHTS_0, so the skin is ignored");
    return false;
  }
  std::atomic<std::size_t> rescaled = 0, unweighted = 0, mirrored = 0;
  constexpr double kPrecision = 2.0 / 255; // of weights in 8 bits, each rounded
  base::parallelFor(mesh.positions.size(), 8192, [&](std::size_t begin, std::size_t end) {
    std::size_t rescaledHere = 0, unweightedHere = 0, mirroredHere = 0;
    for (std::size_t v = begin; v < end; ++v) {
      glm::dmat4 blended(0.0);
      double sum = 0;
      for (const InfluenceSet& set : sets)
        for (int i = 0; i < 4; ++i)
          if (const double weight = set.weights[v][i]; weight > 0) {
            blended += weight * pose.matrices[set.joints[v][i]];
            sum += weight;
          }
      if (sum > 0)
        blended /= sum;
      else
        blended = pose.matrices[sets.front().joints[v][0]];
      unweightedHere += !(sum > 0);
      rescaledHere += sum > 0 && std::abs(sum - 1) > kPrecision;
      const glm::dmat3 linear(blended), forNormals = normalMatrix(linear);
      const bool isMirrored = glm::determinant(linear) < 0;
      mirroredHere += isMirrored;
      mesh.positions[v] = glm::vec3(blended * glm::dvec4(mesh.positions[v], 1.0));
      if (!mesh.normals.empty()) mesh.normals[v] = glm::vec3(forNormals * glm::dvec3(mesh.normals[v]));
      if (!mesh.tangents.empty()) {
        const glm::vec4 tangent = mesh.tangents[v];
        mesh.tangents[v] = glm::vec4(glm::vec3(linear * glm::dvec3(tangent)), isMirrored ? -tangent.w : tangent.w);
      }
    }
    rescaled += rescaledHere, unweighted += unweightedHere, mirrored += mirroredHere;
  });
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (const glm::vec3& p = mesh.positions[v]; !std::isfinite(p.x + p.y + p.z))
      throw reader.document().error(reader.place(), fmt::format("vertex {} is not finite in world space", v));
  if (mirrored == mesh.positions.size())
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  if (rescaled)
    warnings.push_back(fmt::format("{}: the weights of {} vertices do not sum to 1, so they are scaled", reader.place(),
                                   rescaled.load()));
  if (unweighted)
    warnings.push_back(fmt::format("{}: {} vertices have no weight, so they follow their first joint", reader.place(),
                                   unweighted.load()));
  return true;
}

} // namespace parity::scenes

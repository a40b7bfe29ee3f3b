#include "cli/bake/bake_harness.h"

#include <algorithm>

namespace parity::tests {

void addLamp(GltfFile& file, const glm::vec3& at, const std::string& kind) {
  nlohmann::json& lights = file.json["extensions"]["KHR_lights_punctual"]["lights"];
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
  file.json["nodes"].push_back(
      {{"extensions", {{"KHR_lights_punctual", {{"light", lights.size()}}}}}, {"translation", {at.x, at.y, at.z}}});
  lights.push_back(nlohmann::json::parse(kind));
}

GltfFile makeCorner() {
  GltfFile file = makeQuad();
  file.json["materials"] = {
      {{"name", "floor"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
      {{"name", "wall"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0.8, 0.2, 0.1, 1}}}}}};
  file.json["meshes"].push_back(file.json["meshes"][0]);
  file.json["meshes"][1]["primitives"][0]["material"] = 1;
  const double half = std::sqrt(0.5);
  file.json["nodes"] = {
      {{"mesh", 0}, {"rotation", {-half, 0, 0, half}}, {"translation", {-1, 0, 1}}, {"scale", {2, 2, 2}}},
      {{"mesh", 1}, {"translation", {-1, 0, -1}}, {"scale", {2, 2, 2}}}};
  file.json["scenes"][0]["nodes"] = {0, 1};
  return file;
}

GltfFile makeLitCorner() {
  GltfFile file = makeCorner();
  addLamp(file, {0.2f, 0.8f, 0.1f});
  return file;
}

FolderContent readFolder(const std::filesystem::path& folder) {
  FolderContent content;
  for (const std::string& file : listFiles(folder)) content[file] = readWholeFile(folder / file);
  return content;
}

std::vector<std::string> BakeTest::entries() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder.path()))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

void BakedRenderTest::SetUp() {
  if (const std::string missing = missingDriver(); !missing.empty()) GTEST_SKIP() << missing;
}

} // namespace parity::tests

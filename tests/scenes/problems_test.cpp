// Several problems of one file are told at once, each in a line of its own, and at most twenty.
#include <thread>

#include "base/file.h"
#include "base/lines_of.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"
#include "scenes/problems.h"

namespace parity::tests {
namespace {

std::vector<std::string> refusalOf(const std::string& path, const scenes::LoadOptions& options = {}) {
  try {
    scenes::loadScene(path, options);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::failed);
    return linesOf(error.what());
  }
  return {};
}

TEST(Problems, AreToldTogetherWithPlaceAndExpectation) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.material()["alphaMode"] = "SOLID";
  file.primitive()["mode"] = 9;
  file.primitive()["attributes"]["a/b~c"] = 99;
  file.json["nodes"][0]["mesh"] = 4;
  file.json["accessors"][0].erase("count");
  const std::string path = writeEmbedded(folder, file);
  EXPECT_EQ(refusalOf(path),
            (std::vector<std::string>{
                path + ": /nodes/0/mesh: is 4, expected an index of meshes, 0 to 0",
                path + ": /meshes/0/primitives/0/attributes/a~1b~0c: is 99, expected an index of accessors, 0 to 3",
                path + ": /meshes/0/primitives/0/mode: is 9, expected one of 0, 1, 2, 3, 4, 5, 6",
                path + ": /accessors/0/count: is missing",
                path + ": /materials/0/alphaMode: is \"SOLID\", expected one of OPAQUE, MASK, BLEND"}));
}

TEST(Problems, OfEveryStageAreGathered) {
  const TempFolder folder;
  GltfFile structure = makeQuad();
  structure.json["accessors"][0]["byteOffset"] = 2;
  structure.json["bufferViews"][1]["byteStride"] = 6;
  structure.json["images"] = {nlohmann::json::object()};
  structure.json["nodes"] = {{{"mesh", 0}, {"children", {0}}}};
  EXPECT_EQ(refusalOf(writeEmbedded(folder, structure, "structure")).size(), 7u)
      << "a view's stride, what it means for its accessor, an accessor's offset and its end, an image, a cycle, a root";

  GltfFile data = makeQuad();
  data.json["images"] = {{{"uri", "none.png"}}, {{"uri", "data:image/png;base64,AAAA"}}};
  data.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  data.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
  data.material()["normalTexture"] = {{"index", 1}};
  data.primitive()["indices"] = data.add<std::uint16_t>({0, 1, 7}, "SCALAR");
  data.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}}};
  data.json["nodes"][0]["camera"] = 0;
  const std::vector<std::string> lines = refusalOf(writeEmbedded(folder, data, "data"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NE(lines[0].find("/images/0 'none.png'"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("/images/1 'image 1': is not a PNG"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("/meshes/0/primitives/0/indices"), std::string::npos) << lines[2];
  EXPECT_NE(lines[3].find("/cameras/0/perspective/yfov"), std::string::npos) << lines[3];
}

TEST(Problems, BeyondTwentyAreCounted) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  for (int i = 0; i < 50; ++i) file.json["materials"].push_back({{"alphaCutoff", "half"}});
  const std::string path = writeEmbedded(folder, file);
  const std::vector<std::string> lines = refusalOf(path);
  ASSERT_EQ(lines.size(), 21u);
  EXPECT_EQ(lines.back(), path + ": and 30 more problems");
}

TEST(Problems, AreKeptOnceWhicheverThreadAddsThem) {
  scenes::Problems problems("a.gltf");
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) threads.emplace_back([&] { problems.add("/nodes/0", "is odd"); });
  for (std::thread& thread : threads) thread.join();
  expectError([&] { problems.throwIfAny(); }, {"a.gltf: /nodes/0: is odd"});
  EXPECT_FALSE(problems.attempt([] { throw base::fileError("a.gltf", "/nodes/1", "is even"); }));
  EXPECT_TRUE(problems.attempt([] {}));
  EXPECT_THROW(problems.attempt([] { throw base::Error(base::ExitCode::usage, "--time", "", "no"); }), base::Error)
      << "what the user asked wrongly is not the file's problem";
}

TEST(Limits, OfImagesAndMemoryAreTheUsers) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(300, 20))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  const std::string path = writeGlb(folder, file);
  EXPECT_TRUE(refusalOf(path).empty());
  EXPECT_NE(refusalOf(path, {.maxImageSide = 299}).at(0).find("300x20 pixels, expected at most 299 a side"),
            std::string::npos);
  EXPECT_NE(refusalOf(path, {.maxImageTexels = 5999}).at(0).find("more than 5999 texels together"), std::string::npos);
  EXPECT_TRUE(refusalOf(path, {.maxImageSide = 300, .maxImageTexels = 6000}).empty());
  EXPECT_NE(refusalOf(path, {.maxMemoryBytes = 20000}).at(0).find("(--max-memory)"), std::string::npos);
}

TEST(Loading, ReadsOnlyTheBuffersAndImagesThatAreShownAndEachImageOnce) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  writeFile(folder / "a.png", makePng(4, 4));
  file.json["images"] = {{{"uri", "a.png"}, {"name", "first"}}, {{"uri", "./a.png"}}, {{"uri", "absent.png"}}};
  file.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
  file.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
  file.material()["normalTexture"] = {{"index", 1}};
  file.json["materials"].push_back({{"normalTexture", {{"index", 2}}}});
  const std::string path = writeExternal(folder, file);
  nlohmann::json document = nlohmann::json::parse(base::readText(path));
  document["buffers"].push_back({{"uri", "absent.bin"}, {"byteLength", 12}});
  document["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 12}});
  document["accessors"].push_back(
      {{"bufferView", document["bufferViews"].size() - 1}, {"componentType", 5126}, {"count", 1}, {"type", "VEC3"}});
  writeFile(path, document.dump());
  const scenes::Scene scene = scenes::loadScene(path);
  EXPECT_EQ(scene.materials[0].baseColorTexture.image, scene.materials[0].normalTexture.image);
  ASSERT_EQ(scene.sources.size(), 3u) << "the file, its buffer, one image";
  EXPECT_EQ(scene.sources[2].file.filename(), "a.png");
  EXPECT_EQ(refusalOf(path, {.allMaterials = true}).size(), 1u) << "then the absent one is missed";
}

} // namespace
} // namespace parity::tests

// A scene's digests of its inputs in report.json: the same wherever it lies, and however its result came about.
#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

class InputsTest : public RenderingTest {
protected:
  void SetUp() override {
    RenderingTest::SetUp();
    for (const char* folder : {"here", "there"}) {
      std::filesystem::create_directory(m_folder / folder);
      GltfFile file = makeQuad();
      file.json["images"] = {{{"uri", "paint.png"}}};
      file.json["textures"] = {{{"source", 0}}};
      file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
      file.json["buffers"] = {{{"uri", "quad.bin"}, {"byteLength", file.bin.size()}}};
      writeExternal(m_folder, file, std::string(folder) + "/quad");
      base::writeImage8(m_folder / folder / "paint.png", base::Image8(4, 4, 3, 90));
    }
  }

  nlohmann::json inputsOf(const std::string& scene, const std::vector<std::string>& more = {}) const {
    const RunResult result = runParity(join(
        {{"report", scene, "--size", "64x64", "--sun", "30,50,4", "--env", "builtin:sky", "-o", path("out")}, more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    return readReport(m_folder / "out")["scenes"][0]["inputs"];
  }
};

TEST_F(InputsTest, PlaceAndCacheDoNotCountButTexturesDo) {
  const nlohmann::json inputs = inputsOf(path("here/quad.gltf"));
  EXPECT_EQ(inputs["asset"].get<std::string>().size(), 12u);
  EXPECT_EQ(inputs["bake"], "");
  const std::vector<std::string> cache = {"--cache", path("cache")};
  EXPECT_EQ(inputsOf(path("there/quad.gltf"), cache), inputs);
  EXPECT_EQ(inputsOf(path("there/quad.gltf"), cache), inputs) << "recalled";
  EXPECT_EQ(inputsOf(std::filesystem::relative(m_folder / "there" / "quad.gltf").string()), inputs);

  base::writeImage8(m_folder / "there" / "paint.png", base::Image8(4, 4, 3, 91));
  const nlohmann::json painted = inputsOf(path("there/quad.gltf"), cache);
  EXPECT_NE(painted["asset"], inputs["asset"]);
  for (const char* same : {"environment", "request", "bake"}) EXPECT_EQ(painted[same], inputs[same]) << same;
}

TEST_F(InputsTest, AreAbsentOfAFileThatCannotBeRead) {
  EXPECT_EQ(runParity({"report", path("no.gltf"), "-o", path("out")}).exitCode, 4);
  EXPECT_FALSE(readReport(m_folder / "out")["scenes"][0].contains("inputs"));
}

} // namespace
} // namespace parity::tests

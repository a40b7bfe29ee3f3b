// Blended surfaces in every path: composed by depth, counted by their contribution, and said where some are left out.
#include <array>
#include <map>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class BlendTest : public RenderingTest {
protected:
  struct Pane {
    std::array<double, 3> color;
    double opacity, z; // opacity 1: not blended
  };
  // Unlit squares, one behind the other, in this order in the file; the middle of the picture shows them all.
  std::string write(const std::vector<Pane>& panes, const std::string& name) const {
    GltfFile file = makeQuad();
    file.json["extensionsUsed"] = {"KHR_materials_unlit"};
    const json mesh = file.json["meshes"][0];
    for (const char* list : {"materials", "meshes", "nodes"}) file.json[list] = json::array();
    file.json["scenes"][0]["nodes"] = json::array();
    for (const Pane& pane : panes) {
      const std::size_t i = file.json["nodes"].size();
      file.json["materials"].push_back(
          {{"name", "pane " + std::to_string(i)},
           {"alphaMode", pane.opacity < 1 ? "BLEND" : "OPAQUE"},
           {"pbrMetallicRoughness", {{"baseColorFactor", {pane.color[0], pane.color[1], pane.color[2], pane.opacity}}}},
           {"extensions", {{"KHR_materials_unlit", json::object()}}}});
      file.json["meshes"].push_back(mesh);
      file.json["meshes"].back()["primitives"][0]["material"] = i;
      file.json["nodes"].push_back({{"mesh", i}, {"translation", {0, 0, pane.z}}});
      file.json["scenes"][0]["nodes"].push_back(i);
    }
    return writeGlb(m_folder, file, name);
  }
  // Of numbers that halves hold.
  std::string writeStack(const std::string& name) const {
    return write({{{0, 1, 0.5}, 0.25, 0.2}, {{1, 0.5, 0.25}, 1, 0}, {{0, 0, 1}, 0.5, 0.3}, {{1, 1, 0}, 0.5, 0.1}},
                 name);
  }
};

const std::vector<std::string> kFrontal = {"--orbit", "0,90,3", "--sun", "0,90,1"};

std::array<float, 3> middleOf(const base::Image& image, int channel = 0) {
  const float* pixel = image.at(image.width / 2, image.height / 2) + channel;
  return {pixel[0], pixel[1], pixel[2]};
}

TEST_F(BlendTest, EveryPathComposesLayersByDepth) {
  const std::string scene = writeStack("stack");
  // Over the wall: yellow at 1/2, green at 1/4, blue at 1/2.
  std::array<float, 3> expected = {1, 0.5f, 0.25f};
  const auto lay = [&](const std::array<float, 3>& color, float opacity) {
    for (int c = 0; c < 3; ++c) expected[c] = expected[c] * (1 - opacity) + color[c] * opacity;
  };
  lay({1, 1, 0}, 0.5f);
  lay({0, 1, 0.5f}, 0.25f);
  lay({0, 0, 1}, 0.5f);
  for (const std::vector<std::string>& path : std::vector<std::vector<std::string>>{
           {"highend"}, {"mobile", "--precision", "fp32"}, {"mobile"}, {"reference"}}) {
    const std::string file = (m_folder / "terms.exr").string();
    const RunResult result =
        runParity(join({{"render", scene, "-o", file, "--terms", "--path"}, path, kSmall, kFrontal}));
    ASSERT_TRUE(exitedWith(0, result));
    const base::Image image = base::readImage(file);
    EXPECT_EQ(middleOf(image), expected) << path.back();
    std::array<float, 3> sum{};
    for (std::size_t t = 0; t < shading::kBaseTermCount; ++t)
      for (int c = 0; c < 3; ++c) sum[c] += middleOf(image, channelOf(static_cast<shading::Term>(t)))[c];
    EXPECT_EQ(sum, expected) << path.back() << ": terms are after the layers' weights";
  }
}

TEST_F(BlendTest, ReportsCountLayersAndSayNothingOfThem) {
  const RunResult result =
      runParity(join({{"diff", writeStack("stack"), "--json", "-", "--attribution", "all"}, kSmall, kFrontal}));
  EXPECT_TRUE(exitedWith(0, result)) << "unlit: both paths show the same";
  const json scene = json::parse(result.out)["scenes"][0];
  EXPECT_TRUE(scene["warnings"].empty()) << scene["warnings"];
  std::map<std::string, std::uint64_t> counts;
  for (const json& pass : scene["passes"]) counts[pass["name"]] = pass["count"];
  EXPECT_GT(counts["surface"], 100u);
  EXPECT_GT(counts["blended surface"], 3 * counts["surface"]) << "three nearer ones, each shaded once";
  EXPECT_LT(counts["blended surface"], 5 * counts["surface"]);
  EXPECT_EQ(counts["shade highend"], counts["shade mobile"]);
}

TEST_F(BlendTest, TooManyLayersAreAWarningWithTheirPixels) {
  std::vector<Pane> panes;
  for (int i = 0; i < 18; ++i) panes.push_back({{1, 1, 1}, 0.0625, 0.01 * i});
  const std::string scene = write(panes, "many");
  const RunResult shot = runParity(
      join({{"render", scene, "--path", "mobile", "-o", (m_folder / "many.exr").string()}, kSmall, kFrontal}));
  EXPECT_TRUE(exitedWith(0, shot));
  EXPECT_TRUE(contains(shot.err, "pixels show more than 16 layers of blended surfaces")) << shot.err;
  const RunResult diff = runParity(join({{"diff", scene, "--json", "-"}, kSmall, kFrontal}));
  const json warnings = json::parse(diff.out)["scenes"][0]["warnings"];
  EXPECT_TRUE(contains(warnings.dump(), "pixels show more than 16 layers of blended surfaces")) << warnings;
}

} // namespace
} // namespace parity::tests

// Scenes that cannot be used: one line with file, place and reason, exit code 4, and nothing half-written.
#include <algorithm>
#include <functional>
#include <string_view>

#include <pugixml.hpp>

#include "cli/checks.h"

namespace parity::tests {
namespace {

struct BadScene {
  const char* name;
  std::function<std::string(const TempFolder&)> write; // returns the scene to ask for
  std::vector<std::string> parts;                      // what the line has to say
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

std::string writeEdited(const TempFolder& folder, const std::function<void(GltfFile&)>& edit) {
  GltfFile file = makeQuad();
  edit(file);
  return writeExternal(folder, file);
}

// The quad with a base colour texture of this file.
std::string writeTextured(const TempFolder& folder, const std::string& uri) {
  return writeEdited(folder, [&](GltfFile& file) {
    file.json["images"] = {{{"uri", uri}}};
    file.json["textures"] = {{{"source", 0}}};
    file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  });
}

// A PNG whose header says 0 x 4: written by hand, as nothing else would write it. The checksums are right.
std::string zeroSizedPng() {
  const unsigned char bytes[] = {0x89, 'P',  'N',  'G', '\r', '\n', 0x1a, '\n', 0,   0,   0,   13,   'I',  'H',  'D',
                                 'R',  0,    0,    0,   0,    0,    0,    0,    4,   8,   2,   0,    0,    0,    0x2f,
                                 0x78, 0xa9, 0x53, 0,   0,    0,    0,    'I',  'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(bytes), sizeof(bytes)};
}

const BadScene kBadScenes[] = {
    {"MissingFile", [](const TempFolder& f) { return (f / "none.gltf").string(); }, {"none.gltf", "does not exist"}},
    {"UnknownBuiltin", [](const TempFolder&) { return "builtin:sphere"; }, {"builtin:sphere", "did you mean"}},
    {"Folder", [](const TempFolder& f) { return f.path().string(); }, {"is a folder"}},
    {"TruncatedGlb",
     [](const TempFolder& f) {
       std::vector<std::byte> glb = makeGlb(makeQuad());
       glb.resize(glb.size() * 2 / 3);
       writeFile(f / "cut.glb", glb);
       return (f / "cut.glb").string();
     },
     {"cut.glb", "bytes"}},
    {"JsonError",
     [](const TempFolder& f) {
       writeFile(f / "scene.gltf", std::string("{\n \"asset\": {\"version\": \"2.0\",}\n}"));
       return (f / "scene.gltf").string();
     },
     {"scene.gltf", "line 2, column 29"}},
    {"IndexOutOfRange",
     [](const TempFolder& f) { return writeEdited(f, [](GltfFile& g) { g.primitive()["material"] = 7; }); },
     {"scene.gltf", "/meshes/0/primitives/0/material", "7"}},
    {"VertexIndexOutOfRange",
     [](const TempFolder& f) {
       return writeEdited(f, [](GltfFile& g) { g.primitive()["indices"] = g.add<std::uint16_t>({0, 1, 4}, "SCALAR"); });
     },
     {"scene.gltf", "/accessors/4", "4"}},
    {"NodeCycle",
     [](const TempFolder& f) {
       return writeEdited(f, [](GltfFile& g) {
         g.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
       });
     },
     {"scene.gltf", "/nodes/"}},
    {"BufferOutsideTheFolder",
     [](const TempFolder& f) {
       return writeEdited(f, [](GltfFile& g) {
         g.json["buffers"] = {{{"uri", "../secret.bin"}, {"byteLength", g.bin.size()}}};
       });
     },
     {"scene.gltf", "/buffers/0", "../secret.bin"}},
    {"ImageOutsideTheFolder",
     [](const TempFolder& f) { return writeTextured(f, "/etc/hostname"); },
     {"scene.gltf", "/images/0", "/etc/hostname"}},
    {"ImageDoesNotDecode",
     [](const TempFolder& f) {
       writeFile(f / "paint.png", std::string("\x89PNG\r\n\x1a\nand then nothing that a PNG holds"));
       return writeTextured(f, "paint.png");
     },
     {"paint.png"}},
    {"ImageOfNoPixels",
     [](const TempFolder& f) {
       writeFile(f / "paint.png", zeroSizedPng());
       return writeTextured(f, "paint.png");
     },
     {"paint.png"}},
    {"NothingToSee",
     [](const TempFolder& f) { return writeEdited(f, [](GltfFile& g) { g.json["nodes"][0].erase("mesh"); }); },
     {"scene.gltf", "the scene is empty", "none of its nodes has a mesh"}},
    {"RequiredExtension",
     [](const TempFolder& f) {
       return writeEdited(
           f, [](GltfFile& g) { g.json["extensionsUsed"] = g.json["extensionsRequired"] = {"ACME_hologram"}; });
     },
     {"scene.gltf", "ACME_hologram"}},
};

class BadSceneTest : public RenderingTest, public testing::WithParamInterface<BadScene> {};

TEST_P(BadSceneTest, IsAnErrorInAReportThatIsWhole) {
  const std::string scene = GetParam().write(m_folder);
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(join({{"report", scene, "-o", folder.string()}, kSun, kSmall}));
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_EQ(linesOf(result.err).size(), 1u) << result.err;
  EXPECT_EQ(listFiles(folder), reportFiles(1));

  const nlohmann::json report = readReport(folder);
  EXPECT_EQ(report["verdict"], "error");
  ASSERT_EQ(report["scenes"].size(), 1u);
  EXPECT_EQ(report["scenes"][0]["error"]["exitCode"], 4);
  const std::string message = report["scenes"][0]["error"]["message"];
  for (const std::string& part : GetParam().parts) EXPECT_TRUE(contains(message, part)) << part << " in: " << message;
  EXPECT_FALSE(contains(message, m_folder.path().string())) << "where the file lies differs from machine to machine";
}

INSTANTIATE_TEST_SUITE_P(, BadSceneTest, testing::ValuesIn(kBadScenes),
                         [](const auto& test) { return std::string(test.param.name); });

class BadSceneOfTheOtherCommands : public RenderingTest, public testing::WithParamInterface<std::string_view> {};

// Every command loads by the same code: three kinds of faults show that they refuse alike.
TEST_P(BadSceneOfTheOtherCommands, IsRefusedInOneLineAndNothingIsWritten) {
  const BadScene& bad = *std::ranges::find(kBadScenes, GetParam(), [](const BadScene& each) { return each.name; });
  const std::string scene = bad.write(m_folder);
  const std::vector<std::string> before = listFiles(m_folder.path());
  const std::string output = path("out.exr");
  expectRefused(runParity(join({{"render", scene, "--path", "highend", "-o", output}, kSun, kSmall})), 4, bad.parts);
  EXPECT_EQ(listFiles(m_folder.path()), before);
  expectRefused(runParity(join({{"diff", scene}, kSun, kSmall})), 4, bad.parts);
  EXPECT_EQ(listFiles(m_folder.path()), before);
}

INSTANTIATE_TEST_SUITE_P(, BadSceneOfTheOtherCommands,
                         testing::Values("MissingFile", "JsonError", "ImageDoesNotDecode"),
                         [](const auto& test) { return std::string(test.param); });

class BadSceneAmongOthers : public RenderingTest {};

TEST_F(BadSceneAmongOthers, DoesNotStopThem) {
  writeFile(m_folder / "torn.gltf", std::string("{"));
  const std::string good = writeExternal(m_folder, makeQuad(), "good");
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(join({{"report", path("torn.gltf"), good, path("none.glb"), "builtin:furnace",
                                            "-o", folder.string(), "--env", "builtin:white"},
                                           kSmall}));
  EXPECT_TRUE(exitedWith(4, result));

  const nlohmann::json report = readReport(folder);
  ASSERT_EQ(report["scenes"].size(), 4u);
  const char* names[] = {"torn", "good", "none", "furnace"};
  for (std::size_t i = 0; i < 4; ++i) {
    const nlohmann::json& scene = report["scenes"][i];
    EXPECT_EQ(scene["name"], names[i]);
    const bool bad = i % 2 == 0;
    EXPECT_EQ(scene["error"].is_null(), !bad) << names[i];
    EXPECT_EQ(scene["views"].size(), bad ? 0u : 1u) << names[i];
  }
  for (const std::string& picture : listPictures(report)) EXPECT_TRUE(std::filesystem::exists(folder / picture));

  pugi::xml_document junit;
  ASSERT_TRUE(junit.load_file((folder / "junit.xml").c_str()));
  EXPECT_EQ(junit.select_nodes("//testcase/error").size(), 2u);
  EXPECT_EQ(junit.select_node("//testsuite[1]/testcase/error").node().attribute("message").as_string(),
            report["scenes"][0]["error"]["message"].get<std::string>());
  EXPECT_EQ(junit.select_nodes("//testsuite[4]/testcase[not(error)]").size(), 12u); // 11 spheres and the whole image
}

} // namespace
} // namespace parity::tests

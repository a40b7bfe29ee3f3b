// Names from files attack the formats that a report is written in, and come out as text.
#include <algorithm>

#include <pugixml.hpp>

#include "cli/checks.h"

namespace parity::tests {
namespace {

const char* const kNames[] = {"<script>alert(1)</script>",
                              "\"quoted\" & 'quoted' <b>",
                              "line\nbreak",
                              "]]> --> <!--",
                              "../../../up",

                              "</style></title><img src=x onerror=alert(2)>",
                              "\x1b[31mred\x1b[0m"};

// A row of quads, one a material.
GltfFile makeQuadRow() {
  GltfFile file = makeQuad();
  file.json["nodes"] = nlohmann::json::array();
  file.json["materials"] = nlohmann::json::array();
  file.json["scenes"][0]["nodes"] = nlohmann::json::array();
  const nlohmann::json mesh = file.json["meshes"][0];
  file.json["meshes"] = nlohmann::json::array();
  int index = 0;
  for (const char* name : kNames) {
    file.json["materials"].push_back({{"name", name}});
    file.json["meshes"].push_back(mesh);
    file.json["meshes"][index]["primitives"][0]["material"] = index;
    file.json["nodes"].push_back({{"mesh", index}, {"translation", {1.2 * index, 0, 0}}});
    file.json["scenes"][0]["nodes"].push_back(index);
    ++index;
  }
  return file;
}

class NamesTest : public RenderingTest {};

TEST_F(NamesTest, ThatAttackComeOutAsTextInEveryFormat) {
  const std::string scene = writeGlb(m_folder, makeQuadRow(), "<b onclick='x'>&\x1b[31m\n\xff");
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result =
      runParity(join({{"report", scene, "--orbit", "0,90,0", "-o", folder.string()}, kSun, kSmall}));
  ASSERT_NE(result.exitCode, 4) << result.err;
  EXPECT_FALSE(contains(result.out, "\x1b[31m")) << "a name paints the terminal";

  const nlohmann::json report = readReport(folder);
  const nlohmann::json& materials = report["scenes"][0]["views"][0]["materials"];
  ASSERT_EQ(materials.size(), std::size(kNames));
  EXPECT_EQ(materials[0]["name"], kNames[0]) << "a name is shown, not changed";
  EXPECT_EQ(materials[2]["name"], "line break");

  pugi::xml_document junit;
  ASSERT_TRUE(junit.load_file((folder / "junit.xml").c_str()));
  std::vector<std::string> cases;
  for (const auto& found : junit.select_nodes("//testcase")) cases.push_back(found.node().attribute("name").value());
  EXPECT_EQ(cases.size(), std::size(kNames) + 1);
  for (const std::string name : {kNames[0], kNames[1], kNames[3]})
    EXPECT_TRUE(std::any_of(cases.begin(), cases.end(), [&](const auto& c) { return contains(c, name); })) << name;

  const std::string page = kHasPage ? readWholeFile(folder / "index.html") : std::string();
  for (const char* raw :
       {"<script>alert", "' <b>", "<b onclick", "<img src=x", "]]> -->", "</style></title>", "\x1b", "\xff"})
    EXPECT_FALSE(contains(page, raw)) << raw;
  if (kHasPage) {
    EXPECT_TRUE(contains(page, "\\u003cscript\\u003ealert(1)\\u003c/script\\u003e"));
  }
  for (const std::string& picture : listPictures(report)) {
    EXPECT_TRUE(picture.starts_with("images/") && !contains(picture.substr(7), "/")) << picture;
    EXPECT_TRUE(std::filesystem::exists(folder / picture)) << picture;
  }
}

} // namespace
} // namespace parity::tests

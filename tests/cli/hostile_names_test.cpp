// One table of hostile names, over the commands and the formats in which they come out.
#include <algorithm>

#include <pugixml.hpp>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

const std::vector<std::string> kHostile = {"::stop-commands::tok",
                                           "##[error]owned",
                                           "##vso[task.complete result=Failed]",
                                           "=HYPERLINK(\"http://x\",\"y\")",
                                           "+cmd|' !A0",
                                           "-2+3",
                                           "@SUM(A1)",
                                           "c1 \xC2\x9B"
                                           "31m \xC2\x85 end",
                                           "bidi \u202Egnp.exe\u202C \u2066x\u2069",
                                           "esc \x1b[31mred\x1b]0;title\x07"};

// What a terminal or a CI server would take for more than text; `commands`: lines of our own annotations may stand
// there.
void expectHarmless(const std::string& text, const std::string& where, bool commands = false) {
  for (const std::string& line : linesOf(text)) {
    const std::size_t start = std::min(line.find_first_not_of(" \t\r"), line.size());
    const bool isOurs = commands && (line.starts_with("::error ") || line.starts_with("::warning "));
    EXPECT_FALSE(line.compare(start, 2, "::") == 0 && !isOurs) << where << ": " << line;
    for (const char* part :
         {"##[", "##vso[", "\x1b", "\x07", "\u202E", "\u202C", "\u2066", "\u2069", "\xC2\x9B", "\xC2\x85"})
      EXPECT_FALSE(contains(line, part)) << where << ": " << line;
  }
}

void expectHarmless(const RunResult& result, bool commands = false) {
  expectHarmless(result.out, "stdout of " + result.commandLine, commands);
  expectHarmless(result.err, "stderr of " + result.commandLine, commands);
  EXPECT_NE(result.exitCode, 64) << result.commandLine << result.err;
}

std::vector<std::vector<std::string>> readCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows = {{""}};
  bool quoted = false;
  for (const char c : text) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      rows.back().emplace_back();
    else if (c == '\n' && !quoted)
      rows.push_back({""});
    else if (c != '\r')
      rows.back().back() += c;
  }
  rows.pop_back();
  return rows;
}

void expectNoFormulas(const std::string& csv, const std::string& where) {
  expectHarmless(csv, where);
  for (const std::vector<std::string>& row : readCsv(csv))
    for (const std::string& cell : row) {
      const bool isFormula = !cell.empty() && contains("=+-@", cell.substr(0, 1));
      char* end = nullptr;
      std::strtod(cell.c_str(), &end);
      EXPECT_FALSE(isFormula && *end != '\0') << where << ": " << cell;
    }
}

// A row of quads, one a material; all that has a name has a hostile one.
GltfFile makeHostileScene() {
  GltfFile file = makeQuad();
  const nlohmann::json mesh = file.json["meshes"][0];
  for (const char* list : {"nodes", "materials", "meshes"}) file.json[list] = nlohmann::json::array();
  file.json["scenes"][0]["nodes"] = nlohmann::json::array();
  file.json["scenes"][0]["name"] = kHostile[0];
  file.json["asset"]["generator"] = kHostile[1];
  file.json["asset"]["copyright"] = kHostile[0];
  file.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_variants"};
  for (std::size_t i = 0; i < kHostile.size(); ++i) {
    file.json["materials"].push_back({{"name", kHostile[i]}});
    file.json["meshes"].push_back(mesh);
    file.json["meshes"][i]["name"] = kHostile[i];
    file.json["meshes"][i]["primitives"][0]["material"] = i;
    file.json["nodes"].push_back(
        {{"name", kHostile[i]}, {"mesh", i}, {"translation", {1.2 * static_cast<double>(i), 0, 0}}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(
        {{"name", kHostile[i]}, {"type", "directional"}});
    file.json["nodes"][i]["extensions"]["KHR_lights_punctual"]["light"] = i;
    file.json["extensions"]["KHR_materials_variants"]["variants"].push_back({{"name", kHostile[i]}});
    file.json["scenes"][0]["nodes"].push_back(i);
    file.json["extensionsUsed"].push_back(kHostile[i]);
  }
  return file;
}

class HostileNamesTest : public RenderingTest {
protected:
  // One file of each name that a file can have.
  std::vector<std::string> fileStems() const {
    std::vector<std::string> stems = kHostile;
    std::erase_if(stems, [](const std::string& name) { return contains(name, "/"); });
    return stems;
  }
};

TEST_F(HostileNamesTest, OfScenesAndMaterialsAreTextInEveryFormat) {
  const std::string scene = writeGlb(m_folder, makeHostileScene(), "::stop-commands::tok ##[group]\u202E");
  const std::filesystem::path folder = m_folder / "out";
  RunOptions here; // so that the file's name starts a line
  here.workingFolder = m_folder.path();
  const std::string file = std::filesystem::path(scene).filename().string();
  const std::vector<std::string> view = {"--orbit", "0,90,0"};
  expectHarmless(runParity(join({{"report", file, "-o", folder.string(), "-v", "--costs"}, view, kSun, kSmall}), here));
  expectHarmless(runParity(join({{"diff", file, "--annotate", "github"}, view, kSun, kSmall}), here), true);
  const RunResult json = runParity(join({{"diff", file, "--json", "-"}, view, kSun, kSmall}), here);
  expectHarmless(json);
  const nlohmann::json report = nlohmann::json::parse(json.out);
  std::vector<std::string> names;
  for (const nlohmann::json& material : report["scenes"][0]["views"][0]["materials"]) names.push_back(material["name"]);
  for (const std::size_t i : {0u, 1u, 2u, 3u, 7u, 8u})
    EXPECT_NE(std::ranges::find(names, kHostile[i]), names.end()) << kHostile[i] << ": a name is shown, not changed";
  expectHarmless(runParity({"info", file}, here));
  const RunResult info = runParity({"info", file, "--json", "-"}, here);
  expectHarmless(info);
  EXPECT_EQ(nlohmann::json::parse(info.out)["materials"][1]["name"], kHostile[1]);
  const RunResult suggested = runParity({"budget", "suggest", folder.string()}, here);
  expectHarmless(suggested);
  writeFile(m_folder / "b.toml", suggested.out);
  expectHarmless(runParity({"budget", "check", "b.toml"}, here));
  expectHarmless(runParity({"plot", "env-brdf", file, "-o", "plot"}, here));
  expectNoFormulas(readWholeFile(m_folder / "plot" / "env-brdf-materials.csv"), "env-brdf-materials.csv");
  pugi::xml_document junit;
  EXPECT_TRUE(junit.load_file((folder / "junit.xml").c_str()));

  const std::vector<std::string> bench = join({{"bench", file, "--settings", "highend: default", "--no-truth",
                                                "--rounds", "2", "--preparation-rounds", "2", "--size", "32x32"},
                                               view,
                                               kSun});
  expectHarmless(runParity(bench, here));
  const RunResult csv = runParity(join({bench, {"--csv", "-"}}), here);
  expectHarmless(csv);
  expectNoFormulas(csv.out, "bench --csv -");
  for (const std::string& line : linesOf(csv.out)) EXPECT_FALSE(contains(line, "\uFFFD\r")) << line;
  EXPECT_EQ(readCsv(csv.out).back().size(), readCsv(csv.out).front().size());
  EXPECT_TRUE(nlohmann::json::accept(runParity(join({bench, {"--json", "-"}}), here).out));
}

TEST_F(HostileNamesTest, OfFilesAreTextInMessages) {
  RunOptions here;
  here.workingFolder = m_folder.path();
  for (const std::string& name : fileStems()) {
    const std::string file = "./" + name + ".glb"; // else an option
    writeFile(m_folder / (name + ".glb"), "no glTF");
    for (const std::string& given : {file, name.starts_with("-") ? file : name + ".glb"})
      for (const std::vector<std::string>& command : {std::vector<std::string>{"info", given},
                                                      {"diff", given},
                                                      {"render", given, "--path", "mobile", "-o", "out.png"},
                                                      {"report", given, "-o", "out"},
                                                      {"bake", given, "-o", "baked"},
                                                      {"export", given, "-o", "out.glb"},
                                                      {"flip", given, given},
                                                      {"budget", "check", given},
                                                      {"cache", "info", "--cache", given}}) {
        const RunResult result = runParity(command, here);
        expectHarmless(result);
      }
    const RunResult usage = runParity({"diff", "builtin:furnace", "--size", name}, here);
    expectHarmless(usage.err, usage.commandLine);
    const RunResult unknown = runParity({name}, here);
    expectHarmless(unknown.err, unknown.commandLine);
  }
}

TEST_F(HostileNamesTest, OfPicturesAreTextInFlip) {
  for (const char* folder : {"a", "b"}) {
    std::filesystem::create_directory(m_folder / folder);
    for (const std::string& stem : fileStems())
      base::writeImage8(m_folder / folder / (stem + ".png"), base::Image8(8, 8, 3, folder[0] == 'a' ? 100 : 150));
  }
  RunOptions here;
  here.workingFolder = m_folder.path();
  const std::vector<std::string> flip = {"flip", "a", "b", "--metric", "flip.mean", "--fail", "0.01"};
  expectHarmless(runParity(join({flip, {"--junit", "flip.xml", "--annotate", "github"}}), here), true);
  pugi::xml_document junit;
  EXPECT_TRUE(junit.load_file((m_folder / "flip.xml").c_str()));
  const RunResult csv = runParity(join({flip, {"--csv", "-"}}), here);
  expectHarmless(csv);
  expectNoFormulas(csv.out, "flip --csv -");
  EXPECT_GT(readCsv(csv.out).size(), 5u);
  const RunResult json = runParity(join({flip, {"--json", "-"}}), here);
  expectHarmless(json);
  EXPECT_TRUE(nlohmann::json::accept(json.out));
}

} // namespace
} // namespace parity::tests

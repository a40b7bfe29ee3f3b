// parity flip with many pairs: folders, lists, what is missing, and every form of output.

#include <pugixml.hpp>

#include "base/image/image_io.h"
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

class FlipPairs : public FolderTest {
protected:
  void SetUp() override {
    for (const char* side : {"ref", "test"}) std::filesystem::create_directories(m_folder / side / "sub");
    write("ref/a.png", 1), write("test/a.png", 0.9f);
    write("ref/sub/b.png", 1), write("test/sub/b.png", 1);
  }
  void write(const std::string& name, float gain) const {
    base::writeImage(m_folder / name, makePicture(24, 16, gain));
  }
  nlohmann::json flip(int code, const std::vector<std::string>& more = {}) const {
    return flipJson(join({{path("ref"), path("test")}, more}), code);
  }
};

std::vector<std::string> names(const nlohmann::json& json) {
  std::vector<std::string> names;
  for (const auto& pair : json["pairs"]) names.push_back(pair["name"]);
  return names;
}

TEST_F(FlipPairs, FoldersAreMatchedByPathAndByStemWhereThatLeavesNoChoice) {
  write("ref/c.png", 1), write("test/c.exr", 1);
  const nlohmann::json json = flip(0);
  EXPECT_EQ(names(json), (std::vector<std::string>{"a", "c", "sub/b"}));
  EXPECT_EQ(json["pairs"][2]["identical"], true);
  EXPECT_GT(json["pairs"][0]["regions"][0]["figures"]["metrics"]["flip.mean"], 0);
}

TEST_F(FlipPairs, MissingCounterpartFailsAndTheOthersStillRun) {
  write("ref/only.png", 1), write("test/extra.png", 1);
  write("ref/d.png", 1), write("test/d.exr", 1), write("test/d.hdr", 1);
  const RunResult result = runParity({"flip", path("ref"), path("test")});
  EXPECT_TRUE(exitedWith(4, result));
  const nlohmann::json json = flip(4);
  std::map<std::string, std::string> verdicts, reasons;
  for (const auto& pair : json["pairs"]) {
    verdicts[pair["name"]] = pair["verdict"];
    reasons[pair["name"]] = pair["reason"];
  }
  EXPECT_EQ(verdicts["a"], "not judged");
  EXPECT_EQ(verdicts["sub/b"], "not judged");
  for (const char* name : {"only", "extra"}) {
    EXPECT_EQ(verdicts[name], "error");
    EXPECT_TRUE(contains(reasons[name], "no counterpart")) << reasons[name];
    EXPECT_TRUE(contains(result.err, reasons[name])) << result.err;
    EXPECT_TRUE(contains(result.out, name)) << result.out;
  }
  EXPECT_TRUE(contains(reasons["d.png"], "more than one possible counterpart")) << reasons["d.png"];
  EXPECT_TRUE(contains(linesOf(result.out).back(), "ERROR: 5 of 7 pairs")) << result.out;
}

TEST_F(FlipPairs, UnreadableFileAmongGoodPairsIsItsOwnFailure) {
  write("ref/z.png", 1);
  writeFile(m_folder / "test/z.png", std::string("no picture"));
  const std::string csv = path("out.csv");
  const nlohmann::json json = flip(4, {"--csv", csv});
  EXPECT_EQ(names(json), (std::vector<std::string>{"a", "sub/b", "z"}));
  EXPECT_EQ(json["pairs"][0]["verdict"], "not judged");
  EXPECT_EQ(json["pairs"][2]["verdict"], "error");
  EXPECT_EQ(json["pairs"][2]["exitCode"], 4);
  EXPECT_EQ(linesOf(readWholeFile(csv)).size(), 4u) << "a head and a line a pair";
}

TEST_F(FlipPairs, FoldersWithoutAnyPairAreAnError) {
  std::filesystem::create_directories(m_folder / "none");
  expectRefused(runParity({"flip", path("none"), path("none")}), 4, {"none", "picture"});
  expectRefused(runParity({"flip", path("ref"), path("none")}), 4, {"ref", "nothing to compare"});
  expectRefused(runParity({"flip", path("ref"), path("test/a.png")}), 64, {"a.png", "folder"});
  expectRefused(runParity({"flip", path("ref"), path("nowhere")}), 4, {"nowhere", "does not exist"});
}

TEST_F(FlipPairs, FilesThatArePassedOverAreNamed) {
  writeFile(m_folder / "ref/c.unknown", std::string("x"));
  const nlohmann::json json = flip(0);
  ASSERT_EQ(json["skippedFiles"].size(), 1u);
  EXPECT_TRUE(contains(json["skippedFiles"][0], "c.unknown"));
  EXPECT_TRUE(contains(runParity({"flip", path("ref"), path("test")}).err, "c.unknown"));
}

// What only one pair cannot be compared with is that pair's error.
TEST_F(FlipPairs, OptionThatMakesNoSenseForOnePairLeavesTheOthers) {
  for (const char* side : {"ref", "test"}) {
    const std::string folder = side;
    base::writeImage(m_folder / (folder + "/a.exr"), makePicture(24, 16, 2));
    base::writeImage(m_folder / (folder + "/far.exr"), makePicture(24, 16, 1e-6f));
  }
  const nlohmann::json json =
      flipJson({path("ref"), path("test"), "--hdr", "--metrics", "hdrflip", "--stop-exposure", "5"}, 4);
  std::map<std::string, std::string> verdicts;
  for (const auto& pair : json["pairs"]) verdicts[pair["name"]] = pair["verdict"];
  EXPECT_EQ(verdicts["far"], "error");
  EXPECT_EQ(verdicts["a.exr"], "not judged");
}

TEST_F(FlipPairs, WorstPairDecidesTheExitCode) {
  const std::vector<std::string> limit = {"--metric", "flip.mean", "--fail", "0.001"};
  const nlohmann::json json = flip(2, limit);
  EXPECT_EQ(json["pairs"][0]["verdict"], "fail");
  EXPECT_EQ(json["pairs"][1]["verdict"], "pass");
  base::writeImage(m_folder / "test/sub/b.png", makePicture(8, 8));
  EXPECT_EQ(flip(3, limit)["pairs"][1]["exitCode"], 3);
}

TEST_F(FlipPairs, ListNamesPairsWithCommentsAndQuotes) {
  write("with space.png", 1);
  writeFile(m_folder / "list.txt",
            std::string("\xef\xbb\xbf# nightly\n\nref/a.png test/a.png # one\n\"with space.png\"\tref/a.png\n"
                        "ref/a.png gone.png\n"));
  const nlohmann::json json = flipJson({"--pairs", path("list.txt")}, 4);
  EXPECT_EQ(names(json), (std::vector<std::string>{"ref/a.png", "with space.png", "ref/a.png (2)"}));
  EXPECT_EQ(json["pairs"][1]["identical"], true);
  EXPECT_EQ(json["pairs"][2]["reason"], path("gone.png") + ": does not exist");
}

TEST_F(FlipPairs, ListThatCannotBeMeantIsAnErrorWithItsLine) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    writeFile(m_folder / "list.txt", text);
    expectRefused(runParity({"flip", "--pairs", path("list.txt")}), 4, parts);
  };
  refused("# nothing\n", {"list.txt", "no pairs"});
  refused("ref/a.png test/a.png\nref/a.png\n", {"list.txt", "line 2", "1 path"});
  refused("a b c\n", {"line 1", "3 paths"});
  refused("\"a b\n", {"line 1", "quote"});
  refused("ref/a.png test/a.png\nref/a.png test/a.png\n", {"line 2", "already has this pair"});
  const RunResult both = runParity({"flip", path("ref"), path("test"), "--pairs", path("list.txt")});
  EXPECT_TRUE(exitedWith(64, both));
}

TEST_F(FlipPairs, EachPairHasItsFilesInTheFolders) {
  const std::string out = path("out");
  flip(0, {"-o", out, "--map-kind", "pfm", "--histogram", out});
  EXPECT_EQ(listFiles(out), (std::vector<std::string>{"a.flip.pfm", "a.flip.svg", "sub/b.flip.pfm", "sub/b.flip.svg"}));
  for (const float v : base::readImage(out + "/sub/b.flip.pfm").pixels) ASSERT_EQ(v, 0);
  pugi::xml_document svg;
  ASSERT_TRUE(svg.load_file((out + "/a.flip.svg").c_str()));
  const std::string text = readWholeFile(out + "/a.flip.svg");
  for (const char* word : {"LDR-FLIP of a", "mean 0.", "p95 0.", "share of pixels"})
    EXPECT_TRUE(contains(text, word)) << word;
  EXPECT_TRUE(exitedWith(64, runParity({"flip", path("ref"), path("test"), "-o", path("map.png")})));
  for (const char* folder : {"ref", "test/sub", "test/../ref/new"}) {
    const RunResult result = runParity({"flip", path("ref"), path("test"), "-o", path(folder)});
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_TRUE(contains(result.err, "which holds compared pictures")) << result.err;
  }
}

TEST_F(FlipPairs, CsvHasALineARegionWithAllFigures) {
  write("ref/x, \"y\".png", 1), write("test/x, \"y\".png", 1);
  const RunResult result = runParity({"flip", path("ref"), path("test"), "--csv", "-"});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(exitedWith(0, runParity({"flip", path("ref"), path("test"), "--csv", path("same.csv")})));
  EXPECT_EQ(readWholeFile(path("same.csv")), result.out);
  const std::vector<std::string> lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), 4u) << result.out;
  EXPECT_TRUE(lines[0].starts_with("pair,reference,test,region,range,verdict,exit_code,pixels,non_finite,flip.mean,"));
  EXPECT_TRUE(lines[1].starts_with("a,")) << lines[1];
  EXPECT_TRUE(contains(lines[1], ",image,ldr,not judged,0,384,0,0.")) << lines[1];
  EXPECT_TRUE(lines[3].starts_with("\"x, \"\"y\"\"\",")) << lines[3];
}

TEST_F(FlipPairs, ProgressIsShownOnATerminalOnly) {
  RunOptions terminal;
  terminal.terminal = true;
  const std::vector<std::string> command = {"flip", path("ref"), path("test")};
  EXPECT_TRUE(contains(runParity(command, terminal).err, "sub/b"));
  EXPECT_EQ(runParity(command).err, "");
}

} // namespace
} // namespace parity::tests

// What a report's folder holds for its page: values behind the pictures, a bench, or all in a single file.
#include <array>
#include <cstdio>

#include "cli/checks.h"
#include "report/base64.h"

namespace parity::tests {
namespace {

// By coreutils; the program's own hashes come from CMake.
std::string sha256Of(const std::filesystem::path& file) {
  const auto close = [](std::FILE* pipe) { pclose(pipe); };
  const std::unique_ptr<std::FILE, decltype(close)> pipe(popen(("sha256sum '" + file.string() + "'").c_str(), "r"),
                                                         close);
  std::array<char, 65> hex{};
  EXPECT_EQ(std::fread(hex.data(), 1, 64, pipe.get()), 64u);
  std::vector<std::byte> digest;
  for (std::size_t i = 0; i < 64; i += 2)
    digest.push_back(static_cast<std::byte>(std::stoi(std::string(&hex[i], 2), nullptr, 16)));
  return report::toBase64(digest);
}

std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t at = text.find(open);
  if (at == std::string::npos) return "nothing between " + open + " and " + close;
  return text.substr(at + open.size(), text.find(close, at) - at - open.size());
}

class PageTest : public RenderingTest {
protected:
  RunResult report(const std::string& folder, const std::vector<std::string>& more = {}) const {
    // Its materials are of few pixels each.
    writeFile(m_folder / "budgets.toml",
              "[[material]]\nname = \"*\"\nmin_pixels = 1\nchecks = [ { metric = \"flip.mean\", fail = 0.9 } ]\n");
    return runParity(
        join({{"report", "builtin:furnace", "--size", "32x32", "-o", path(folder), "--budgets", path("budgets.toml")},
              more}));
  }
  std::string text(const std::string& name) const { return readWholeFile(m_folder / name); }

  // As `parity bench` writes it, of no scene. The command tries to end the block that the page holds it in.
  std::string writeBench(const std::string& name) const {
    const nlohmann::json machine = {{"processor", "p"},  {"device", "d"}, {"driver", "r"},
                                    {"deviceKind", "k"}, {"simd", "s"},   {"threads", 2}};
    const nlohmann::json bench = {{"tool", "parity bench"},
                                  {"schema", 2},
                                  {"version", "0"},
                                  {"commandLine", "parity bench '</script><b>.glb'"},
                                  {"startedAt", "now"},
                                  {"machine", machine},
                                  {"rounds", 3},
                                  {"scenes", nlohmann::json::array()}};
    std::filesystem::create_directories((m_folder / name).parent_path());
    writeFile(m_folder / name, bench.dump(1));
    return path(name);
  }
};

const std::vector<std::string> kSingle = {"index.html", "junit.xml", "report.json", "run.json"};

TEST_F(PageTest, ASingleFileHoldsAllThatAFolderHolds) {
  const std::vector<std::string> options = {"--display", "ACES SDR", "--attribution",
                                            "all",       "--bench",  writeBench("bench.json")};
  EXPECT_NE(report("folder", options).exitCode, 4);
  EXPECT_NE(report("single", join({options, {"--single-file", "--pixel-data", "all"}})).exitCode, 4);
  EXPECT_EQ(listFiles(m_folder / "single"), kSingle);
  EXPECT_FALSE(std::filesystem::exists(m_folder / "single" / "images"));
  EXPECT_TRUE(text("single/report.json") == text("folder/report.json"));

  const std::string page = text("single/index.html");
  const nlohmann::json json = readReport(m_folder / "folder");
  const std::vector<std::string> pictures = listPictures(json), values = listPixelFiles(json);
  EXPECT_EQ(pictures.size(), 3u * (1 + 11));
  EXPECT_EQ(values.size(), 3u) << "the view, its terms, the display transform";
  for (const std::string& file : pictures) {
    const std::string content = text("folder/" + file);
    EXPECT_TRUE(between(page, "<script type=\"text/plain\" data-file=\"" + file + "\">", "</script>") ==
                report::toBase64(std::as_bytes(std::span(content))))
        << file;
  }
  for (const std::string& file : values)
    EXPECT_TRUE("parityChunk(" +
                    between(page, "<script type=\"application/json\" data-file=\"" + file + "\">", "</script>") +
                    ");\n" ==
                text("folder/" + file))
        << file;
  for (std::size_t i = 0; i < json["scenes"].size(); ++i) {
    const std::string file = "scenes/" + std::to_string(i) + ".js", script = text("folder/" + file);
    const nlohmann::json scene = nlohmann::json::parse(between(script, "parityScene(", ");\n"));
    EXPECT_EQ(scene["scene"], json["scenes"][i]);
    EXPECT_EQ(nlohmann::json::parse(
                  between(page, "<script type=\"application/json\" data-file=\"" + file + "\">", "</script>")),
              scene);
  }
  EXPECT_FALSE(std::filesystem::exists(m_folder / "single" / "scenes"));
  EXPECT_EQ(nlohmann::json::parse(between(page, "id=\"bench\">", "</script>")),
            nlohmann::json::parse(text("bench.json")));
  EXPECT_TRUE(between(page, "<script>", "</script>") == text("folder/dashboard.js"));
  EXPECT_TRUE(between(page, "<style>", "</style>") == text("folder/dashboard.css"));
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\"");
  EXPECT_TRUE(contains(policy, "script-src 'sha256-" + sha256Of(m_folder / "folder/dashboard.js") + "';")) << policy;
  EXPECT_TRUE(contains(policy, "style-src 'sha256-" + sha256Of(m_folder / "folder/dashboard.css") + "';")) << policy;
}

TEST_F(PageTest, ASingleFileFromTheCacheIsTheSame) {
  const std::vector<std::string> options = join({{"--single-file", "--cache", path("cache")}, kRoughSky});
  EXPECT_NE(report("first", options).exitCode, 4);
  EXPECT_NE(report("again", options).exitCode, 4);
  EXPECT_EQ(nlohmann::json::parse(text("again/run.json"))["cachedScenes"].size(), 1u);
  const auto withoutRun = [&](const std::string& name) {
    const std::string page = text(name), run = between(page, "id=\"run\">", "</script>");
    return std::string(page).replace(page.find(run), run.size(), "");
  };
  EXPECT_TRUE(withoutRun("first/index.html") == withoutRun("again/index.html"));
}

TEST_F(PageTest, ASingleFileHoldsPixelValuesOnlyOnRequestAndTellsItsSize) {
  const RunResult plain = report("plain", {"--single-file"});
  EXPECT_EQ(listPixelFiles(readReport(m_folder / "plain")), std::vector<std::string>{});
  EXPECT_EQ(listPictures(readReport(m_folder / "plain")).size(), 3u * (1 + 11));
  EXPECT_TRUE(contains(plain.out, "plain/index.html (")) << plain.out;
  EXPECT_TRUE(contains(plain.out, " MB)")) << plain.out;
  EXPECT_FALSE(contains(plain.err, "to make it smaller")) << plain.err;
  const RunResult full = report("full", {"--single-file", "--pixel-data", "all"});
  EXPECT_EQ(listPixelFiles(readReport(m_folder / "full")).size(), 1u);
  EXPECT_FALSE(contains(report("folder").out, " MB)")) << "a folder has no one size";
}

TEST_F(PageTest, ALargeSingleFileWarnsAndSaysWhatHelps) {
  nlohmann::json bench = nlohmann::json::parse(readWholeFile(writeBench("bench.json")));
  bench["commandLine"] = std::string(21'000'000, 'x');
  const std::string large = write("large.json", bench.dump());
  const RunResult result = report("out", {"--single-file", "--bench", large});
  EXPECT_NE(result.exitCode, 4) << result.err;
  EXPECT_TRUE(contains(result.err, "warning: " + path("out/index.html") + " is 2")) << result.err;
  EXPECT_TRUE(contains(result.err, "to make it smaller, make the pictures smaller with --size")) << result.err;
  EXPECT_TRUE(contains(result.out, "larger than 20.0 MB")) << result.out;
  const RunResult values = report("out", {"--single-file", "--bench", large, "--pixel-data", "all"});
  EXPECT_TRUE(contains(values.err, "leave out --pixel-data all")) << values.err;
}

TEST_F(PageTest, EachFormReplacesTheOther) {
  EXPECT_NE(report("out", {"--bench", writeBench("bench.json")}).exitCode, 4);
  EXPECT_TRUE(text("out/bench.json") == text("bench.json"));
  const std::vector<std::string> files = listFiles(m_folder / "out");
  writeFile(m_folder / "out/pixels/mine.js", std::string("mine"));
  writeFile(m_folder / "out/dashboard.js", std::string("an older one"));
  EXPECT_NE(report("out", {"--single-file"}).exitCode, 4);
  EXPECT_EQ(listFiles(m_folder / "out"),
            (std::vector<std::string>{"index.html", "junit.xml", "pixels/mine.js", "report.json", "run.json"}));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out/images"));
  std::filesystem::remove(m_folder / "out/pixels/mine.js");
  EXPECT_NE(report("out").exitCode, 4);
  std::vector<std::string> withoutBench = files;
  std::erase(withoutBench, "bench.json");
  EXPECT_EQ(listFiles(m_folder / "out"), withoutBench);
}

TEST_F(PageTest, ValuesAreLeftOutOnRequest) {
  const std::vector<std::string> aces = {"--display", "ACES SDR"};
  EXPECT_NE(report("out", aces).exitCode, 4);
  EXPECT_TRUE(std::filesystem::exists(m_folder / "out/pixels/display.js"));
  EXPECT_NE(report("out", join({aces, {"--pixel-data", "none", "--attribution", "all"}})).exitCode, 4);
  const nlohmann::json json = readReport(m_folder / "out");
  EXPECT_EQ(listPixelFiles(json), std::vector<std::string>{});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out/pixels"));
  EXPECT_EQ(listPictures(json).size(), 3u * (1 + 11));
  EXPECT_TRUE(exitedWith(64, report("other", {"--pixel-data", "some"})));
}

TEST_F(PageTest, ABenchIsShownAndKept) {
  const std::string bench = writeBench("swept/bench.json");
  for (const std::string& given : {bench, path("swept")}) {
    EXPECT_NE(report("out", {"--bench", given}).exitCode, 4);
    EXPECT_TRUE(text("out/bench.json") == text("swept/bench.json"));
    const std::string page = text("out/index.html");
    EXPECT_EQ(nlohmann::json::parse(between(page, "id=\"bench\">", "</script>")),
              nlohmann::json::parse(text("swept/bench.json")));
    EXPECT_FALSE(contains(page, "</script><b>"));
  }
}

TEST_F(PageTest, ABenchThatIsNoneIsRefusedBeforeAnythingIsRendered) {
  writeFile(m_folder / "text.json", std::string("no JSON"));
  writeFile(m_folder / "other.json", std::string(R"({"tool": "parity", "schema": 2})"));
  writeFile(m_folder / "empty.json", std::string());
  std::filesystem::create_directory(m_folder / "empty");
  expectRefused(report("out", {"--bench", path("none.json")}), 4, {"none.json", "does not exist"});
  expectRefused(report("out", {"--bench", path("empty")}), 4, {"bench.json", "does not exist"});
  expectRefused(report("out", {"--bench", path("text.json")}), 4, {"text.json", "JSON"});
  expectRefused(report("out", {"--bench", path("empty.json")}), 4, {"empty.json"});
  expectRefused(report("out", {"--bench", path("other.json")}), 4, {"other.json", "not a sweep of parity bench"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out"));
  const std::string bench = writeBench("out/bench.json");
  expectRefused(report("out", {"--bench", bench}), 64, {"would overwrite --bench"});
}

} // namespace
} // namespace parity::tests

// Help, version, and what goes to stdout and what to stderr.
#include <regex>

#include "cli/checks.h"
#include "scenes/builtin/builtin.h"

namespace parity::tests {
namespace {

// The common options of docs/design.md 8b as far as a subcommand has a use for them.
const std::vector<std::string> kCommon = {"--size",
                                          "--env",
                                          "--env-rotation",
                                          "--sun",
                                          "--sky-light-color",
                                          "--indirect-color-scale",
                                          "--sun-specular-scale",
                                          "--falloff",
                                          "--fog",
                                          "--fog-color",
                                          "--fog-start",
                                          "--fog-opacity",
                                          "--camera",
                                          "--orbit",
                                          "--target",
                                          "--fov",
                                          "--samples",
                                          "--exposure",
                                          "--display",
                                          "--background",
                                          "--device",
                                          "--mobile-preset",
                                          "--precision",
                                          "--fully-rough",
                                          "--threads",
                                          "--cache",
                                          "--no-cache",
                                          "--cache-size",
                                          "-q",
                                          "-v",
                                          "--no-sun-extraction",
                                          "--specular-aa",
                                          "--capture-scale",
                                          "--mixing-begin",
                                          "--mixing-end",
                                          "--mixing-largest",
                                          "--mobile-parallax",
                                          "--no-mobile-light-cap",
                                          "--mobile-pixel-fog",
                                          "--mobile-lightmap",
                                          "--mobile-nonmetal",
                                          "--mobile-target",
                                          "--mobile-textures",
                                          "--direct-lobe",
                                          "--mobile-spot-shadow",
                                          "--mobile-spot-sharpen",
                                          "--mobile-spot-fade",
                                          "--mobile-sun-shadow",
                                          "--mobile-sun-distance",
                                          "--mobile-sun-fade",
                                          "--geometry-term",
                                          "--fresnel",
                                          "--diffuse",
                                          "--compensation",
                                          "--off-specular"};
const std::vector<std::string> kVerdict = {"--material",  "--budgets",     "--json",           "--warn-exit",
                                           "--terms",     "--baseline",    "--annotate",       "--metrics",
                                           "--costs",     "--attribution", "--dropped-lights", "--what-if",
                                           "--approvals", "--as-of",       "--fail-on",        "--summary"};

void expectHelp(const std::vector<std::string>& arguments, const std::vector<std::string>& mentioned) {
  const RunResult result = runParity(arguments);
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_EQ(result.err, "");
  for (const std::string& word : mentioned)
    EXPECT_TRUE(contains(result.out, word)) << "'" << word << "' is not in" << result.commandLine;
  for (const std::string& line : linesOf(result.out)) EXPECT_LE(line.size(), 132u) << line;
}

TEST(Help, NamesEveryBuiltInScene) {
  std::vector<std::string> names;
  for (const std::string& name : scenes::builtinSceneNames()) names.push_back("builtin:" + name);
  expectHelp({"--help"}, names);
}

TEST(Help, NamesTheSubcommandsAndTheExitCodes) {
  for (const char* flag : {"--help", "-h"})
    expectHelp({flag}, {"report", "diff", "render", "flip", "fit", "plot", "bench", "stress", "devices", "cache", "64",
                        "over budget", "builtin:spheres"});
}

TEST(Help, OfEachSubcommandNamesItsOptions) {
  expectHelp({"report", "--help"}, join({kCommon, kVerdict, {"--suite", "--output"}}));
  expectHelp({"diff", "--help"}, join({kCommon, kVerdict}));
  expectHelp({"render", "--help"}, join({kCommon,
                                         {"--path", "--output", "--terms", "--error", "--error-map", "--scattering",
                                          "--shadows", "reference"}}));
  expectHelp({"flip", "--help"}, {"reference",  "test",         "--output",     "--ppd",          "--json",
                                  ".exr",       ".pfm",         ".png",         "--pairs",        "--mask",
                                  "--alpha",    "--background", "--colorspace", "--fail",         "--failpercent",
                                  "--hardfail", "--metric",     "--tonemapper", "linear Rec.709", "fails above 0.05"});
  expectHelp({"approve", "--help"}, {"--material", "--reason", "--owner", "--until", "--yes", "approvals.toml"});
  expectHelp({"budget", "--help"}, {"suggest", "check"});
  expectHelp({"budget", "suggest", "--help"}, {"reports", "--output", "--margin", "--metrics"});
  expectHelp({"fit", "--help"}, {"--geometry-term", "--fresnel", "--compensation", "--format", "hlsl", "--output"});
  expectHelp({"plot", "--help"},
             {"env-brdf", "--paths", "--geometry-term", "--compensation", "--mobile-preset", "--output"});
  expectHelp({"bench", "--help"}, join({kCommon,
                                        {"--suite", "--budget", "--compare", "--settings", "--rounds", "--scaling",
                                         "--no-truth", "--csv", "--output"}}));
  expectHelp({"stress", "--help"},
             {"--only", "--list", "--at", "--functions", "--points", "--device-points", "--renders", "--scenes",
              "--seed", "--seconds", "--output", "--json", "--no-validation"});
  expectHelp({"cache", "--help"}, {"info", "clear"});
  expectHelp({"cache", "clear", "--help"}, {"--cache", "--json"});
  expectHelp({"suite", "list", "--help"}, {"--only", "tag:NAME", "--cache", "--json"});
  expectHelp({"report", "--help"}, {"Do not turn small bright sources", "Mobile path: do not shade"});
  expectHelp({"devices", "--help"}, {"--device", "--json"});
  expectHelp({"completion", "--help"}, {"bash", "zsh", "fish"});
  expectHelp({"man", "--help"}, {"--output"});
}

TEST(Help, VersionIsNameAndNumberThenBuildAndDevice) {
  const RunResult result = runParity({"--version"});
  EXPECT_TRUE(exitedWith(0, result));
  const std::vector<std::string> lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), 3u) << result.out;
  EXPECT_TRUE(std::regex_match(lines[0], std::regex("parity [0-9]+\\.[0-9]+\\.[0-9]+"))) << result.out;
  EXPECT_TRUE(std::regex_match(lines[1], std::regex("build: (GCC|Clang) [0-9.]+.*"))) << result.out;
  EXPECT_TRUE(lines[2].starts_with(missingDriver().empty() ? "device: " : "no Vulkan device: ")) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST(Help, VersionWithoutADriverSaysSo) {
  RunOptions options; // the loader finds no driver there
  for (const char* variable : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"})
    options.environment.emplace_back(variable, "/nowhere/no-driver.json");
  const RunResult result = runParity({"--version"}, options);
  EXPECT_TRUE(exitedWith(0, result));
  ASSERT_EQ(linesOf(result.out).size(), 3u) << result.out;
  EXPECT_TRUE(linesOf(result.out)[2].starts_with("no Vulkan device: ")) << result.out;
}

TEST(Help, IsTheSameByTheCommandHelp) {
  EXPECT_EQ(runParity({"help"}).out, runParity({"--help"}).out);
  EXPECT_EQ(runParity({"help", "report"}).out, runParity({"report", "--help"}).out);
  EXPECT_EQ(runParity({"help", "budget", "suggest"}).out, runParity({"budget", "suggest", "--help"}).out);
  EXPECT_FALSE(runParity({"help", "report"}).out.empty());
}

TEST(Help, HasNoGroupOfManyOptionsAndOnlyTheExitCodesOfTheCommand) {
  for (const char* command : {"report", "diff", "render", "flip", "bench", "explain", "worst", "bake", "stress", "fit",
                              "plot", "info", "export", "contract"}) {
    const std::string help = runParity({command, "--help"}).out;
    EXPECT_FALSE(contains(help, "\nOptions:")) << command << ": options without a heading";
    EXPECT_TRUE(contains(help, "\nExamples:\n  parity " + std::string(command))) << help;
    EXPECT_TRUE(contains(help, "\nExit codes:\n    0  ")) << help;
  }
  EXPECT_FALSE(contains(runParity({"fit", "--help"}).out, "over budget"));
  EXPECT_FALSE(contains(runParity({"report", "--help"}).out, "a new finding"));
  EXPECT_TRUE(contains(runParity({"stress", "--help"}).out, "2  a new finding"));
}

class StreamsTest : public RenderingTest {};

TEST_F(StreamsTest, JsonOnStdoutIsJsonAlone) {
  const std::string budgets = writeBudgets(m_folder, "fail = 0.999");
  const std::filesystem::path folder = m_folder / "out";
  const std::vector<std::vector<std::string>> commands = {
      join({{"diff", "builtin:furnace", "--budgets", budgets, "--timings", "-v", "--json", "-"}, kSmall}),
      join({{"report", "builtin:furnace", "--budgets", budgets, "-o", folder.string(), "--json", "-"}, kSmall}),
      {"devices", "--json", "-"}};
  for (const auto& command : commands) {
    const RunResult result = runParity(command);
    EXPECT_TRUE(exitedWith(0, result));
    EXPECT_TRUE(nlohmann::json::accept(result.out)) << result.commandLine << "\n" << result.out;
  }
  EXPECT_EQ(runParity(commands[1]).out, readWholeFile(folder / "report.json"));
}

TEST_F(StreamsTest, JsonIntoAFileLeavesTheTableOnStdout) {
  const std::filesystem::path file = m_folder / "deep" / "result.json";
  const RunResult result = runParity(join({{"diff", "builtin:furnace", "--json", file.string()}, kSmall}));
  EXPECT_TRUE(contains(result.out, "roughness 0.3")) << result.out;
  EXPECT_TRUE(nlohmann::json::accept(readWholeFile(file)));
  EXPECT_EQ(result.err, "") << "nothing to say";
}

TEST_F(StreamsTest, ReportPrintsItsTableAndWhereThePageLies) {
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(join({{"report", "builtin:furnace", "-o", folder.string()}, kSmall}));
  ASSERT_FALSE(linesOf(result.out).empty());
  EXPECT_EQ(linesOf(result.out).back(),
            kHasPage ? (folder / "index.html").string()
                     : (folder / "report.json").string() + " (this build of parity has no page index.html)");
  EXPECT_FALSE(contains(result.out, "\x1b[")) << "colours are for terminals";
}

TEST_F(StreamsTest, ColoursAndBarGoByTheEnvironment) {
  const std::vector<std::string> command = join({{"diff", "builtin:furnace"}, kSmall});
  RunOptions forced;
  forced.environment = {{"CLICOLOR_FORCE", "1"}};
  EXPECT_TRUE(contains(runParity(command, forced).out, "\x1b[")) << "colours are forced";
  forced.environment.emplace_back("NO_COLOR", "1");
  EXPECT_FALSE(contains(runParity(command, forced).out, "\x1b["));
  RunOptions terminal;
  terminal.terminal = true;
  terminal.environment = {{"TERM", "dumb"}};
  EXPECT_EQ(runParity(command, terminal).err, "") << "no line can be drawn over";
  terminal.environment = {{"NO_COLOR", "1"}, {"TERM", "xterm"}};
  const RunResult plain = runParity(command, terminal);
  EXPECT_TRUE(contains(plain.err, "furnace")) << plain.err;
  EXPECT_FALSE(contains(plain.err, "\x1b")) << "no escapes at all";
  EXPECT_TRUE(plain.err.ends_with(" \r")) << "the bar is left standing";
}

TEST_F(StreamsTest, AReaderThatHasGoneIsNoError) {
  RunOptions closed;
  closed.closesOutput = true;
  const std::vector<std::vector<std::string>> commands = {
      {"--help"}, {"knobs"}, {"report", "--help"}, {"completion", "bash"}, {"--version"}, {"stress", "--list"}};
  for (const std::vector<std::string>& command : commands) {
    const RunResult result = runParity(command, closed);
    EXPECT_TRUE(exitedWith(0, result));
    EXPECT_EQ(result.err, "") << result.commandLine;
  }
  const std::string budgets = writeBudgets(m_folder, "fail = 0.999");
  for (const char* json : {"-", "out.json"}) {
    const RunResult result =
        runParity(join({{"diff", "builtin:furnace", "--budgets", budgets, "--annotate", "github", "--json"},
                        {json == std::string("-") ? json : path(json)},
                        kSmall}),
                  closed);
    EXPECT_TRUE(exitedWith(0, result)) << "the verdict's";
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(StreamsTest, ProgressIsDrawnOnATerminalOnStderrAndWipedAtTheEnd) {
  RunOptions terminal;
  terminal.terminal = true;
  const std::vector<std::string> command = join({{"diff", "builtin:furnace", "--json", "-"}, kSmall});
  const RunResult shown = runParity(command, terminal);
  EXPECT_TRUE(contains(shown.err, "furnace")) << shown.err;
  EXPECT_TRUE(contains(shown.err, " % 0:0")) << "share and elapsed time: " << shown.err;
  EXPECT_TRUE(shown.err.ends_with("\r\x1b[K")) << "the bar is left standing: " << shown.err;
  EXPECT_TRUE(nlohmann::json::accept(shown.out)) << shown.out;
  EXPECT_EQ(runParity(join({command, {"-q"}}), terminal).err, "") << "-q asks for errors only";
}

TEST_F(StreamsTest, QuietKeepsWarningsBackButNotErrors) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"ACME_sheen"};
  const std::vector<std::string> command = join({{"diff", writeExternal(m_folder, file)}, kSun, kSmall});
  EXPECT_TRUE(contains(runParity(command).err, "ACME_sheen"));
  EXPECT_EQ(runParity(join({command, {"-q"}})).err, "");
  expectRefused(runParity({"diff", "builtin:nothing", "-q"}), 4, {"builtin:nothing"});
}

} // namespace
} // namespace parity::tests

// -v: every command says more of what it does, on stderr alone.
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

class Verbose : public RenderingTest {
protected:
  // `words`: what stderr holds with -v and not without.
  void expectMore(const std::vector<std::string>& command, const std::vector<std::string>& words) const {
    const RunResult plain = runParity(command), verbose = runParity(join({command, {"-v"}}));
    EXPECT_EQ(verbose.exitCode, plain.exitCode) << verbose.commandLine << "\n" << verbose.err;
    EXPECT_EQ(verbose.out, plain.out) << verbose.commandLine;
    EXPECT_GT(linesOf(verbose.err).size(), linesOf(plain.err).size()) << verbose.commandLine;
    for (const std::string& word : words) {
      EXPECT_TRUE(contains(verbose.err, word))
          << "'" << word << "' is not in what is said by " << verbose.commandLine << "\n"
          << verbose.err;
      EXPECT_FALSE(contains(plain.err, word)) << plain.commandLine << "\n" << plain.err;
    }
  }
};

TEST_F(Verbose, CommandsThatRenderNameDeviceThreadsSceneAndCache) {
  const std::vector<std::string> words = {"device: opened", "threads: ", "scene builtin:furnace: ", "cache: "};
  expectMore(join({{"diff", "builtin:furnace", "--no-cache"}, kSmall, kRoughSky}),
             join({words, {"surface: ", ": skipped, "}}));
  expectMore(join({{"report", "builtin:furnace", "--no-cache", "-o", path("out")}, kSmall, kRoughSky}), words);
  expectMore(join({{"render", "builtin:furnace", "--path", "mobile", "-o", path("out.exr")}, kSmall}), words);
}

TEST_F(Verbose, CacheTellsWhatItHadAndWhatItKeeps) {
  const std::vector<std::string> command =
      join({{"diff", "builtin:furnace", "-v", "--cache", path("cache"), "--size", "64x64"}, kRoughSky});
  EXPECT_TRUE(contains(runParity(command).err, " is kept, "));
  const RunResult again = runParity(command);
  EXPECT_TRUE(contains(again.err, "furnace: taken from the cache")) << again.err;
  EXPECT_FALSE(contains(again.err, "device: opened")) << "nothing is rendered: " << again.err;
}

TEST_F(Verbose, CommandsThatReadAFileNameIt) {
  const std::string scene = writeGlb(m_folder, makeQuad(), "quad");
  expectMore({"info", scene}, {"read " + scene, "scene " + scene});
  const std::string budgets = writeBudgets(m_folder, "fail = 0.999");
  expectMore({"budget", "check", budgets}, {"read " + budgets});
  runParity(join({{"report", "builtin:furnace", "-o", path("out")}, kSmall}));
  expectMore({"budget", "suggest", path("out")}, {"read " + path("out") + "/report.json"});
  const std::string picture = path("a.png");
  base::writeImage(picture, makePicture(24, 16, 1));
  expectMore({"flip", picture, picture}, {"24 x 16 pixels", "threads: "});
}

TEST_F(Verbose, SoDoAllOthers) {
  expectMore({"devices"}, {"Vulkan loader "});
  expectMore({"cache", "info", "--cache", path("cache")}, {path("cache")});
  expectMore({"knobs"}, {"settings of a run"});
  expectMore({"bench", "builtin:furnace", "--list"}, {" settings"});
  expectMore({"stress", "--list"}, {"threads: "});
  expectMore({"plot", "env-brdf", "-o", path("plot")}, {"plot: ", "threads: "});
}

TEST_F(Verbose, QuietGoesFirst) {
  EXPECT_EQ(runParity(join({{"diff", "builtin:furnace", "-q", "-v"}, kSmall})).err, "");
}

} // namespace
} // namespace parity::tests

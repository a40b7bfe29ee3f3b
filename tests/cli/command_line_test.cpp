// What may be written on the command line, and what it is taken for.
#include <gtest/gtest.h>

#include "cli/invocation.h"
#include "cli/options/command_help.h"

namespace parity::tests {
namespace {

cli::Parsed parse(const std::vector<std::string>& arguments) {
  std::vector<const char*> pointers = {"parity"};
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  return cli::parseCommandLine(static_cast<int>(pointers.size()), pointers.data());
}

template <typename Command> Command commandOf(const std::vector<std::string>& arguments) {
  const cli::Parsed parsed = parse(arguments);
  EXPECT_TRUE(parsed.command && std::holds_alternative<Command>(*parsed.command)) << parsed.text;
  return parsed.command && std::holds_alternative<Command>(*parsed.command) ? std::get<Command>(*parsed.command)
                                                                            : Command();
}

using Words = std::vector<std::string>;

TEST(CommandLine, RepeatableOptionsNeverTakeTheScene) {
  const Words scenes = {"a.glb", "b.glb"}, two = {"metal*", "gold"};
  for (const Words& words : {Words{"report", "--material", "metal*", "--material", "gold", "a.glb", "b.glb"},
                             {"report", "a.glb", "--material", "metal*", "b.glb", "--material", "gold"},
                             {"report", "--material=metal*", "a.glb", "b.glb", "--material", "gold"}}) {
    const auto report = commandOf<cli::ReportCommand>(words);
    EXPECT_EQ(report.scenes, scenes);
    EXPECT_EQ(report.common.settings.materials, two);
  }
  EXPECT_EQ(
      commandOf<cli::ReportCommand>({"report", "--fully-rough", "a", "--fully-rough", "b", "a.glb", "b.glb"}).scenes,
      scenes);
  EXPECT_EQ(commandOf<cli::DiffCommand>({"diff", "--material", "gold", "a.glb"}).scene, "a.glb");
  EXPECT_EQ(
      commandOf<cli::RenderCommand>({"render", "--material", "gold", "a.glb", "-o", "a.png", "--path", "truth"}).scene,
      "a.glb");
  const auto bench = commandOf<cli::BenchCommand>({"bench", "--settings", "*: refit*", "a.glb", "b.glb"});
  EXPECT_EQ(bench.scenes, scenes);
  EXPECT_EQ(bench.trial.settings, Words{"*: refit*"});
  EXPECT_EQ(commandOf<cli::BakeCommand>({"bake", "a.glb", "b.glb", "-o", "out"}).scenes, scenes);
  const auto flip = commandOf<cli::FlipCommand>(
      {"flip", "--ignore-id", "3", "--metric", "flip", "--fail", "0.2", "a.png", "b.png", "--mask", "ids.exr"});
  EXPECT_EQ(flip.reference, "a.png");
  EXPECT_EQ(flip.test, "b.png");
}

TEST(CommandLine, FoldersHaveDefaults) {
  EXPECT_EQ(commandOf<cli::ReportCommand>({"report", "a.glb"}).folder, "parity-report");
  EXPECT_EQ(commandOf<cli::ReportCommand>({"report", "a.glb", "-o", "out"}).folder, "out");
  EXPECT_EQ(commandOf<cli::BakeCommand>({"bake", "a.glb"}).folder, "parity-bake");
  EXPECT_EQ(commandOf<cli::PlotCommand>({"plot", "env-brdf"}).folder, "parity-plot");
}

TEST(CommandLine, EnvironmentsMayBeSeveralWhereScenesAreCompared) {
  const Words both = {"a.hdr", "builtin:sky"};
  for (const Words& words : {Words{"report", "--env", "a.hdr", "a.glb", "--env", "builtin:sky"},
                             {"report", "a.glb", "--environment", "a.hdr", "--env=builtin:sky"}}) {
    const auto report = commandOf<cli::ReportCommand>(words);
    EXPECT_EQ(report.common.environments.size(), 2u);
    EXPECT_EQ(report.scenes, Words{"a.glb"});
  }
  const auto diff = commandOf<cli::DiffCommand>({"diff", "a.glb", "--env", "a.hdr", "--env", "builtin:sky"});
  EXPECT_EQ(diff.common.environments, both);
  EXPECT_EQ(diff.common.settings.scene.environment, "a.hdr") << "of what has room for one";
  EXPECT_EQ(parse({"render", "a.glb", "--env", "a.hdr", "--env", "b.hdr", "-o", "a.png", "--path", "truth"}).exitCode,
            64)
      << "a picture has one light";
  EXPECT_EQ(parse({"report", "--suite", "s.toml", "--env", "a.hdr"}).exitCode, 64);
}

TEST(CommandLine, MetricsAreNamesOfMetricsOrFigures) {
  EXPECT_EQ(commandOf<cli::DiffCommand>({"diff", "a.glb", "--metrics", "ssim.mean,flip"}).common.settings.metrics,
            (Words{"flip", "ssim"}));
  EXPECT_EQ(
      commandOf<cli::BudgetSuggestCommand>({"budget", "suggest", "r.json", "--metrics", "flip,flip.p95,ssim,flip.mean"})
          .options.figures,
      (Words{"flip.mean", "flip.p95", "ssim.mean"}));
  EXPECT_EQ(commandOf<cli::BenchCommand>({"bench", "a.glb", "--budget", "flip=0.02"}).budget->figure, "flip.mean");
  EXPECT_EQ(commandOf<cli::BenchCommand>({"bench", "a.glb", "--budget", "flip.p95=0.02"}).budget->figure, "flip.p95");
}

// The words of a line as a shell splits it, as far as the examples go: up to a pipe.
Words wordsOf(std::string_view line) {
  Words words;
  bool isQuoted = false, isWord = false;
  for (const char c : line) {
    if (c == '\'') {
      isQuoted = !isQuoted, isWord = false;
      if (isQuoted) words.emplace_back(), isWord = true;
    } else if (c == ' ' && !isQuoted) {
      isWord = false;
    } else if ((c == '|' || c == '>') && !isQuoted) {
      break;
    } else {
      if (!isWord) words.emplace_back();
      isWord = true;
      words.back() += c;
    }
  }
  return words;
}

TEST(CommandLine, ExamplesOfTheHelpAreTaken) {
  int tried = 0;
  for (const char* command : {"",       "report", "diff",       "render",      "flip", "budget suggest", "budget check",
                              "fit",    "plot",   "bench",      "stress",      "bake", "devices",        "info",
                              "export", "knobs",  "cache info", "cache clear", "help", "completion",     "man"})
    for (const cli::Example& example : cli::helpOf(command).examples) {
      Words words = wordsOf(example.line);
      if (words.front() != "parity") continue; // of a shell
      words.erase(words.begin());
      EXPECT_EQ(parse(words).exitCode, 0) << example.line << "\n" << parse(words).text;
      ++tried;
    }
  EXPECT_GT(tried, 30);
}

} // namespace
} // namespace parity::tests

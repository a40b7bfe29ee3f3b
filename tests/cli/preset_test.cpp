// Preset folders as a user has them: from a template, in every command that takes a preset, in suites, plans and at
// work.
#include <fstream>
#include <map>
#include <thread>

#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class PresetTest : public RenderingTest {
protected:
  std::string make(const std::string& name, const std::string& glsl,
                   const std::string& toml = "base = \"ue4-2020\"\n") {
    std::filesystem::create_directories(m_folder / name);
    write(name + "/preset.toml", toml);
    write(name + "/preset.glsl", glsl);
    return path(name);
  }
  json diff(const std::vector<std::string>& more) {
    const std::string file = path("diff.json");
    const RunResult result =
        runParity(join({{"diff", "builtin:spheres", "--env", "builtin:sky", "--json", file, "--attribution", "none"},
                        kSmall,
                        kSun,
                        more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    return json::parse(readWholeFile(file)).at("scenes").at(0).at("views").at(0).at("materials");
  }
};

// Straight in roughness and in N.V: its mirrors are dark.
constexpr const char* kLinear = "real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {\n"
                                "  return real2(R(0.25) + R(0.25) * Roughness, R(0.25) - R(0.25) * NoV);\n}\n";
// Half has no 1e-6 squared.
constexpr const char* kNan = "real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV) {\n"
                             "  real a = Roughness * R(0.0001);\n  return real2(a * a / (a * a), R(0.0));\n}\n";

TEST_F(PresetTest, ATemplateIsTheBuiltInPresetInEveryFigure) {
  for (const char* name : {"karis2014", "ue4-2020", "refit"}) {
    const std::string folder = path(name);
    ASSERT_TRUE(exitedWith(0, runParity({"preset", "new", folder, "--from", name})));
    const json own = diff({"--mobile-preset", folder}), builtIn = diff({"--mobile-preset", name});
    ASSERT_EQ(own.size(), builtIn.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_EQ(own[i]["figures"], builtIn[i]["figures"]) << name;
      EXPECT_EQ(own[i]["verdict"], builtIn[i]["verdict"]) << name;
    }
  }
  const std::string folder = path("standard");
  ASSERT_TRUE(exitedWith(0, runParity({"preset", "new", folder, "--from", "standard"})));
  EXPECT_EQ(diff({"--highend-preset", folder}), diff({}));
}

// A = (1 + R)/4 and B = (1 - NoV)/4 in all pixels but those of fully rough materials, in both precisions.
TEST_F(PresetTest, ShadesByItsFormula) {
  const std::string folder = make("linear", kLinear);
  for (const auto& [precision, tolerance] : {std::pair{"fp32", 1e-6f}, std::pair{"fp16", 2e-3f}}) {
    std::map<std::string, base::Image> terms;
    for (const char* term : {"EnvBRDF.A", "EnvBRDF.B", "Roughness", "NoV"})
      terms[term] = render("builtin:spheres", "mobile",
                           {"--env", "builtin:studio", "--mobile-preset", folder, "--precision", precision, "--term",
                            term, "--size", "64x64"});
    double seen = 0;
    for (std::size_t i = 0; i < terms["NoV"].pixels.size(); ++i) {
      const float A = terms["EnvBRDF.A"].pixels[i], roughness = terms["Roughness"].pixels[i];
      if (A == 0 || roughness == 1) continue; // nothing is there, or it is fully rough
      ++seen;
      ASSERT_NEAR(A, 0.25f + 0.25f * roughness, tolerance) << precision;
      ASSERT_NEAR(terms["EnvBRDF.B"].pixels[i], 0.25f - 0.25f * terms["NoV"].pixels[i], tolerance) << precision;
    }
    EXPECT_GT(seen, 1000) << precision;
  }
}

// Its mirrors are dark, which the report says with the cause; a built-in preset's are not.
TEST_F(PresetTest, IsJudgedAsABuiltInPresetIs) {
  const std::string folder = make("linear", kLinear), file = path("diff.json");
  const auto mirror = [&](const std::string& preset) {
    const RunResult result =
        runParity(join({{"diff", "builtin:spheres", "--env", "builtin:studio", "--mobile-preset", preset, "--material",
                         "metal 0.0", "--attribution", "all", "--json", file},
                        kSmall}));
    EXPECT_EQ(result.signal, 0) << result.err;
    return json::parse(readWholeFile(file)).at("scenes").at(0).at("views").at(0).at("materials").at(0);
  };
  const json own = mirror(folder), ue4 = mirror("ue4-2020");
  EXPECT_EQ(own.at("verdict"), "fail");
  EXPECT_TRUE(contains(own.at("bias").get<std::string>(), "EV darker")) << own.at("bias");
  const json& terms = own.at("attribution").at("terms");
  const auto best = std::ranges::min_element(
      terms, {}, [](const json& term) { return term.at("flip").is_null() ? 1. : term.at("flip").get<double>(); });
  EXPECT_EQ(best->at("term"), "skySpecular");
  EXPECT_NE(ue4.at("verdict"), "fail");
}

TEST_F(PresetTest, StandsWhereverAPresetMay) {
  const std::string folder = make("linear", kLinear);
  const auto says = [&](const std::vector<std::string>& arguments, const std::string& part) {
    const RunResult result = runParity(arguments);
    EXPECT_TRUE(contains(result.out, part)) << result.commandLine << "\n" << result.out << result.err;
  };
  says({"bench", "--list", "--mobile-preset", folder}, "linear@");
  says({"plot", "env-brdf", "--mobile-preset", folder, "-o", path("plot")}, "env-brdf.png");
  says(join({{"explain", "builtin:spheres", "--env", "builtin:sky", "--mobile-preset", folder, "--switch",
              "formulas=refit"},
             kSmall}),
       "environment BRDF and direct lobe of refit");
  const json whatIf = diff({"--what-if", folder});
  EXPECT_EQ(whatIf.at(0).at("whatIf").at(0).at("figures"), diff({"--mobile-preset", folder}).at(0).at("figures"));
  EXPECT_TRUE(contains(runParity({"report", "--help"}).out, "refit} or FOLDER"));
  const RunResult wrong = runParity(
      {"diff", "builtin:spheres", "--what-if", make("bad", "real presetCaptureMip(real r) {\n return s; }\n")});
  EXPECT_EQ(wrong.exitCode, 4);
  EXPECT_TRUE(contains(wrong.err, "bad/preset.glsl: line 2: 's'")) << wrong.err;
}

// A suite names it relative to its own folder; workers, plans and this process come to the same report.
TEST_F(PresetTest, IsInSuitesAndPlansAndKnownByItsContent) {
  make("linear", kLinear);
  write("s.toml", "[defaults]\nenvironment = \"builtin:sky\"\n[[scene]]\nfile = \"builtin:spheres\"\npresets = "
                  "[\"ue4-2020\", \"./linear\"]\nname = \"{preset}\"\n");
  const std::vector<std::string> small = {"--size", "32x32", "--no-pixel-data"};
  const auto report = [&](const std::string& out, const std::vector<std::string>& more) {
    const RunResult result =
        runParity(join({{"report", "--suite", path("s.toml"), "-o", path(out), "--size", "32x32"}, more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    return readReport(m_folder / out);
  };
  const json here = report("here", {}), workers = report("workers", {"--jobs", "2"});
  ASSERT_EQ(here["scenes"].size(), 2u);
  EXPECT_EQ(here["scenes"][0]["name"], "ue4-2020");
  EXPECT_EQ(here["scenes"][1]["name"], "linear");
  EXPECT_NE(here["scenes"][0]["views"], here["scenes"][1]["views"]);
  EXPECT_EQ(here["scenes"], workers["scenes"]);

  ASSERT_TRUE(exitedWith(0, runParity({"plan", "--suite", path("s.toml"), "-o", path("plan"), "--size", "32x32"})));
  make("linear", kLinear + ("// " + path("") + "\n")); // which no earlier run of this test has cached
  const RunResult work = runParity({"work", path("plan")});
  EXPECT_NE(work.exitCode, 0);
  EXPECT_TRUE(contains(work.err, "linear: has changed since the run began")) << work.err;
  // The cache knows its content: it is compared anew, and the other scene is not.
  const RunResult again = runParity({"report", "--suite", path("s.toml"), "-o", path("again"), "--size", "32x32"});
  EXPECT_TRUE(contains(again.err, "1 of 2 scenes are unchanged")) << again.err;
}

TEST_F(PresetTest, WrongFormulasAreToldWithFileAndLine) {
  const std::string folder = make("wrong", "real presetCaptureMip(real Roughness) {\n  return Rougness;\n}\n");
  expectRefused(runParity({"diff", "builtin:spheres", "--mobile-preset", folder}), 4,
                {"wrong/preset.glsl: line 2: 'Rougness' : undeclared identifier"});
  write("s.toml", "[[scene]]\nfile = \"builtin:spheres\"\nmobile_preset = \"./none\"\n");
  expectRefused(runParity({"report", "--suite", path("s.toml"), "-o", path("out")}), 4, {"none: does not exist"});
  EXPECT_EQ(runParity({"render", "builtin:spheres", "--path", "mobile", "-o", path("a.png"), "--watch"}).exitCode, 64);
}

// A suite that is named without a folder means the folder beside it, whatever presets are called.
TEST_F(PresetTest, AFolderOfASuiteMayBeCalledAsAPreset) {
  make("refit", "real presetCaptureMip(real Roughness) {\n  return Rougness;\n}\n");
  write("s.toml", "[[scene]]\nfile = \"builtin:spheres\"\nmobile_preset = \"./refit\"\n");
  RunOptions here;
  here.workingFolder = path("");
  const RunResult result = runParity({"suite", "list", "s.toml"}, here);
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_TRUE(contains(result.err, "./refit/preset.glsl: line 2: 'Rougness'")) << result.err;
}

TEST_F(PresetTest, StressAndStudySayWhereItIsNan) {
  const std::string folder = make("nan", kNan, "base = \"karis2014\"\n");
  const RunResult stress = runParity({"stress", "--only", "renders", "--renders", "roughness*", "--scenes", "0",
                                      "--mobile-preset", folder, "--json", path("stress.json")});
  EXPECT_EQ(stress.exitCode, 2) << stress.err;
  EXPECT_TRUE(contains(readWholeFile(path("stress.json")), "nan@"));
  EXPECT_FALSE(contains(readWholeFile(path("stress.json")), "mobile ue4-2020 fp16"));

  const RunResult study = runParity({"study-preset", folder, "karis2014", "--env", "builtin:sky", "--size", "48x48",
                                     "-o", path("study"), "--scene", "builtin:spheres"});
  EXPECT_EQ(study.exitCode, 2) << study.err;
  const json presets = json::parse(readWholeFile(path("study/study.json"))).at("presets");
  ASSERT_EQ(presets.size(), 2u);
  for (const json& stressed : presets[0]["stress"]) {
    const bool isBrdf = stressed["function"] == "environment BRDF";
    EXPECT_EQ(stressed["nan"].get<int>() > 0, isBrdf || stressed["function"] == "environment BRDF of nonmetals" ||
                                                  contains(stressed["function"], "lobe"))
        << stressed;
    if (isBrdf && stressed["precision"] == "fp16") {
      EXPECT_TRUE(contains(stressed["first"], "roughness 0")) << stressed;
    }
  }
  // Karis' fit against the table, F0 = 1: the article's formula is known to be .127 off (docs/shading.md 2b).
  const json& error = presets[1]["envBrdf"][1];
  EXPECT_EQ(error["F0"], 1);
  EXPECT_NEAR(error["rms"].get<double>(), 0.127, 0.003);
  EXPECT_GT(presets[1]["scenes"][0]["operations"], 200);
  const std::string page = readWholeFile(path("study/index.html"));
  EXPECT_TRUE(contains(page, "env-brdf-2.png") && contains(page, "nan@") && contains(page, "karis2014"));
  EXPECT_TRUE(std::filesystem::exists(path("study/env-brdf-1.png")));
}

// One picture at the start, one after an edit, and a mistake that is said while the program goes on.
TEST_F(PresetTest, WatchDrawsAgainAfterEveryEdit) {
  const std::string folder = make("mine", kLinear);
  std::string first, second;
  std::thread editor([&] {
    const auto waitFor = [&](const auto& isThere) {
      for (int i = 0; i < 600 && !isThere(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    };
    const auto size = [&] { return std::filesystem::exists(path("w.pfm")) ? readWholeFile(path("w.pfm")) : ""; };
    waitFor([&] { return !size().empty(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    first = size();
    make("mine", "real2 presetEnvironmentBrdf(real3 S, real Roughness, real NoV) { return real2(R(1.0), R(0.0)); }\n");
    waitFor([&] { return size() != first; });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    second = size();
    make("mine", "real2 presetEnvironmentBrdf(real3 S) { return real2(R(1.0)); }\n");
  });
  RunOptions options;
  options.interruptAt = "has other parameters";
  const RunResult result = runParity({"render", "builtin:spheres", "--env", "builtin:studio", "--path", "mobile",
                                      "--mobile-preset", folder, "--size", "48x48", "-o", path("w.pfm"), "--watch"},
                                     options);
  editor.join();
  EXPECT_TRUE(exitedWith(0, result)) << result.err;
  EXPECT_TRUE(contains(result.err, "mine/preset.glsl: line 1: presetEnvironmentBrdf has other parameters"));
  EXPECT_NE(first, second);
  EXPECT_EQ(second, readWholeFile(path("w.pfm")));
  EXPECT_GE(std::ranges::count(result.out, '\n'), 2);
}

TEST_F(PresetTest, TheFunctionsOfTheDocumentationAreTheShaders) {
  const RunResult result = runParity({"preset", "functions"});
  ASSERT_TRUE(exitedWith(0, result));
  const std::string page = readWholeFile(std::filesystem::path(PARITY_SOURCE_DIR) / "docs" / "presets.md");
  EXPECT_TRUE(contains(page, result.out)) << "docs/presets.md: put the output of 'parity preset functions' into it";
}

} // namespace
} // namespace parity::tests

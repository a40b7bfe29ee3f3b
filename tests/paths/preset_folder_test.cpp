// Preset folders: what they may hold, and what is refused, with the line.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "highend/programs.h"
#include "mobile/knobs.h"
#include "mobile/programs.h"
#include "paths/preset/preset_folder.h"
#include "paths/preset/preset_template.h"
#include "scenes/gltf/gltf_writer.h"

namespace parity::paths {
namespace {

class PresetFolderTest : public testing::Test {
protected:
  ~PresetFolderTest() override { forgetPresetFolders(); }

  std::string make(const std::string& name, const std::string& glsl,
                   const std::string& toml = "base = \"ue4-2020\"\n") const {
    const std::filesystem::path folder = m_folder / name;
    std::filesystem::create_directories(folder);
    tests::writeFile(folder / "preset.toml", toml);
    if (!glsl.empty()) tests::writeFile(folder / "preset.glsl", glsl);
    return folder.string();
  }
  // The error of a folder, without the folder's own path.
  std::string refusal(const std::string& folder, const PresetHost& host = mobile::presetHost()) const {
    try {
      readPresetFolder(folder, host);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::failed);
      std::string line = error.what();
      const std::string root = m_folder.path().string() + "/";
      if (const std::size_t at = line.find(root); at != std::string::npos) line.erase(at, root.size());
      return line;
    }
    return "accepted";
  }

  const tests::TempFolder m_folder;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kMip = "real presetCaptureMip(real Roughness) { return Roughness * R(5.0); }\n";

TEST(PresetFunction, IsReadFromTheDeclarationsOfTheShader) {
  const std::vector<PresetFunction> functions = mobile::presetHost().functions;
  ASSERT_EQ(functions.size(), 9u);
  EXPECT_EQ(functions[0].name, "presetEnvironmentBrdf");
  EXPECT_EQ(functions[0].prototype, "real2 presetEnvironmentBrdf(real3 SpecularColor, real Roughness, real NoV);");
  for (const PresetFunction& function : functions) {
    EXPECT_NE(function.prototype.find(" " + function.name + "("), std::string::npos) << function.prototype;
    EXPECT_GT(function.words.size(), 60u) << function.name;
  }
  EXPECT_EQ(highend::presetHost().functions.size(), 5u);
}

TEST(PresetFunction, IsFoundWhereItIsDefinedOutsideOfOthers) {
  const std::vector<DefinedFunction> defined = definedFunctionsOf("// real a(real x) { }\n"
                                                                  "#define M(x) { \\\n x }\n"
                                                                  "/* real b() {} */ real c(real x,\n real y) {\n"
                                                                  "  if (x > y) { return d(x); }\n}\n"
                                                                  "real e(real x);\nstruct S { real f; };\n"
                                                                  "vec2 g [3](int i)\n{ }\n");
  std::vector<std::string> names;
  for (const DefinedFunction& each : defined) names.push_back(each.name);
  ASSERT_EQ(names.front(), "c");
  EXPECT_EQ(defined.front().line, 4u);
  EXPECT_EQ(std::ranges::count(names, "a") + std::ranges::count(names, "b") + std::ranges::count(names, "e"), 0);
}

TEST_F(PresetFolderTest, HasItsBasesOptionsItsKnobsAndItsFunctions) {
  const std::string folder =
      make("mine", kMip, "base = \"karis2014\"\n[knobs]\nsky_sh = \"9\"\nmobile_local_lights = true\n");
  const mobile::Options options = mobile::optionsOfFolder(folder, {});
  EXPECT_EQ(options.environmentBrdf, mobile::EnvironmentBrdf::karis2014);
  EXPECT_EQ(options.roughnessFloor, 0);
  EXPECT_EQ(options.sky, mobile::SkyForm::sh9);
  EXPECT_TRUE(options.localLights);
  EXPECT_EQ(options.own->functions(), std::vector<std::string>{"presetCaptureMip"});
  EXPECT_EQ(options.preset, options.own->text());
  EXPECT_TRUE(options.preset.starts_with("mine@"));
  EXPECT_TRUE(options.own->reference().starts_with(folder + "@"));
}

TEST_F(PresetFolderTest, KeepsWhatNoPresetSets) {
  mobile::Options plain;
  plain.precision = mobile::Precision::fp32;
  plain.lightCap = false;
  const mobile::Options options = mobile::optionsOfFolder(make("mine", kMip), plain);
  EXPECT_EQ(options.precision, mobile::Precision::fp32);
  EXPECT_FALSE(options.lightCap);
}

TEST_F(PresetFolderTest, IsNamedByItsContent) {
  const std::string a = readPresetFolder(make("a", kMip), mobile::presetHost())->reference();
  const std::string folder = make("b", std::string(kMip) + "// more\n");
  const std::string b = readPresetFolder(folder, mobile::presetHost())->reference();
  EXPECT_NE(a.substr(a.rfind('@')), b.substr(b.rfind('@')));
  EXPECT_EQ(readPresetFolder(b, mobile::presetHost())->reference(), b);
  EXPECT_EQ(readPresetFolder(folder + "/", mobile::presetHost())->reference(), b);
}

// A run reads a folder once; another one, which expects what the first has read, says that it has changed.
TEST_F(PresetFolderTest, IsReadOnceARun) {
  const std::string folder = make("mine", kMip);
  const std::string text = readPresetFolder(folder, mobile::presetHost())->reference();
  make("mine", std::string(kMip) + "// changed\n");
  EXPECT_EQ(readPresetFolder(folder, mobile::presetHost())->reference(), text);
  forgetPresetFolders();
  EXPECT_NE(refusal(text).find("mine: has changed since the run began: its hash is "), std::string::npos);
  EXPECT_NE(readPresetFolder(folder, mobile::presetHost())->reference(), text);
}

TEST_F(PresetFolderTest, IsRefusedWithFileLineAndReason) {
  EXPECT_EQ(refusal((m_folder / "none").string()), "none: does not exist");
  tests::writeFile(m_folder / "file", "x");
  EXPECT_EQ(refusal((m_folder / "file").string()), "file: is no folder; a preset is a folder with preset.toml");
  std::filesystem::create_directories(m_folder / "bare");
  tests::writeFile(m_folder / "bare" / "preset.glsl", kMip);
  EXPECT_EQ(refusal((m_folder / "bare").string()),
            "bare: has no preset.toml; 'parity preset new' writes a folder to start from");
  EXPECT_TRUE(refusal(make("toml", kMip, "base = \n")).starts_with("toml/preset.toml: line 1: "));
  EXPECT_EQ(refusal(make("nobase", kMip, "path = \"mobile\"\n")),
            "nobase/preset.toml: line 1: base: is missing; it is the preset to start from: karis2014, ue4-2020, refit");
  EXPECT_EQ(refusal(make("base", kMip, "base = \"ue4\"\n")),
            "base/preset.toml: line 1: base: 'ue4' is unknown; known: karis2014, ue4-2020, refit");
  EXPECT_EQ(refusal(make("path", kMip, "path = \"highend\"\n")),
            "path/preset.toml: line 1: path: 'highend' is not the path that it is used for (mobile)");
  EXPECT_TRUE(
      refusal(make("key", kMip, "base = \"refit\"\n[knobs]\nsky_sj = \"9\"\n"))
          .starts_with("key/preset.toml: line 3: sky_sj: unknown key in the knobs of a preset; did you mean 'sky_sh'"));
  EXPECT_EQ(refusal(make("unknown", "real presetCaptureMap(real r) { return r; }\n")),
            "unknown/preset.glsl: line 1: the path mobile has no function 'presetCaptureMap' to define; did you mean "
            "'presetCaptureMip'?");
  EXPECT_TRUE(refusal(make("nothing", "real other(real r) { return r; }\n"))
                  .starts_with("nothing/preset.glsl: defines none of the functions of the path mobile: presetEnv"));
  EXPECT_EQ(refusal(make("alone", "real presetEnvironmentBrdfNonmetal(real R, real N) { return R; }\n")),
            "alone/preset.glsl: defines presetEnvironmentBrdfNonmetal without presetEnvironmentBrdf, which must be "
            "defined, too");
}

TEST_F(PresetFolderTest, IsRefusedWhereItDoesNotCompile) {
  EXPECT_EQ(refusal(make("name", "\nreal presetCaptureMip(real Roughness) {\n  return Rougness;\n}\n")),
            "name/preset.glsl: line 3: 'Rougness' : undeclared identifier");
  EXPECT_EQ(refusal(make("sign", "\nreal presetCaptureMip(real Roughness, real x) { return x; }\n")),
            "sign/preset.glsl: line 2: presetCaptureMip has other parameters; expected: real presetCaptureMip(real "
            "Roughness);");
  EXPECT_TRUE(refusal(make("type", "real3 presetCaptureMip(real Roughness) { return real3(Roughness); }\n"))
                  .starts_with("type/preset.glsl: line 1: "));
  EXPECT_TRUE(refusal(make("end", std::string(kMip) + "const float x = 1.0"))
                  .starts_with("end/preset.glsl: at the end: '' :  syntax error, "));
  // Half has no implicit conversion from float; the program in fp32 alone would take it.
  EXPECT_TRUE(refusal(make("half", "real presetCaptureMip(real Roughness) {\n  float x = 2.0;\n  return x;\n}\n"))
                  .starts_with("half/preset.glsl: line 3: "));
}

TEST_F(PresetFolderTest, OpensNoOtherFile) {
  tests::writeFile(m_folder / "outside.glsl", "const real kOutside = R(1.0);\n");
  for (const char* path : {"../outside.glsl", "/etc/passwd", "more/x.glsl"})
    EXPECT_TRUE(refusal(make("inc", std::string("#include \"") + path + "\"\n" + kMip))
                    .starts_with("inc/preset.glsl: line 1: '#include' : Could not process include directive"))
        << path;
  const std::string folder = make("inside", std::string("#include \"more.glsl\"\n") + kMip);
  tests::writeFile(std::filesystem::path(folder) / "more.glsl", "const real kMore = R(1.0);\n");
  EXPECT_EQ(refusal(folder), "accepted");
  tests::writeFile(std::filesystem::path(folder) / "more.glsl", "const real kMore = ;\n");
  forgetPresetFolders();
  EXPECT_TRUE(refusal(folder).starts_with("inside/more.glsl: line 1: "));
}

TEST_F(PresetFolderTest, IsRefusedBeyondTheLimits) {
  const auto body = [](const std::string& before, const std::string& statements) {
    return before + "real presetCaptureMip(real Roughness) {\n" + statements + "\n  return Roughness;\n}\n";
  };
  EXPECT_EQ(refusal(make("endless",
                         body("", "  real x = Roughness;\n  while (x >= R(0.0)) x = x * R(0.5);\n  Roughness = x;"))),
            "endless/preset.glsl: line 3: a loop from here on has no number of turns that is known before it runs; use "
            "'for' with constants");
  EXPECT_TRUE(
      refusal(make("long", body("", "  for (int i = 0; i < 1000; ++i)\n    for (int k = 0; k < 1000; ++k) Roughness = "
                                    "sqrt(Roughness + R(0.5));")))
          .starts_with("long/preset.glsl: line 2: with the loops from here on a pixel takes "));
  EXPECT_EQ(refusal(make("short", body("", "  for (int i = 0; i < 8; ++i) Roughness = sqrt(Roughness + R(0.5));"))),
            "accepted");
  EXPECT_EQ(refusal(make("array", body("float big[100000];\n", "  big[int(Roughness)] = 1.0;"))),
            "array/preset.glsl: has arrays of 100000 elements, expected at most 4096");
  EXPECT_EQ(refusal(make("texture", body("layout(set = 1, binding = 40) uniform sampler2D mine;\n",
                                         "  Roughness = real(textureLod(mine, vec2(0.5), 0.0).x);"))),
            "texture/preset.glsl: declares a resource (set 1, binding 40) beside those of the path mobile");
  // What hides behind macros, in arrays of arrays, in itself.
  EXPECT_TRUE(contains(
      refusal(make("macro", "#define AGAIN while\n" + body("", "  real x = Roughness;\n  AGAIN (x >= R(0.0)) x = "
                                                               "x * R(0.5);\n  Roughness = x;"))),
      "has no number of turns that is known"));
  EXPECT_TRUE(
      contains(refusal(make("knob", body("", "  real x = Roughness;\n  if (kBaked != 0u) while (x >= R(0.0)) x = x * "
                                             "R(0.5);\n  Roughness = x;"))),
               "has no number of turns that is known"));
  EXPECT_TRUE(contains(refusal(make("nested", body("float big[4096][64];\n", "  big[int(Roughness)][1] = 1.0;"))),
                       "has arrays of 262144 elements"));
  EXPECT_TRUE(
      contains(refusal(make("again", body("layout(set = 0, binding = 1, std430) buffer Mine { uint mine[]; };\n",
                                          "  mine[0] = 1u;"))),
               "declares a resource (set 0, binding 1) beside those of the path mobile"));
  EXPECT_TRUE(contains(refusal(make("shared", body("shared float mine[8];\n", "  mine[0] = 1.0;\n  barrier();"))),
                       "has a specialization constant, a shared variable or a barrier"));
  EXPECT_TRUE(contains(refusal(make("itself", "#include \"preset.glsl\"\n" + std::string(kMip))),
                       "itself/preset.glsl: line 1"));
  EXPECT_TRUE(refusal(make("large", std::string(kMaxPresetFileBytes + 1, ' '))).starts_with("large/preset.glsl: "));
}

// Editors leave locks and copies; what no file includes is not compiled.
TEST_F(PresetFolderTest, IgnoresHiddenAndUnusedFiles) {
  const std::string folder = make("mine", kMip);
  tests::writeFile(std::filesystem::path(folder) / "old.glsl", "real presetSpotCone(real a) { return a; }\n");
  std::filesystem::create_symlink("nowhere", std::filesystem::path(folder) / ".#preset.glsl");
  EXPECT_EQ(refusal(folder), "accepted");
}

TEST_F(PresetFolderTest, RefusesASettingThatItsFunctionReplaces) {
  const std::string folder =
      make("mine",
           "real3 presetDirectLobe(MobileShadingModelContext c, MobileFrame f, real32x3 L, real NoL) "
           "{ return real3(NoL); }\n",
           "base = \"ue4-2020\"\n[knobs]\ndirect_lobe = \"d-approx\"\n");
  try {
    mobile::optionsOfFolder(folder, {});
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_TRUE(contains(error.what(), "preset.toml: line 3: direct_lobe: has no effect beside presetDirectLobe"));
    EXPECT_EQ(error.code(), base::ExitCode::failed);
  }
}

TEST_F(PresetFolderTest, EveryTemplateCompiles) {
  for (const PresetHost* host : {&mobile::presetHost(), &highend::presetHost()})
    for (const std::string& name : presetTemplates(*host)) {
      const std::string folder = (m_folder / name).string();
      writePresetTemplate(*host, name, folder);
      EXPECT_EQ(refusal(folder, *host), "accepted") << name;
      const auto preset = readPresetFolder(folder, *host);
      if (preset->functions().empty()) continue;
      EXPECT_GT(preset->program({"PARITY_LOBES"}).size(), 1000u) << name;
      EXPECT_THROW(writePresetTemplate(*host, name, folder), base::Error); // there are files already
    }
  EXPECT_GE(presetTemplates(mobile::presetHost()).size(), 6u);
}

} // namespace
} // namespace parity::paths

// No work that a scene does not need: the counters of report.json, not times. Each pass is counted where it is done.
#include <map>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

struct Passes {
  std::map<std::string, std::uint64_t> counts;
  std::map<std::string, std::string> reasons;
  nlohmann::json permutations;
  std::uint64_t operator[](const std::string& name) const { return counts.at(name); }
  const std::string& why(const std::string& name) const { return reasons.at(name); }
};

class PassesTest : public RenderingTest {
protected:
  static Passes passesOf(const nlohmann::json& scene) {
    Passes passes;
    for (const nlohmann::json& pass : scene["passes"]) {
      const std::string name = pass["name"];
      EXPECT_EQ(passes.counts.count(name), 0u) << name << " stands twice";
      passes.counts[name] = pass["count"];
      passes.reasons[name] = pass["skipped"].is_null() ? "" : pass["skipped"].get<std::string>();
      EXPECT_EQ(pass["count"] == 0, !pass["skipped"].is_null()) << name << " runs or says why not";
    }
    passes.permutations = scene["permutations"];
    return passes;
  }
  static Passes run(const std::string& scene, const std::vector<std::string>& options) {
    // What attribution shades once more is AttributionTest's.
    const RunResult result =
        runParity(join({{"diff", scene, "--json", "-", "--attribution", "none"}, kSmall, options}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_TRUE(report["scenes"][0]["error"].is_null());
    return passesOf(report["scenes"][0]);
  }
  std::string writeQuad(const std::function<void(GltfFile&)>& edit = {}) const {
    GltfFile file = makeQuad();
    if (edit) edit(file);
    return writeEmbedded(m_folder, std::move(file), "quad");
  }
  void paint(const std::string& file) const { base::writeImage8(m_folder / file, base::Image8(8, 8, 3, 120)); }
};

// Lights over the quad, all of this range (0: infinite).
std::function<void(GltfFile&)> addLights(int count, float range) {
  return [=](GltfFile& file) {
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    nlohmann::json light = {{"type", "point"}, {"intensity", 2}};
    if (range > 0) light["range"] = range;
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    for (int i = 0; i < count; ++i) {
      file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
      file.json["nodes"].push_back(
          {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0.1 * i, 0.5, 0.3}}});
    }
  };
}

TEST_F(PassesTest, OfFewOrUnboundedLocalLightsAreNoLists) {
  const Passes many = run(writeQuad(addLights(12, 1)), {});
  EXPECT_EQ(many["local lights"], 12u);
  EXPECT_GT(many["culling of local lights"], 0u);
  for (const auto& lights : {addLights(3, 1), addLights(12, 0)}) {
    const Passes few = run(writeQuad(lights), {});
    EXPECT_EQ(few["culling of local lights"], 0u);
    EXPECT_EQ(few.why("culling of local lights"), "few lights, or lights without a range");
  }
  EXPECT_EQ(run(writeQuad(), kSun).why("culling of local lights"), "no local lights");
}

TEST_F(PassesTest, WithoutEnvironmentNothingIsPrefilteredAndNoTableRead) {
  const std::string quad = writeQuad();
  const Passes sun = run(quad, kSun);
  EXPECT_EQ(sun["environment prefilter and SH"], 0u);
  EXPECT_EQ(sun.why("environment prefilter and SH"), "no environment");
  EXPECT_EQ(sun["sun extraction"], 0u);
  EXPECT_EQ(sun["environment BRDF table"], 1u) << "the balance of energy reads it for lights, too";
  const Passes plain = run(quad, join({kSun, {"--compensation", "none", "--diffuse", "lambert"}}));
  EXPECT_EQ(plain["environment BRDF table"], 0u);
  EXPECT_EQ(plain.why("environment BRDF table"), "no environment, no compensation, no balanced diffuse lobe");

  const Passes sky = run(quad, {"--env", "builtin:white", "--compensation", "none", "--diffuse", "lambert"});
  EXPECT_EQ(sky["environment prefilter and SH"], 2u) << "fine levels for the high-end path, the first for mobile";
  EXPECT_EQ(sky["environment BRDF table"], 1u);
  EXPECT_EQ(sky["sun extraction"], 1u);
  EXPECT_EQ(sky["directional lights"], 0u);
}

TEST_F(PassesTest, LightsThatAreNotThereAreNeitherChosenNorLoopedOver) {
  const Passes sun = run(writeQuad(), kSun);
  EXPECT_EQ(sun["directional lights"], 1u);
  for (const char* pass : {"local lights", "choice of local lights"}) {
    EXPECT_EQ(sun[pass], 0u) << pass;
    EXPECT_EQ(sun.why(pass), "no local lights") << pass;
  }
  const Passes lamps = run("builtin:lamps", {});
  EXPECT_EQ(lamps["local lights"], 8u);
  EXPECT_GT(lamps["choice of local lights"], 1u);
  const Passes baked = run("builtin:lamps", {"--mobile-preset", "karis2014"});
  EXPECT_EQ(baked["choice of local lights"], 0u);
  EXPECT_EQ(baked.why("choice of local lights"), "the preset expects them baked");
}

TEST_F(PassesTest, FogTermsAndAllElseOnRequestOnly) {
  const std::string quad = writeQuad();
  const Passes plain = run(quad, kSun);
  for (const char* pass : {"terms", "truth materials", "truth integrals", "truth occluders", "compare with the truth",
                           "shader costs", "spread of normals", "texture compression", "attribution"}) {
    EXPECT_EQ(plain[pass], 0u) << pass;
    EXPECT_EQ(plain.why(pass), "not requested") << pass;
  }
  EXPECT_EQ(plain["fog at vertices"], 0u);
  EXPECT_EQ(plain["blended surface"], 0u);
  const std::uint64_t samples = plain["surface"];
  EXPECT_GT(samples, 100u);
  const Passes foggy = run(quad, join({kSun, {"--fog", "0.1,0,0", "--terms", "--costs"}}));
  EXPECT_EQ(foggy["fog at vertices"], samples);
  EXPECT_EQ(foggy["terms"], 2 * samples);
  EXPECT_EQ(foggy["shader costs"], 2u);
}

TEST_F(PassesTest, OnlyCoveredPixelsAreShadedAndCompared) {
  const Passes passes = run(writeQuad(), kSun);
  EXPECT_LT(passes["surface"], 64u * 64u);
  for (const char* pass : {"shade highend", "shade mobile", "compare"}) EXPECT_EQ(passes[pass], passes["surface"]);
}

TEST_F(PassesTest, UnlitNeedsNoLight) {
  const Passes passes = run(writeQuad([](GltfFile& file) {
                              file.json["extensionsUsed"] = {"KHR_materials_unlit"};
                              file.material()["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
                              // White would be clipped, and not judged.
                              file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
                            }),
                            join({kSun, {"--env", "builtin:sky"}}));
  for (const char* pass : {"sun extraction", "environment prefilter and SH", "environment BRDF table",
                           "directional lights", "local lights"}) {
    EXPECT_EQ(passes[pass], 0u) << pass;
    EXPECT_EQ(passes.why(pass), "all objects are unlit") << pass;
  }
  EXPECT_GT(passes["shade mobile"], 100u);
  for (const nlohmann::json& permutation : passes.permutations) EXPECT_EQ(permutation["features"], "unlit");
}

// A quad with a texture hides another with more textures; a third material is placed nowhere.
TEST_F(PassesTest, HiddenMaterialCostsNeitherTexturesNorShading) {
  paint("front.png");
  paint("back.png");
  const auto write = [&](float z) {
    GltfFile file = makeQuad();
    file.json["images"] = {{{"uri", "front.png"}}, {{"uri", "back.png"}}, {{"uri", "missing.png"}}};
    file.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    file.json["materials"].push_back(
        {{"name", "back"}, {"normalTexture", {{"index", 1}}}, {"occlusionTexture", {{"index", 1}}}});
    file.json["materials"].push_back({{"name", "nowhere"}, {"emissiveTexture", {{"index", 2}}}});
    file.json["meshes"].push_back(file.json["meshes"][0]);
    file.json["meshes"][1]["primitives"][0]["material"] = 1;
    file.json["nodes"].push_back({{"mesh", 1}, {"translation", {0.25, 0.25, z}}, {"scale", {0.5, 0.5, 0.5}}});
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
    return writeEmbedded(m_folder, std::move(file), "two");
  };
  const std::vector<std::string> frontal = join({kSun, {"--orbit", "0,90,2"}});
  const Passes hidden = run(write(-0.01f), frontal);
  EXPECT_EQ(hidden["textures"], 1u);
  EXPECT_EQ(hidden.permutations.size(), 2u);
  for (const nlohmann::json& permutation : hidden.permutations) {
    EXPECT_EQ(permutation["textures"], "base colour");
    EXPECT_EQ(permutation["pixels"], hidden["surface"]);
  }
  const Passes seen = run(write(0.01f), frontal);
  EXPECT_EQ(seen["textures"], 2u);
  EXPECT_EQ(seen["surface"], hidden["surface"]);
}

// Glass is shaded after what is seen through it. In a small picture one shader serves both, and knows nothing of a
// third material, which stands behind them.
TEST_F(PassesTest, GlassAndWhatIsBehindItTakeOneShader) {
  paint("texture.png");
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"KHR_materials_transmission"};
  file.json["images"] = {{{"uri", "texture.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  file.json["materials"].push_back(
      {{"name", "glass"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}});
  file.json["materials"].push_back({{"name", "hidden"}, {"normalTexture", {{"index", 0}}}});
  for (const int material : {1, 2}) {
    file.json["meshes"].push_back(file.json["meshes"][0]);
    file.json["meshes"].back()["primitives"][0]["material"] = material;
    const double z = material == 1 ? 0.01 : -0.01;
    file.json["nodes"].push_back({{"mesh", material}, {"translation", {0.25, 0.25, z}}, {"scale", {0.5, 0.5, 0.5}}});
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
  }
  const Passes passes = run(writeEmbedded(m_folder, std::move(file), "glass"), join({kSun, {"--orbit", "0,90,2"}}));
  ASSERT_EQ(passes.permutations.size(), 2u) << "one of each path";
  for (const nlohmann::json& permutation : passes.permutations) {
    EXPECT_EQ(permutation["textures"], "base colour");
    EXPECT_TRUE(contains(permutation["features"].get<std::string>(), "some transmission")) << permutation;
    EXPECT_GE(permutation["pixels"], passes["surface"]);
  }
}

// A shader that branches by the camera would be compiled anew for each: the driver inlines uniforms that decide much.
TEST_F(PassesTest, AnotherCameraCompilesNothing) {
  const std::filesystem::path driver = m_folder / "driver";
  std::filesystem::create_directory(driver);
  RunOptions options;
  options.environment = {{"MESA_SHADER_CACHE_DIR", driver.string()}};
  const auto countAfter = [&](const std::string& orbit) {
    const RunResult result = runParity(
        join({{"diff", "builtin:spheres", "--no-cache", "--size", "48x32", "--orbit", orbit}, kSun, kRoughSky}),
        options);
    EXPECT_TRUE(isReported(result)) << result.err;
    return listFiles(driver).size();
  };
  const std::size_t compiled = countAfter("0,90,0");
  if (compiled == 0) GTEST_SKIP() << "the driver keeps no compiled shaders";
  EXPECT_EQ(countAfter("30,70,0"), compiled);
}

} // namespace
} // namespace parity::tests

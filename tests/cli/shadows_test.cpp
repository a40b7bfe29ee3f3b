// Shadows as a user turns them on; lights without sense, and more of them than maps.
#include "cli/checks.h"

#include "base/image/image_io.h"

namespace parity::tests {
namespace {

class ShadowsTest : public RenderingTest {
protected:
  base::Image render(const std::string& scene, const std::string& by, const std::vector<std::string>& options) const {
    return RenderingTest::render(scene, by, join({{"--size", "64x64"}, options}));
  }
  nlohmann::json report(const std::vector<std::string>& arguments) const {
    const std::filesystem::path folder = m_folder / "report";
    const RunResult result = runParity(join({{"report"}, arguments, kSmall, {"-o", folder.string()}}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    return readReport(folder);
  }
  static std::string settingOf(const nlohmann::json& report, const std::string& name) {
    for (const nlohmann::json& setting : report["settings"])
      if (setting["name"] == name) return setting["value"];
    return "";
  }
  static std::string lightOf(const nlohmann::json& report, std::size_t scene) {
    return report["scenes"][scene].value("light", "");
  }
  static std::uint64_t passOf(const nlohmann::json& report, const std::string& name) {
    for (const nlohmann::json& pass : report["scenes"][0]["passes"])
      if (pass["name"] == name) return pass["count"];
    ADD_FAILURE() << "no pass " << name;
    return 0;
  }
  // A quad before another, half a metre behind it and larger, so that it casts a shadow.
  static GltfFile makeQuads() {
    GltfFile file = makeQuad();
    file.json["scenes"][0]["nodes"].push_back(1);
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {-1, -1, -0.5}}, {"scale", {3, 3, 1}}});
    return file;
  }
  // Those under these lights of KHR_lights_punctual, as JSON text each, a metre before them.
  std::string writeLit(const std::vector<std::string>& lights) const {
    GltfFile file = makeQuads();
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    for (std::size_t i = 0; i < lights.size(); ++i) {
      file.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(nlohmann::json::parse(lights[i]));
      file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
      file.json["nodes"].push_back(
          {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}, {"translation", {0.1, 0.2, 1}}});
    }
    return writeEmbedded(m_folder, std::move(file), "lit");
  }
};

double sumOf(const base::Image& image) {
  double sum = 0;
  for (const float value : image.pixels) sum += value;
  return sum;
}

TEST_F(ShadowsTest, TakeLightAwayInThePathsThatHaveThem) {
  for (const char* path : {"highend", "mobile"}) {
    const double open = sumOf(render("builtin:shadows", path, {}));
    const double shadowed = sumOf(render("builtin:shadows", path, {"--shadows"}));
    if (std::string(path) == "highend")
      EXPECT_LT(shadowed, 0.97 * open);
    else
      EXPECT_EQ(shadowed, open) << "they are baked there";
  }
  const double spot = sumOf(render("builtin:shadows", "mobile", {"--mobile-spot-shadow"}));
  const double sun = sumOf(render("builtin:shadows", "mobile", {"--mobile-sun-shadow"}));
  const double near =
      sumOf(render("builtin:shadows", "mobile", {"--mobile-sun-shadow", "--mobile-sun-distance", "0.01"}));
  EXPECT_LT(sun, 0.99 * sumOf(render("builtin:shadows", "mobile", {})));
  EXPECT_EQ(near, sumOf(render("builtin:shadows", "mobile", {}))) << "nothing is so near";
  EXPECT_LT(spot, sumOf(render("builtin:shadows", "mobile", {})));
}

TEST_F(ShadowsTest, AreOffUnlessAskedForAndTheReportSaysSo) {
  const nlohmann::json off = report({"builtin:shadows"});
  EXPECT_EQ(settingOf(off, "shadows"), "off");
  EXPECT_EQ(passOf(off, "shadow maps"), 0u);
  EXPECT_EQ(lightOf(off, 0), "scale of mobile reflections: sky");
  const nlohmann::json on = report({"builtin:shadows", "--shadows", "--shadow-filter", "5"});
  EXPECT_EQ(settingOf(on, "shadows"), "on");
  EXPECT_EQ(settingOf(on, "shadow map size"), "2048");
  EXPECT_EQ(settingOf(on, "shadow filter"), "5");
  EXPECT_EQ(lightOf(on, 0), "shadows; scale of mobile reflections: sky");
  EXPECT_GT(passOf(on, "shadow maps"), 3u);
  EXPECT_GT(passOf(on, "casters of shadows"), passOf(on, "shadow maps"));
}

// By the suite file, in one scene and not in the other; drawn once for two views.
TEST_F(ShadowsTest, OfASuiteAreASceneAndAreDrawnOnceForAllViews) {
  const auto suite = [&](const std::string& views) {
    writeFile(m_folder / "suite.toml", "[[scene]]\nfile = \"builtin:shadows\"\nshadows = true\n" + views +
                                           "[[scene]]\nname = \"open\"\nfile = \"builtin:shadows\"\n");
    return report(join({{"--suite", (m_folder / "suite.toml").string(), "--no-cache"}, kRoughSky}));
  };
  const nlohmann::json one = suite("");
  EXPECT_EQ(lightOf(one, 0), "shadows; scale of mobile reflections: sky");
  EXPECT_EQ(lightOf(one, 1), "scale of mobile reflections: sky");
  // What the scene says goes before what the run says.
  writeFile(m_folder / "suite.toml", std::string("[[scene]]\nfile = \"builtin:shadows\"\nshadows = false\n"));
  EXPECT_EQ(lightOf(report({"--suite", (m_folder / "suite.toml").string(), "--shadows"}), 0),
            "scale of mobile reflections: sky");
  const nlohmann::json two = suite("[[scene.view]]\n[[scene.view]]\norbit = [100, 60, 0]\n");
  EXPECT_EQ(two["scenes"][0]["views"].size(), 2u);
  EXPECT_EQ(passOf(two, "shadow maps"), passOf(one, "shadow maps"));
  EXPECT_EQ(passOf(two, "casters of shadows"), passOf(one, "casters of shadows"));
  expectRefused(
      runParity({"report", "--suite",
                 (writeFile(m_folder / "bad.toml", std::string("[[scene]]\nfile = \"builtin:shadows\"\nshadows = 1\n")),
                  (m_folder / "bad.toml").string()),
                 "-o", (m_folder / "x").string()}),
      4, {"bad.toml", "line 3", "shadows"});
}

TEST_F(ShadowsTest, LightsWithoutSenseAreRefusedInWords) {
  const auto refused = [&](const std::string& light, const std::vector<std::string>& parts) {
    SCOPED_TRACE(light);
    expectRefused(runParity(join({{"diff", writeLit({light}), "--shadows"}, kSmall})), 4, parts);
  };
  refused(R"({"type": "point", "intensity": -1})", {"lights/0/intensity", "negative"});
  refused(R"({"type": "point", "intensity": 1e300})", {"lights/0/intensity", "32 bits"});
  refused(R"({"type": "point", "range": 1e300})", {"lights/0/range", "32 bits"});
  refused(R"({"type": "point", "intensity": 1e38, "color": [9, 9, 9]})", {"lights/0", "not a finite"});
  refused(R"({"type": "point", "range": -2})", {"lights/0/range", "not above 0"});
  refused(R"({"type": "point", "range": 0})", {"lights/0/range", "not above 0"});
  refused(R"({"type": "point", "intensity": "NaN"})", {"lights/0/intensity"});
  refused(R"({"type": "point", "range": null})", {"lights/0/range"});
  refused(R"({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}})", {"lights/0/spot", "inner"});
  refused(R"({"type": "spot", "spot": {"innerConeAngle": 0.9, "outerConeAngle": 0.5}})", {"lights/0/spot", "inner"});
  refused(R"({"type": "spot", "spot": {"innerConeAngle": -0.1}})", {"lights/0/spot"});
  refused(R"({"type": "spot", "spot": {"outerConeAngle": 2}})", {"lights/0/spot"});
  refused(R"({"type": "point", "intensity": 0})", {"no light and no environment"});
}

// What has sense at the ends of its range is shown: finite, and lit where light comes.
TEST_F(ShadowsTest, LightsAtTheEndsOfTheirRangesAreShown) {
  for (const char* light :
       {R"({"type": "point", "range": 1e38})", R"({"type": "point", "range": 1e-30})",
        R"({"type": "point", "intensity": 1e-30})", R"({"type": "point", "intensity": 1e30})",
        R"({"type": "spot", "spot": {"outerConeAngle": 1e-6}})",
        R"({"type": "spot", "spot": {"innerConeAngle": 1.57079, "outerConeAngle": 1.5707963267948966}})",
        R"({"type": "directional", "intensity": 1e20})"}) {
    SCOPED_TRACE(light);
    const base::Image image = render(writeLit({light}), "highend", {"--shadows", "--timings"});
    EXPECT_TRUE(contains(m_err, "device: shadow maps")) << m_err;
    for (const float value : image.pixels) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST_F(ShadowsTest, OfAHundredThousandLights) {
  // Most look elsewhere; those that do not are alike.
  constexpr int kThere = 40;
  GltfFile file = makeQuads();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"range", 3}, {"spot", nlohmann::json::object()}}};
  for (int i = 0; i < 100'000; ++i) {
    const double x = i < kThere ? 0.1 : 10 + 0.01 * (i % 1000), y = i < kThere ? 0.2 : 0.02 * (i / 1000);
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back(
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {x, y, 1}}});
  }
  const std::string many = writeEmbedded(m_folder, std::move(file), "many");
  const base::Image image = render(many, "highend", {"--shadows", "--background", "0,0,0"});
  const base::Image alone = render(writeLit({R"({"type": "spot", "range": 3, "spot": {}})"}), "highend",
                                   {"--shadows", "--background", "0,0,0"});
  ASSERT_EQ(image.pixels.size(), alone.pixels.size());
  int dark = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(image.pixels[i], kThere * alone.pixels[i], 1e-4 * (1 + image.pixels[i]));
    dark += alone.pixels[i] == 0;
  }
  EXPECT_GT(dark, 100);
}

} // namespace
} // namespace parity::tests

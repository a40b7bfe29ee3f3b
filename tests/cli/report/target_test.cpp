// --mobile-target: the stage `encoding` in reports, what each target costs, and that none hides a NaN.
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class TargetTest : public RenderingTest {
protected:
  RunResult diff(const std::string& scene, const std::string& target, const std::vector<std::string>& more = {}) {
    RunResult result =
        runParity(join({{"diff", scene, "--mobile-target", target, "--json", report().string()}, kSmall, kSun, more}));
    EXPECT_EQ(result.signal, 0) << result.err;
    return result;
  }
  std::filesystem::path report() const { return m_folder / "report.json"; }
  json view() const { return json::parse(readWholeFile(report())).at("scenes").at(0).at("views").at(0); }
};

const json& encodingOf(const json& region) {
  const json& stage = region.at("stages").at(0);
  if (stage.at("stage") != "encoding") throw std::out_of_range("encoding");
  return stage;
}
double meanFlipOf(const json& stage) { return stage.at("figures").at("metrics").at("flip.mean"); }

TEST_F(TargetTest, GammaTwoIsAStageOfItsOwn) {
  const RunResult result = diff("builtin:materials", "rgba8-gamma2");
  EXPECT_TRUE(contains(result.out, " target ")) << result.out;
  EXPECT_TRUE(contains(result.out, "storing the colour of mobile in rgba8-gamma2")) << result.out;
  const json shown = view(), whole = encodingOf(shown.at("whole"));
  EXPECT_EQ(whole.at("through"), "rgba8-gamma2");
  EXPECT_GT(meanFlipOf(whole), 0.03) << "ten codes at mid grey";
  std::size_t measured = 0;
  for (const json& material : shown.at("materials")) {
    if (encodingOf(material).at("figures").is_null()) continue;
    ++measured;
    for (const char* figure : {"flip.mean", "flip.p95", "flip.max", "bias.ev"})
      EXPECT_TRUE(encodingOf(material).at("figures").at("metrics").at(figure).is_number()) << figure;
  }
  EXPECT_GT(measured, 5u);

  const std::string first = readWholeFile(report());
  diff("builtin:materials", "rgba8-gamma2", {"--threads", "1"});
  EXPECT_EQ(readWholeFile(report()), first) << "the same on one thread";
}

TEST_F(TargetTest, WhatSrgbDoesIsWhatTheScreenDoesAnyway) {
  const RunResult result = diff("builtin:spheres", "rgba8-srgb");
  const json whole = encodingOf(view().at("whole"));
  EXPECT_EQ(whole.at("figures").at("metrics").at("flip.max"), 0) << "opaque, one sample: the same bits";
  EXPECT_FALSE(contains(result.out, " target ")) << result.out;
}

TEST_F(TargetTest, FloatTargetsCostLittleAndMoreWithFewerBits) {
  diff("builtin:spheres", "rgba16f");
  const double half = meanFlipOf(encodingOf(view().at("whole")));
  diff("builtin:spheres", "r11g11b10f");
  const double packed = meanFlipOf(encodingOf(view().at("whole")));
  EXPECT_LT(half, 0.005);
  EXPECT_GT(packed, half);
  EXPECT_LT(packed, 0.1);
}

// A mirror by the article's sun is infinite: an 8-bit store would make it white.
TEST_F(TargetTest, NoneHidesAPixelThatIsNotFinite) {
  GltfFile file = makeQuad();
  file.material()["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", 0}};
  const std::string scene = writeGlb(m_folder, file, "mirror");
  for (const char* target : {"rgba16f", "r11g11b10f", "rgba8-srgb", "rgba8-gamma2"}) {
    const RunResult result = runParity(join({{"diff", scene, "--mobile-target", target, "--mobile-preset", "karis2014",
                                              "--json", report().string(), "--orbit", "0,90,0", "--sun", "90,0,3"},
                                             kSmall}));
    EXPECT_TRUE(exitedWith(2, result)) << target;
    const json material = view().at("materials").at(0);
    EXPECT_GT(material.at("figures").at("nonFinite"), 0) << target;
    EXPECT_GT(encodingOf(material).at("figures").at("nonFinite"), 0) << target;
    EXPECT_TRUE(contains(material.at("reason"), "NaN")) << target << ": " << material.at("reason");
  }
}

} // namespace
} // namespace parity::tests

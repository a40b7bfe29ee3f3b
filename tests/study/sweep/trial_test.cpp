// A scene by its settings on the device.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "job/context.h"
#include "mobile/options.h"
#include "study/sweep/scaling_scene.h"
#include "study/sweep/trial.h"

namespace parity::sweep {
namespace {

job::Settings smallSettings() {
  job::Settings s;
  s.width = s.height = 24;
  s.costs = true;
  s.of<mobile::Options>().precision = mobile::Precision::fp32;
  s.device.validation = true;
  s.reference.integral.relativeError = 0.1;
  return s;
}

job::SceneRequest request(const std::string& scene, const char* environment, bool sun) {
  job::SceneRequest request;
  request.scene = scene;
  request.name = "scene";
  request.settings = smallSettings();
  request.settings.scene.environment = environment;
  if (sun) request.settings.scene.sun = scenes::SunRequest{30, 50, 4};
  request.views = {{}};
  return request;
}

TEST(Trial, MeasuresEverySettingOverTheSameSurfaces) {
  job::Context context(smallSettings());
  TrialOptions options;
  options.rounds = 2;
  options.preparationRounds = 1;
  options.settings = {"mobile: capture fp16", "highend: off-specular none", "highend: lut-size 8",
                      "mobile: mobile-target r11*"};
  const SceneSweep sweep = runTrial(context, request("builtin:furnace", "builtin:studio", true), options, {});
  ASSERT_GT(sweep.pixels, 100u);
  EXPECT_GT(sweep.truthError, 0);
  std::set<std::string> ids;
  for (const VariantResult& v : sweep.variants) {
    ids.insert(v.id());
    if (v.stage == Stage::shading) {
      EXPECT_EQ(v.times.deviceMs.size(), 2u);
      EXPECT_EQ(v.times.wallMs.size(), 2u);
      EXPECT_EQ(v.times.cpuMs.size(), 2u);
    }
    EXPECT_GT(v.cost.operations, 100);
    ASSERT_TRUE(v.whole.truth.has_value()) << v.id();
    EXPECT_GT(v.whole.truth->flipMean, 0) << v.id();
    std::uint64_t pixels = 0;
    for (const RegionErrors& region : v.materials) pixels += region.pixels;
    EXPECT_EQ(pixels, v.whole.pixels);
  }
  EXPECT_TRUE(ids.contains("mobile: capture fp16"));
  EXPECT_TRUE(ids.contains("highend: lut-size 8"));
  EXPECT_FALSE(ids.contains("mobile: sky-sh 9")) << "not asked for";
  const VariantResult& highend = sweep.variants[0];
  EXPECT_EQ(highend.id(), "highend: default");
  EXPECT_EQ(highend.whole.first.flipMean, 0) << "it is what it is held against";
  EXPECT_GT(findVariant(sweep, "highend: off-specular none")->whole.first.flipMean, 0);
  EXPECT_LT(findVariant(sweep, "highend: off-specular none")->cost.operations, highend.cost.operations);
  EXPECT_EQ(findVariant(sweep, "highend: lut-size 8")->prepareMs.size(), 1u);
  EXPECT_NE(findVariant(sweep, "mobile: mobile-target r11g11b10f")->whole.first.flipMean,
            findVariant(sweep, "mobile: default")->whole.first.flipMean);
}

TEST(Trial, WhatTheSceneDoesNotNeedIsNotTried) {
  job::Context context(smallSettings());
  TrialOptions options;
  options.rounds = 2;
  options.truth = false;
  options.settings = {"mobile: s*", "mobile: mobile-textures *", "mobile: mobile-local*", "mobile: direct*",
                      "highend: fresnel dielectric"};
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "parity-trial";
  const std::string scene = writeScalingScene(folder, {.triangles = 200, .lights = 2}).string();
  const SceneSweep sweep = runTrial(context, request(scene, "", true), options, {});
  std::filesystem::remove_all(folder);
  EXPECT_EQ(sweep.environment, "none");
  EXPECT_EQ(findVariant(sweep, "mobile: sky-sh 9"), nullptr);
  EXPECT_EQ(findVariant(sweep, "mobile: mobile-textures astc4x4"), nullptr);
  EXPECT_NE(findVariant(sweep, "mobile: mobile-local-lights off"), nullptr);
  EXPECT_NE(findVariant(sweep, "mobile: direct-lobe d-approx"), nullptr);
  EXPECT_FALSE(sweep.variants[0].whole.truth.has_value());
  EXPECT_EQ(sweep.truthError, 0);
  EXPECT_NE(std::ranges::find(sweep.skipped, "mobile sky-sh: no environment"), sweep.skipped.end());
  EXPECT_NE(std::ranges::find(sweep.skipped, "mobile mobile-textures: no texture"), sweep.skipped.end());
}

TEST(Trial, EveryNameIsGivenOnceAndEveryKnobChangesWhatItSays) {
  const std::vector<Variant> all = makeVariants(job::Settings{});
  EXPECT_EQ(all[0].id(), "highend: default");
  EXPECT_EQ(all[1].id(), "mobile: default");
  std::set<std::string> ids;
  for (const Variant& v : all) {
    EXPECT_TRUE(ids.insert(v.id()).second) << v.id();
    if (!v.sameAs.empty()) continue;
    const Variant& plain = v.path->name() == "highend" ? all[0] : all[1];
    int changed = 0;
    for (std::size_t k = 0; k < v.knobs().size(); ++k) changed += v.knobs()[k] != plain.knobs()[k];
    if (v.name == "default") continue;
    // What is prepared is timed with the default's value, too.
    EXPECT_GE(changed, v.stage == Stage::preparation ? 0 : 1) << v.id();
    if (!v.knob.empty()) {
      EXPECT_LE(changed, 1) << v.id();
    }
  }
}

// The sky light's colour scales every setting's picture once.
TEST(Trial, AnotherPrefilterHasTheSkyLightsColourOnce) {
  job::SceneRequest colored = request("builtin:spheres", "builtin:sky", false);
  colored.settings.scene.lightScales.skyLightColor = {0.25f, 0.5f, 1};
  job::Context context(colored.settings);
  TrialOptions options;
  options.rounds = 2;
  options.preparationRounds = 1;
  options.truth = false;
  options.settings = {"highend: prefilter-size 128"};
  const SceneSweep sweep = runTrial(context, colored, options, {});
  const VariantResult* other = findVariant(sweep, "highend: prefilter-size 128");
  ASSERT_NE(other, nullptr);
  EXPECT_LT(other->whole.first.relMse, 0.01);
  EXPECT_GT(other->whole.first.relMse, 0) << "it is another prefilter";
}

TEST(Trial, TheFirstPathIsTheFirstOfAll) {
  job::Settings turned;
  turned.pathNames = {"mobile", "highend"};
  EXPECT_THROW(makeVariants(turned), base::Error);
}

// What a scene's own values are equal to keeps its name.
TEST(Trial, NamesDependOnNoValues) {
  job::Settings other;
  other.of<mobile::Options>().precision = mobile::Precision::fp32;
  const auto idsOf = [](const job::Settings& settings) {
    std::set<std::string> ids;
    for (const Variant& v : makeVariants(settings)) ids.insert(v.id());
    return ids;
  };
  const std::set<std::string> ids = idsOf(job::Settings{});
  std::vector<std::string> differing;
  std::ranges::set_symmetric_difference(idsOf(other), ids, std::back_inserter(differing));
  EXPECT_EQ(differing, std::vector<std::string>());
  EXPECT_TRUE(ids.contains("mobile: precision fp32"));
}

TEST(Trial, GlobThatMatchesNothingIsAnError) {
  const std::vector<Variant> all = makeVariants(job::Settings{});
  base::expectError([&] { requireMatches(all, {"mobile: sky*", "desktop*"}); }, {"desktop*"}, base::ExitCode::usage);
}

// The preset refit allows no other lobe.
TEST(Trial, WhatASceneDoesNotAllowIsSkipped) {
  job::SceneRequest refit = request("builtin:furnace", "", true);
  refit.settings.of<mobile::Options>() = mobile::presetByName("refit");
  job::Context context(refit.settings);
  TrialOptions options;
  options.rounds = 2;
  options.truth = false;
  options.settings = {"mobile: direct-lobe d-approx"};
  const SceneSweep sweep = runTrial(context, refit, options, {});
  EXPECT_EQ(sweep.variants.size(), 2u);
  EXPECT_EQ(
      std::ranges::count(sweep.skipped, "mobile: direct-lobe d-approx: this scene's options allow no such setting"), 1);
}

} // namespace
} // namespace parity::sweep

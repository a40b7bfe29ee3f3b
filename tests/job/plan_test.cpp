// Plans: their text says all that decides the report, and shards are even.
#include "job/plan/plan.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "base/version.h"
#include "job/context.h"
#include "job/plan/plan_folder.h"
#include "job/plan/plan_json.h"
#include "job/plan/unit_store.h"

namespace parity::job {
namespace {

using base::TempFolder;

// One that says something of everything.
Plan makePlanOfEverything() {
  Plan plan;
  plan.version = "1", plan.build = std::string(32, 'b'), plan.numerics = std::string(32, 'n');
  plan.facts = {"llvmpipe", "Mesa", {{"size", "64x64"}}, {{"exposure", "1", compare::ActsOn::figures, "the exposure"}}};
  plan.plain.budgets = "run.toml";
  plan.plain.device = {"llvm", true};
  plan.plain.cacheFolder = "cache";
  plan.plain.cacheBytes = 12345;
  plan.given = {{"size", {{"64x32"}, {}}}};
  plan.request.suite = "night";
  plan.request.suiteBudgets = "suite.toml";
  plan.request.baseline = "old";
  plan.request.only = {"tag:hero", "D*"};
  plan.request.oneOfMany = true;
  plan.request.pictures = Pictures::notPassed;
  plan.request.pixelData = false;
  plan.request.singleFile = true;
  plan.request.commandLine = "parity plan";
  plan.request.again = {{"Desk", "front", "parity diff Desk.glb"}};
  SceneRequest desk{.name = "Desk",
                    .scene = "Desk.glb",
                    .settings = {},
                    .captures = {glm::vec3(1, 2, 3)},
                    .views = {},
                    .budgets = "desk.toml"};
  desk.given = {{"exposure", {{"1.5"}, {}}}};
  desk.views.emplace_back().orbit = glm::vec3(30, 70, 2);
  desk.views[0].name = "front", desk.views[0].camera = "Camera 1", desk.views[0].target = glm::vec3(0.1f);
  desk.views[0].fovYDeg = 33.3f;
  desk.partOf = WholeRun{3, 9, 2};
  plan.request.scenes = {
      desk, {.name = "Chair", .scene = "Chair.glb", .settings = {}, .captures = {}, .views = {}, .budgets = {}}};
  plan.budgets = {{"run.toml", "[[rule]]\n\"\t"}};
  plan.baseline = std::string(32, 'c');
  plan.sceneBaselines = {"", std::string(32, 'e')};
  plan.shards = {{1}, {}, {0}};
  return plan;
}

TEST(Plan, TextAndPlanAreTheSameThing) {
  const std::string text = planText(makePlanOfEverything(), true);
  const Plan read = planFromText(text);
  EXPECT_EQ(planText(read, true), text);
  EXPECT_EQ(read.request.scenes[0].settings.exposureEv, 1.5f) << "a scene's settings are made of what is given";
  EXPECT_EQ(read.request.scenes[0].views[0].orbit, glm::vec3(30, 70, 2));
  EXPECT_EQ(read.request.pictures, Pictures::notPassed);
  EXPECT_EQ(read.shards, (std::vector<std::vector<std::size_t>>{{1}, {}, {0}}));
}

// Whoever changes one of them has another plan.
TEST(Plan, DigestSeesWhatDecidesTheReportAndNothingElse) {
  const auto digestOf = [](const std::function<void(Plan&)>& change) {
    const TempFolder folder;
    Plan plan = makePlanOfEverything();
    plan.request.baseline.clear(); // there is none to copy
    change(plan);
    writePlan(plan, folder / "night");
    return plan.digest;
  };
  const std::string digest = digestOf([](Plan&) {});
  const std::vector<std::function<void(Plan&)>> others = {
      [](Plan& p) { p.build[0] = 'x'; },
      [](Plan& p) { p.numerics[0] = 'x'; },
      [](Plan& p) { p.facts.device += "2"; },
      [](Plan& p) { p.facts.driver += "2"; },
      [](Plan& p) { p.request.sentinels.push_back(0); },
      [](Plan& p) { p.plain.budgets.reset(); },
      [](Plan& p) { p.given.clear(); },
      [](Plan& p) { p.request.suite = "day"; },
      [](Plan& p) { p.request.only.clear(); },
      [](Plan& p) { p.request.pictures = Pictures::all; },
      [](Plan& p) { p.request.pixelData = true; },
      [](Plan& p) { p.request.scenes[0].name = "Table"; },
      [](Plan& p) { p.request.scenes[0].given.clear(); },
      [](Plan& p) { p.request.scenes[0].views[0].fovYDeg = 40; },
      [](Plan& p) { p.budgets.begin()->second += "#"; },
      [](Plan& p) { p.baseline[0] = 'x'; },
  };
  for (std::size_t i = 0; i < others.size(); ++i) EXPECT_NE(digestOf(others[i]), digest) << "change " << i;
  EXPECT_EQ(digestOf([](Plan& p) { p.sceneBaselines.clear(); }), digest) << "it follows from the baseline";
  EXPECT_EQ(digestOf([](Plan& p) { p.shards = {{0, 1}}; }), digest);
  EXPECT_EQ(digestOf([](Plan& p) { p.request.commandLine = "other"; }), digest);
  EXPECT_EQ(digestOf([](Plan& p) { p.request.again.clear(); }), digest);
}

TEST(Plan, EditedTextIsRefused) {
  const std::string text = planText(makePlanOfEverything(), true);
  const auto edited = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    const std::size_t at = other.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return other.replace(at, from.size(), to);
  };
  EXPECT_NO_THROW(planFromText(text));
  EXPECT_ANY_THROW(planFromText(edited("\"plan\": 1", "\"plan\": 2")));
  EXPECT_ANY_THROW(planFromText(edited("\"1.5\"", "\"bright\"")));
  EXPECT_ANY_THROW(planFromText(edited("not-passed", "some")));
  EXPECT_ANY_THROW(planFromText(edited("\"scenes\":", "\"scenery\":")));
  Plan plan = makePlanOfEverything();
  for (const std::vector<std::vector<std::size_t>>& shards :
       std::vector<std::vector<std::vector<std::size_t>>>{{}, {{0}}, {{0, 1}, {1}}, {{0, 1, 2}}}) {
    plan.shards = shards;
    EXPECT_ANY_THROW(planFromText(planText(plan, true)));
  }
}

// Whatever stands in the file: it is read, or an exception says why not.
TEST(Plan, DamagedTextIsReadWithoutHarm) {
  const std::string whole = planText(makePlanOfEverything(), true);
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = whole;
    const std::size_t at = random() % text.size(), length = 1 + random() % 40;
    if (i % 3 == 0)
      text[at] = static_cast<char>(random() % 256);
    else if (i % 3 == 1)
      text.erase(at, length);
    else
      text.insert(at, text.substr(random() % text.size(), length));
    try {
      planFromText(text);
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(Plan, FolderOfAnotherPlanIsKeptUnlessItIsTheProgramsOwn) {
  const TempFolder folder;
  Plan plan = makePlanOfEverything();
  plan.request.baseline.clear();
  plan.version = base::kVersion, plan.build = hashOfThisBuild();
  writePlan(plan, folder / "night");
  const UnitStore store(folder / "night", plan);
  ComparedScene scene;
  scene.result.name = "Desk";
  store.put(0, scene, {});
  Plan other = plan;
  other.request.suite = "day";
  base::expectError([&] { writePlan(other, folder / "night"); }, (folder / "night").string(), "holds another plan",
                    base::ExitCode::usage);
  EXPECT_EQ(store.findFault(0), "");
  writePlan(plan, folder / "night");
  EXPECT_EQ(store.findFault(0), "") << "the same plan goes on";
  writePlanAnew(other, folder / "night");
  EXPECT_NE(store.findFault(0), "");
}

TEST(PackShards, EachSceneOnceTheLongestFirst) {
  const std::vector<double> seconds = {1, 9, 3, 3, 7, 2, 5};
  for (const std::size_t shards : {1u, 2u, 3u, 7u, 20u}) {
    const std::vector<std::vector<std::size_t>> packed = packShards(seconds.size(), seconds, shards);
    ASSERT_EQ(packed.size(), shards);
    std::vector<std::size_t> all;
    double most = 0;
    for (const std::vector<std::size_t>& shard : packed) {
      EXPECT_TRUE(std::ranges::is_sorted(shard, [&](std::size_t a, std::size_t b) { return seconds[a] > seconds[b]; }));
      all.insert(all.end(), shard.begin(), shard.end());
      double sum = 0;
      for (const std::size_t scene : shard) sum += seconds[scene];
      most = std::max(most, sum);
    }
    std::ranges::sort(all);
    std::vector<std::size_t> expected(seconds.size());
    std::iota(expected.begin(), expected.end(), std::size_t{0});
    EXPECT_EQ(all, expected);
    // Graham 1969, "Bounds on multiprocessing timing anomalies": longest first is within 4/3 of the best, which is at
    // least the mean and the longest.
    EXPECT_LE(most, 4.0 / 3 * std::max(30.0 / static_cast<double>(shards), 9.0)) << shards;
  }
}

TEST(PackShards, WithoutTimesShardsAreEven) {
  for (const std::vector<std::size_t>& shard : packShards(10'000, {}, 64)) {
    EXPECT_GE(shard.size(), 156u);
    EXPECT_LE(shard.size(), 157u);
  }
}

} // namespace
} // namespace parity::job

// Units of a plan: what a worker found comes back whole or not at all, and the first of two stays.
#include "job/plan/unit.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/temp_folder.h"
#include "job/plan/unit_store.h"

namespace parity::job {
namespace {

using base::TempFolder;

const std::string kBuild(32, 'b');

Plan makePlan() {
  Plan plan;
  plan.build = kBuild, plan.numerics = std::string(32, 'n'), plan.digest = std::string(32, 'd');
  for (const char* name : {"Desk", "Chair", "Lamp"})
    plan.request.scenes.push_back({.name = name,
                                   .scene = std::string(name) + ".glb",
                                   .settings = {},
                                   .captures = {},
                                   .views = {},
                                   .budgets = {}});
  plan.shards = {{2, 0}, {1}};
  return plan;
}

ComparedScene makeScene(const std::string& picture = "pixels of a picture", const std::string& name = "Desk") {
  ComparedScene scene;
  scene.result.name = name;
  scene.result.error = "it failed";
  scene.result.errorExitCode = 4;
  scene.result.conditions = {{"exposure", "1", compare::ActsOn::figures, "the exposure"}};
  scene.result.views.resize(2);
  scene.result.views[1].name = "front";
  scene.result.views[1].conditions = {{"camera", "2", compare::ActsOn::figures, "the camera"}};
  scene.inputs = {{"Desk.glb", "hash"}};
  scene.materials = {"Wood"};
  scene.error = "Desk: it failed";
  scene.warnings = {"a warning"};
  const std::span<const std::byte> bytes = std::as_bytes(std::span(picture));
  scene.pictures = {{"images/0-desk.png", {bytes.begin(), bytes.end()}}};
  return scene;
}

Unit makeUnit() {
  Unit unit{.scene = makeScene(), .files = {{"images/0-desk.png", std::string(32, 'p'), 19}}, .run = {}};
  unit.scene.pictures.clear();
  unit.run = {.seconds = 1.5,
              .cpuSeconds = 2.5,
              .machine = "a processor",
              .isCached = true,
              .timings = {{"surface", 20}},
              .shaders = {"shader"}};
  return unit;
}
const UnitOrigin kOrigin{std::string(32, 'd'), kBuild, std::string(32, 'n'), 7};

TEST(Unit, ComesBackWhole) {
  const Unit unit = makeUnit();
  const std::optional<ReadUnit> read = unitFromBytes(toBytes(unit, kOrigin), kBuild);
  ASSERT_TRUE(read && read->unit);
  EXPECT_EQ(read->origin.plan, kOrigin.plan);
  EXPECT_EQ(read->origin.index, 7u);
  const ComparedScene& scene = read->unit->scene;
  EXPECT_EQ(scene.result.error, "it failed");
  EXPECT_EQ(scene.result.errorExitCode, 4);
  ASSERT_EQ(scene.result.views.size(), 2u);
  EXPECT_EQ(scene.result.views[1].name, "front");
  ASSERT_EQ(scene.result.views[1].conditions.size(), 1u);
  EXPECT_EQ(scene.result.views[1].conditions[0].words, "the camera");
  EXPECT_EQ(scene.result.conditions[0].name, "exposure");
  EXPECT_EQ(scene.inputs[0].hash, "hash");
  EXPECT_EQ(scene.materials, std::vector<std::string>{"Wood"});
  EXPECT_EQ(scene.error, "Desk: it failed");
  EXPECT_EQ(scene.warnings, std::vector<std::string>{"a warning"});
  EXPECT_EQ(read->unit->files[0].bytes, 19u);
  EXPECT_EQ(read->unit->run.seconds, 1.5);
  EXPECT_TRUE(read->unit->run.isCached);
  EXPECT_EQ(read->unit->run.timings[0].second, 20);
  EXPECT_EQ(read->unit->run.shaders, std::vector<std::string>{"shader"});
  EXPECT_EQ(toBytes(*read->unit, kOrigin), toBytes(unit, kOrigin));
}

TEST(Unit, ContentIsWhatTwoWorkersMustAgreeOn) {
  const auto contentOf = [](const Unit& unit) { return unitFromBytes(toBytes(unit, kOrigin), kBuild)->content; };
  const Unit unit = makeUnit();
  Unit slower = unit, other = unit;
  slower.run = {.seconds = 9};
  other.scene.result.views[0].name = "back";
  EXPECT_EQ(contentOf(slower), contentOf(unit));
  EXPECT_NE(contentOf(other), contentOf(unit));
}

TEST(Unit, OfAnotherBuildTellsOnlyWhereItIsFrom) {
  const std::optional<ReadUnit> read = unitFromBytes(toBytes(makeUnit(), kOrigin), std::string(32, 'x'));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->origin.build, kBuild);
  EXPECT_FALSE(read->unit);
}

TEST(Unit, EachDamagedByteIsSeen) {
  const std::vector<std::byte> whole = toBytes(makeUnit(), kOrigin);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::vector<std::byte> bytes = whole;
    bytes[i] ^= std::byte{4};
    EXPECT_FALSE(unitFromBytes(bytes, kBuild)) << "byte " << i;
    EXPECT_FALSE(unitFromBytes(std::span(whole).first(i), kBuild)) << i << " bytes";
  }
}

// With a checksum that is right, as of somebody who means harm: no crash, and no memory beyond what the bytes can hold.
TEST(Unit, ForgedBytesAreReadWithoutHarm) {
  constexpr std::size_t kMagic = 8, kChecksum = 32;
  const std::vector<std::byte> whole = toBytes(makeUnit(), kOrigin);
  std::mt19937 random(1);
  int read = 0;
  for (int i = 0; i < 5000; ++i) {
    std::vector<std::byte> bytes = whole;
    const std::size_t body = bytes.size() - kMagic - kChecksum;
    for (int k = 0; k < 4; ++k) bytes[kMagic + kChecksum + random() % body] = static_cast<std::byte>(random() % 256);
    const std::string checksum = base::Hasher().add(std::span(bytes).subspan(kMagic + kChecksum)).hex();
    std::ranges::transform(checksum, bytes.begin() + kMagic, [](char c) { return static_cast<std::byte>(c); });
    read += unitFromBytes(bytes, kBuild).has_value();
  }
  EXPECT_GT(read, 100) << "the checksums were right";
}

TEST(UnitStore, UnitThatNamesFilesElsewhereIsDamaged) {
  const Plan plan = makePlan();
  const UnitOrigin origin{plan.digest, plan.build, plan.numerics, 0};
  const std::string hash(32, '0');
  const std::vector<std::pair<std::string, std::string>> bad = {{"../0.png", hash},
                                                                {"/tmp/0.png", hash},
                                                                {"images/../../0.png", hash},
                                                                {"", hash},
                                                                {"images/", hash},
                                                                {"images/0.png", "../" + std::string(29, '0')},
                                                                {"images/0.png", "00"}};
  for (const auto& [file, content] : bad) {
    const TempFolder folder;
    Unit unit = makeUnit();
    unit.files = {{file, content, 3}};
    const std::vector<std::byte> bytes = toBytes(unit, origin);
    base::writeBytes(folder / "units/000000.unit", bytes);
    base::expectError([&] { UnitStore(folder.path(), plan).read(0); }, {"000000.unit", "names files elsewhere"});
  }
}

TEST(UnitStore, KeepsTheFirstOfTwoAndSaysWhetherTheyDiffer) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder.path(), plan);
  EXPECT_EQ(store.missing(), (std::vector<std::size_t>{0, 1, 2}));
  store.put(0, makeScene(), {.seconds = 1, .isCached = false, .timings = {}, .shaders = {}});
  store.put(0, makeScene(), {.seconds = 2, .isCached = false, .timings = {}, .shaders = {}});
  EXPECT_FALSE(store.differs(0));
  EXPECT_EQ(store.read(0).run.seconds, 1);
  store.put(0, makeScene("other pixels"), {});
  EXPECT_TRUE(store.differs(0));
  const Unit unit = store.read(0);
  EXPECT_EQ(unit.run.seconds, 1);
  const std::vector<std::byte> content = store.contentOf(unit.files[0]);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(content.data()), content.size()), "pixels of a picture");
  EXPECT_EQ(store.missing(), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(store.missing(0), std::vector<std::size_t>{2});
  EXPECT_EQ(store.missing(1), std::vector<std::size_t>{1});
}

TEST(UnitStore, ResultReplacesWhatWasGivenUpAndNeverTheOtherWayRound) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder.path(), plan);
  ComparedScene failed;
  failed.result.name = "Desk", failed.result.error = "its worker failed twice";
  store.put(0, failed, {.isGivenUp = true});
  EXPECT_EQ(store.read(0).scene.result.error, "its worker failed twice");
  store.put(0, makeScene(), {.seconds = 1});
  EXPECT_EQ(store.read(0).run.seconds, 1);
  store.put(0, failed, {.isGivenUp = true});
  EXPECT_EQ(store.read(0).run.seconds, 1);
  EXPECT_FALSE(store.differs(0)) << "a crash is no other figure";
}

TEST(UnitStore, WhatWasBegunMostOftenComesLast) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder.path(), plan);
  for (const std::size_t unit : {0u, 1u, 0u}) store.noteBegun(unit);
  EXPECT_EQ(store.missing(), (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_EQ(store.missing(0), (std::vector<std::size_t>{2, 0}));
  EXPECT_TRUE(store.wasBegun(1));
  EXPECT_FALSE(store.wasBegun(2));
  store.forgetBegun(0);
  EXPECT_EQ(store.missing(), (std::vector<std::size_t>{0, 2, 1}));
}

TEST(UnitStore, OutdatedAreErrorsAndScenesWhoseFilesHaveChanged) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder / "night", plan);
  base::writeText(folder / "Desk.glb", "a desk");
  const std::string names[] = {"Desk", "Chair", "Lamp"};
  for (std::size_t i = 0; i < 3; ++i) {
    ComparedScene scene = makeScene();
    scene.result.name = names[i];
    scene.inputs = {{folder / "Desk.glb", base::hashOfFile(folder / "Desk.glb")}};
    if (i != 1) scene.result.error.clear();
    if (i == 2) scene.inputs.push_back({folder / "gone.png", "hash"});
    store.put(i, std::move(scene), {});
  }
  store.dropOutdated();
  EXPECT_EQ(store.missing(), (std::vector<std::size_t>{1, 2})) << "an error, and a file that is gone";
  base::writeText(folder / "Desk.glb", "another desk");
  store.dropOutdated();
  EXPECT_EQ(store.missing(), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(UnitStore, OneWithoutItsPicturesIsMissing) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder.path(), plan);
  store.put(1, makeScene("pixels", "Chair"), {});
  EXPECT_EQ(store.findFault(1), "");
  std::filesystem::remove_all(folder / "pictures");
  EXPECT_NE(store.findFault(1), "");
  store.put(1, makeScene("pixels", "Chair"), {});
  EXPECT_EQ(store.findFault(1), "") << "done again";
}

TEST(UnitStore, OneOfAnotherPlanBuildMachineOrPlaceIsRefused) {
  const Plan plan = makePlan();
  Plan otherPlan = plan, otherBuild = plan, otherMachine = plan;
  otherPlan.digest[0] = 'x', otherBuild.build[0] = 'x', otherMachine.numerics[0] = 'x';
  for (const Plan* other : {&otherPlan, &otherBuild, &otherMachine}) {
    const TempFolder folder;
    UnitStore(folder.path(), *other).put(1, makeScene("pixels", "Chair"), {});
    const UnitStore store(folder.path(), plan);
    EXPECT_NE(store.findFault(1), "");
    base::expectError([&] { store.read(1); }, {"000001.unit", "is of another"}, base::ExitCode::otherPlan);
  }
  const TempFolder folder;
  const UnitStore store(folder.path(), plan);
  store.put(1, makeScene("pixels", "Chair"), {});
  std::filesystem::rename(folder / "units/000001.unit", folder / "units/000002.unit");
  EXPECT_NE(store.findFault(2), "");
}

TEST(UnitStore, CrashesAreNoted) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder.path(), plan);
  EXPECT_EQ(store.crashOf(0), "");
  store.noteCrash(0, "crashed with SIGSEGV at 'surface'");
  EXPECT_EQ(store.crashOf(0), "crashed with SIGSEGV at 'surface'");
}

TEST(UnitStore, PicturesArePlacedUnderTheirNames) {
  const TempFolder folder;
  const Plan plan = makePlan();
  const UnitStore store(folder / "night", plan);
  store.put(0, makeScene(), {});
  const UnitFile file = store.read(0).files.at(0);
  store.place(file, folder / "out");
  EXPECT_EQ(base::readText(folder / "out/images/0-desk.png"), "pixels of a picture");
  base::writeText(folder / "out/images/0-desk.png", "an older one");
  store.place(file, folder / "out");
  EXPECT_EQ(base::readText(folder / "out/images/0-desk.png"), "pixels of a picture");
}

} // namespace
} // namespace parity::job

// Every change that was planted is found in its run, with its cause; where nothing changed nothing is said.
#include <algorithm>

#include "base/expect_error.h"
#include "history/blame.h"
#include "history/history_folder.h"
#include "history/index.h"
#include "history/nights.h"
#include "history/synthetic_nights.h"

namespace parity::tests {
namespace {

using history::Blame;

class BlameTest : public HistoryTest {
protected:
  // Names of the inputs that a blame says, joined.
  static std::string causes(const Blame& blame) {
    std::string all;
    for (const history::InputStep& each : blame.inputs) all += (all.empty() ? "" : ",") + each.what;
    return all;
  }
  static std::size_t countEvents(const history::Database& index, const std::string& kind = "") {
    return static_cast<std::size_t>(
        index.number("SELECT count(*) FROM event" + (kind.empty() ? "" : " WHERE kind='" + kind + "'")).value());
  }
};

void expectFound(const history::Database& index, const Planted& planted, const std::vector<std::string>& ids) {
  const Blame blame = history::blame(index, planted.subject, "flip.mean", {});
  ASSERT_TRUE(blame.isChanged) << planted.subject;
  EXPECT_EQ(blame.now.name, ids.at(planted.night)) << planted.subject << " " << planted.cause;
  EXPECT_EQ(blame.before.name, ids.at(planted.night - 1)) << planted.subject << " " << planted.cause;
  ASSERT_EQ(blame.figures.size(), 1u);
  EXPECT_EQ(blame.figures[0].before, planted.before);
  EXPECT_EQ(blame.figures[0].now, planted.now);
  EXPECT_EQ(blame.isNondeterministic, planted.cause.empty()) << planted.subject;
  std::string causes;
  for (const history::InputStep& each : blame.inputs) causes += (causes.empty() ? "" : ",") + each.what;
  EXPECT_EQ(causes, planted.cause) << planted.subject;
}

TEST_F(BlameTest, EveryPlantedChangeIsBlamedOnItsRunAndCause) {
  Nights nights({.scenes = 12, .views = 2, .materials = 2});
  history::Store store = writer();
  std::vector<std::string> ids;
  std::vector<Planted> all;
  const std::vector<std::string> causes = {"asset",    "",        "build",    "environment", "driver", "bake",
                                           "pictures", "request", "numerics", "settings",    "asset"};
  for (int i = 0; i < 3; ++i) ids.push_back(store.add(nights.next()).id);
  for (std::size_t i = 0; i < causes.size(); ++i) {
    for (const Planted& each : nights.plant(causes[i], i, 2)) all.push_back(each);
    for (int k = 0; k < 3; ++k) ids.push_back(store.add(nights.next()).id);
  }
  for (const Planted& each : all) expectFound(store.index(), each, ids);
  EXPECT_EQ(countEvents(store.index()), all.size()) << "a row that nobody changed";
  EXPECT_EQ(countEvents(store.index(), "nondeterministic"), 2u);
  expectSameWhenRebuilt(store);
}

TEST_F(BlameTest, ThereIsNoAlarmInAYearOfEqualNights) {
  Nights nights({.scenes = 4, .views = 1, .materials = 4});
  history::Store store = writer();
  for (int i = 0; i < 365; ++i) store.add(nights.next());
  EXPECT_EQ(countEvents(store.index()), 0u);
  EXPECT_EQ(store.index().number("SELECT count(*) FROM value WHERE first_run>1"), 0) << "an equal night added values";
  const Blame blame = history::blame(store.index(), "scene 000/view 0/material 1", "", {});
  EXPECT_FALSE(blame.isChanged);
  EXPECT_EQ(blame.runs, 365u);
}

TEST_F(BlameTest, AChangeInTheDarkOfErrorsIsBlamedOnWhatChangedSinceTheSceneWasSeen) {
  Nights nights({});
  history::Store store = writer();
  store.add(nights.next());
  const auto planted = nights.plant("build", 3);
  nights.state().scenes[3].error = "a.gltf: is damaged";
  nights.state().scenes[3].verdict = compare::Verdict::error;
  store.add(nights.next()); // of the new build, but not of the scene
  nights.state().scenes[3].error.clear();
  nights.state().scenes[3].verdict = compare::Verdict::pass;
  store.add(nights.next());
  const Blame blame = history::blame(store.index(), planted[0].subject, "", {});
  EXPECT_EQ(causes(blame), "build");
  EXPECT_FALSE(blame.isNondeterministic);
  EXPECT_EQ(countEvents(store.index(), "nondeterministic"), 0u);
  EXPECT_EQ(countEvents(store.index(), "gone"), 0u) << "what a scene that failed shows is not known";
  EXPECT_EQ(countEvents(store.index(), "regressed"), 1u) << "the scene";
  EXPECT_EQ(countEvents(store.index(), "fixed"), 1u);
  expectSameWhenRebuilt(store);
}

TEST_F(BlameTest, MachinesThatTakeTurnsHaveLanesOfTheirOwn) {
  Nights nights({});
  history::Store store = writer();
  for (int i = 0; i < 8; ++i) {
    history::RunRecord record = nights.next();
    if (i % 2 == 1) { // rounds otherwise
      record.numerics = "another";
      for (history::SceneRecord& scene : record.scenes)
        for (history::ViewRecord& view : scene.views) figureOf(view.whole, "bias.ev") += 0.001;
    }
    store.add(record);
  }
  EXPECT_EQ(countEvents(store.index()), countEvents(store.index(), "changed"));
  EXPECT_EQ(countEvents(store.index()), 16u) << "the first run of the second lane alone differs from its run before";
  const Blame blame = history::blame(store.index(), "scene 002/view 1", "bias.ev", {});
  EXPECT_EQ(causes(blame), "numerics");
}

TEST_F(BlameTest, AVerdictThatBudgetsChangeIsNoNondeterminism) {
  Nights nights({});
  history::Store store = writer();
  store.add(nights.next());
  nights.state().budgets = "others";
  nights.state().scenes[0].views[0].materials[0].verdict = compare::Verdict::fail;
  store.add(nights.next());
  const auto events = history::eventsOf(store.index(), 2);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "regressed");
  EXPECT_EQ(events[0].cause, "budgets");
  nights.state().scenes[0].views[0].materials[0].verdict = compare::Verdict::pass;
  store.add(nights.next());
  EXPECT_EQ(history::eventsOf(store.index(), 3).at(0).kind, "fixed");
  EXPECT_EQ(history::eventsOf(store.index(), 3).at(0).cause, "judging");
  const Blame blame = history::blame(store.index(), "scene 000/view 0/material 0", "", {});
  EXPECT_EQ(blame.verdictBefore, "fail");
  EXPECT_FALSE(blame.isNondeterministic);
}

TEST_F(BlameTest, WhatIsNewOrGoneIsOneEventForAWholeSceneOrView) {
  Nights nights({});
  history::Store store = writer();
  store.add(nights.next());
  const history::SceneRecord last = nights.state().scenes.back();
  nights.state().scenes.pop_back();
  nights.state().scenes[0].views.pop_back();
  nights.state().scenes[1].views[0].materials.pop_back();
  store.add(nights.next());
  auto events = history::eventsOf(store.index(), 2, "gone");
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].subject, "scene 000/view 1");
  EXPECT_EQ(events[1].subject, "scene 001/view 0/material 2");
  EXPECT_EQ(events[2].subject, "scene 007");
  nights.state().scenes.push_back(last);
  store.add(nights.next());
  events = history::eventsOf(store.index(), 3);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "new");
  EXPECT_EQ(events[0].subject, "scene 007");
  expectSameWhenRebuilt(store);
}

TEST_F(BlameTest, AnIncompleteRunLosesNothingAndAPartIsNotCompared) {
  Nights nights({});
  history::Store store = writer();
  store.add(nights.next());
  history::RunRecord incomplete = nights.next(), part = nights.next();
  incomplete.isComplete = false;
  incomplete.scenes.resize(2);
  incomplete.scenes[0].verdict = compare::Verdict::notRun;
  incomplete.scenes[0].error = "was not run";
  store.add(incomplete);
  part.isWhole = false;
  part.scenes.resize(1);
  figureOf(part.scenes[0].views[0].materials[0], "flip.mean") = 1;
  store.add(part);
  store.add(nights.next());
  EXPECT_EQ(countEvents(store.index()), 0u);
  EXPECT_EQ(store.index().number("SELECT count(*) FROM run"), 4);
  expectSameWhenRebuilt(store);
}

TEST_F(BlameTest, NamesakesAndUnknownNamesAreToldApart) {
  Nights nights({});
  nights.state().scenes[0].views[0].materials[1].name = "material 0";
  history::Store store = writer();
  store.add(nights.next());
  figureOf(nights.state().scenes[0].views[0].materials[1], "flip.mean") = 0.5;
  store.add(nights.next());
  EXPECT_FALSE(history::blame(store.index(), "scene 000/view 0/material 0", "", {}).isChanged);
  EXPECT_TRUE(history::blame(store.index(), "scene 000/view 0/material 0 (2)", "", {}).isChanged);
  base::expectError([&] { history::blame(store.index(), "scene 000/view 0/matrial 0", "", {}); },
                    "scene 000/view 0/matrial 0", "did you mean 'scene 000/view 0/material 0'", base::ExitCode::usage);
  base::expectError([&] { history::blame(store.index(), "scene 000/view 0", "flip.men", {}); }, "--metric",
                    "did you mean 'flip.mean'", base::ExitCode::usage);
}

TEST_F(BlameTest, ACrashIsAnEventOfItsScene) {
  Nights nights({});
  history::Store store = writer();
  store.add(nights.next());
  nights.state().incidents = {"scene 002: flaky crash: a worker crashed with SIGSEGV; the second try succeeded"};
  store.add(nights.next());
  const auto events = history::eventsOf(store.index(), 2);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "crashed");
  EXPECT_EQ(events[0].subject, "scene 002");
}

} // namespace
} // namespace parity::tests

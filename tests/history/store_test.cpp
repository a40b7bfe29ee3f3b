// A history's folder: what is killed, damaged, removed or in use at the same time.
#include <csignal>
#include <fstream>
#include <map>

#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/file_size_limit.h"
#include "history/history_folder.h"
#include "history/nights.h"
#include "history/pictures.h"
#include "history/run_file.h"
#include "history/synthetic_nights.h"

namespace parity::tests {
namespace {

namespace fs = std::filesystem;
using history::Store;

class StoreTest : public HistoryTest {
protected:
  void addNights(int count) const {
    Nights nights({});
    Store store = writer();
    for (int i = 0; i < count; ++i) {
      if (i % 3 == 2) nights.plant("asset", static_cast<std::size_t>(i) % 8);
      store.add(nights.next());
    }
  }
  fs::path newestRun() const { return history::runFile(folder(), history::listRuns(folder()).back()); }
  void execute(const char* sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(index().c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
  }
};

TEST_F(StoreTest, ARunFileReadsBackAsItWas) {
  Nights nights({});
  history::RunRecord record = nights.next();
  figureOf(record.scenes[0].views[0].materials[0], "psnr") = INFINITY; // psnr of equal pictures
  figureOf(record.scenes[0].views[0].materials[1], "flip.mean") = NAN;
  record.incidents = {"one"};
  record.stages = {{"shade", 12.5}};
  const history::EncodedRun run = history::encodeRun(record);
  EXPECT_TRUE(run.id.starts_with("20260101T030000Z-")) << run.id;
  const fs::path file = history::runFile(folder(), run.id);
  ASSERT_TRUE(base::writeOnce(file, run.bytes));
  EXPECT_EQ(history::encodeRun(history::readRunFile(file)).bytes, run.bytes);
  history::RunRecord back = history::readRunFile(file);
  EXPECT_EQ(figureOf(back.scenes[0].views[0].materials[0], "psnr"), INFINITY);
  EXPECT_TRUE(std::isnan(figureOf(back.scenes[0].views[0].materials[1], "flip.mean")));
}

TEST_F(StoreTest, TheSameRunAgainChangesNothing) {
  Nights nights({});
  const history::RunRecord record = nights.next();
  Store store = writer();
  EXPECT_FALSE(store.add(record).isKnown);
  const std::string before = dumpOf(index());
  EXPECT_TRUE(store.add(record).isKnown);
  history::RunRecord again = record; // from another folder, after a commit, with pictures
  again.report = "elsewhere", again.commit = "another", again.scenes[0].views[0].whole.pictures.flip = "picture";
  EXPECT_TRUE(store.add(again).isKnown);
  EXPECT_EQ(dumpOf(index()), before);
  again.scenes[0].views[0].whole.reason = "another";
  EXPECT_FALSE(store.add(again).isKnown) << "another run of the same second";
}

TEST_F(StoreTest, OnlyPicturesOfIntervalsAndOfRecentRunsStay) {
  Nights nights({});
  Store store = writer();
  const auto pictureOf = [&](char digit) {
    return folder() / "pictures" / std::string(2, digit) / (std::string(32, digit) + ".png");
  };
  for (const char digit : {'a', 'b', 'c', 'd', 'e'}) { // of one state
    nights.state().scenes[0].views[0].whole.pictures.flip = std::string(32, digit);
    fs::create_directories(pictureOf(digit).parent_path());
    base::writeText(pictureOf(digit), "a picture");
    store.add(nights.next());
  }
  const std::string since = "2026-01-04T00:00:00Z"; // the night of 'd'
  const history::Collected trial = history::collectPictures(store.index(), folder(), since, {}, true);
  EXPECT_EQ(trial.removed, 2u);
  EXPECT_EQ(trial.removedBytes, 18u);
  EXPECT_TRUE(fs::exists(pictureOf('b')));
  EXPECT_EQ(history::collectPictures(store.index(), folder(), since, {}, false).removed, 2u);
  for (const char digit : {'a', 'b', 'c', 'd', 'e'})
    EXPECT_EQ(fs::exists(pictureOf(digit)), digit != 'b' && digit != 'c') << digit;
}

TEST_F(StoreTest, CollectingMakesNoHistory) {
  base::expectError([&] { Store(folder(), Store::For::collecting); }, folder().string(), "is no history");
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(StoreTest, ASceneThatIsGoneAfterAnErrorLeavesNoIntervalThatEndsBeforeItBegins) {
  Nights nights({});
  Store store = writer();
  for (int i = 0; i < 3; ++i) store.add(nights.next());
  history::SceneRecord& scene = nights.state().scenes.back();
  scene.error = "cannot be read", scene.verdict = compare::Verdict::error, scene.views.clear();
  for (int i = 0; i < 2; ++i) store.add(nights.next());
  nights.state().scenes.pop_back();
  store.add(nights.next());
  for (const char* table : {"state", "value"})
    EXPECT_EQ(store.index().number("SELECT count(*) FROM " + std::string(table) + " WHERE last_run<first_run"), 0);
  expectSameWhenRebuilt(store);
}

TEST_F(StoreTest, ASceneThatFailedInTheFirstRunOfALaneIsComparedWithTheLaneBefore) {
  Nights nights({});
  Store store = writer();
  for (int i = 0; i < 2; ++i) store.add(nights.next());
  const history::SceneRecord whole = nights.state().scenes.back();
  nights.state().settings = std::string(12, 'f');
  history::SceneRecord& scene = nights.state().scenes.back();
  scene.error = "cannot be read", scene.verdict = compare::Verdict::error, scene.views.clear();
  store.add(nights.next());
  nights.state().scenes.back() = whole;
  history::RowRecord& row = nights.state().scenes.back().views[0].materials[0];
  row.verdict = compare::Verdict::fail, figureOf(row, "flip.mean") = 0.5;
  nights.state().scenes.back().views[0].materials.pop_back(); // which the lane before has
  store.add(nights.next());
  std::map<std::string, int> kinds;
  for (const history::Event& event :
       history::eventsOf(store.index(), history::nightsOf(store.index(), {}, 1).back().run.id)) {
    ++kinds[event.kind];
    if (event.kind == "regressed") {
      EXPECT_EQ(event.cause, "settings");
    }
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"fixed", 1}, {"regressed", 1}, {"gone", 1}}))
      << "the scene can be compared again; a row is worse than in the lane before, and one is missing";
  expectSameWhenRebuilt(store);
  store.add(nights.next());
  EXPECT_TRUE(history::eventsOf(store.index(), history::nightsOf(store.index(), {}, 1).back().run.id).empty());
}

TEST_F(StoreTest, ARowThatVanishesNamesTheInputThatChanged) {
  Nights nights({});
  Store store = writer();
  store.add(nights.next());
  nights.state().scenes[0].inputs.asset = "another";
  history::RowRecord& row = nights.state().scenes[0].views[0].materials[0];
  row.figures.clear(), row.verdict = compare::Verdict::notSeen;
  store.add(nights.next());
  const auto run = history::nightsOf(store.index(), {}, 1).back().run.id;
  const std::vector<history::Event> events = history::eventsOf(store.index(), run);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].cause, "asset");
}

TEST_F(StoreTest, AnOlderRunIsPutInItsPlace) {
  Nights nights({});
  std::vector<history::RunRecord> records;
  for (int i = 0; i < 4; ++i) {
    nights.plant("asset", static_cast<std::size_t>(i));
    records.push_back(nights.next());
  }
  {
    Store store = writer();
    for (const int i : {0, 3, 1, 2}) store.add(records[static_cast<std::size_t>(i)]);
  }
  const std::string mixed = dumpOf(index());
  fs::remove_all(folder());
  {
    Store store = writer();
    for (const history::RunRecord& record : records) store.add(record);
  }
  EXPECT_EQ(dumpOf(index()), mixed);
}

TEST_F(StoreTest, AnIndexThatIsGoneIsMadeAgain) {
  addNights(6);
  const std::string before = dumpOf(index());
  fs::remove(index());
  EXPECT_EQ(history::nightsOf(reader().index(), {}, 0).size(), 6u);
  EXPECT_EQ(dumpOf(index()), before);
}

TEST_F(StoreTest, RunsThatTheIndexLacksAreAddedToIt) {
  addNights(6);
  const std::string before = dumpOf(index());
  const fs::path newest = newestRun();
  fs::rename(newest, m_folder / "aside");
  reader(); // without it
  EXPECT_NE(dumpOf(index()), before);
  fs::rename(m_folder / "aside", newest);
  reader();
  EXPECT_EQ(dumpOf(index()), before);
}

TEST_F(StoreTest, ADamagedIndexIsToldAndMadeAgainByRebuild) {
  addNights(3);
  const std::string before = dumpOf(index());
  base::writeText(index(),
                  "This is no database, but a text that is long enough to be looked at as one, some hundred bytes.");
  base::expectError([&] { reader(); }, index().string(), "parity history rebuild");
  Store(folder(), Store::For::rebuilding).rebuild();
  EXPECT_EQ(dumpOf(index()), before);
}

TEST_F(StoreTest, AnIndexOfAnOlderSchemaIsMadeAgainAndOneOfANewerSchemaIsRefused) {
  addNights(3);
  const std::string before = dumpOf(index());
  execute("DROP TABLE event; PRAGMA user_version=0");
  reader();
  EXPECT_EQ(dumpOf(index()), before);
  execute("PRAGMA user_version=99");
  base::expectError([&] { reader(); }, index().string(), "is of schema 99, from a newer version of parity");
  base::expectError([&] { writer(); }, index().string(), "is of schema 99");
  Store(folder(), Store::For::rebuilding).rebuild();
  EXPECT_EQ(dumpOf(index()), before);
}

TEST_F(StoreTest, ARunFileThatIsNotWholeIsNamedAndTheOldIndexStays) {
  addNights(3);
  const std::string before = dumpOf(index());
  const fs::path newest = newestRun();
  const std::vector<std::byte> bytes = base::readFile(newest);
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
    fs::resize_file(newest, size);
    base::expectError([&] { Store(folder(), Store::For::rebuilding).rebuild(); }, newest.string(), "is damaged");
    EXPECT_EQ(dumpOf(index()), before);
    base::writeBytes(newest, bytes);
  }
  std::vector<std::byte> other = bytes;
  other[bytes.size() / 2] ^= std::byte{4};
  base::writeBytes(newest, other);
  base::expectError([&] { Store(folder(), Store::For::rebuilding).rebuild(); }, newest.string(), "is damaged");
  fs::rename(history::runFile(folder(), history::listRuns(folder()).front()), newest); // whole, but not of that name
  base::expectError([&] { Store(folder(), Store::For::rebuilding).rebuild(); }, newest.string(), "is damaged");
}

TEST_F(StoreTest, ARunOfANewerFormatIsRefused) {
  fs::create_directories(folder() / history::kRunFolder);
  const fs::path file = history::runFile(folder(), "20260101T030000Z-0123456789ab");
  gzFile to = gzopen(file.c_str(), "wb");
  gzputs(to, R"({"history":2,"nights":"of another kind, which this program does not know"})");
  gzclose(to);
  base::expectError([&] { reader(); }, file.string(), "is 2, from a newer version of parity; this one reads 1");
}

TEST_F(StoreTest, TwoWritersAreNotAtOnce) {
  const Store first = writer();
  base::expectError([&] { writer(); }, folder().string(), "another process writes this history",
                    base::ExitCode::incomplete);
  EXPECT_NO_THROW(reader());
}

TEST_F(StoreTest, WhatIsNoHistoryIsRefused) {
  base::expectError([&] { reader(); }, folder().string(), "is no history");
}

// Whatever a killed `add` leaves: the run is in the history wholly, or not at all, and the index made anew is the same.
TEST_F(StoreTest, AKilledWriterLeavesAnIndexThatIsTheSameWhenRebuilt) {
  std::size_t runs = 0;
  writer(); // the folder
  for (int round = 0; round < 12; ++round) {
    const pid_t child = fork();
    if (child == 0) try {
        Nights nights({.scenes = 20, .seed = 5});
        Store store = writer();
        for (int i = 0;; ++i) {
          if (i % 2 == 1) nights.plant("asset", static_cast<std::size_t>(i) % 20);
          store.add(nights.next()); // those of earlier rounds are known
        }
      } catch (...) {
        _exit(1);
      }
    for (int i = 0; i < 10'000 && history::listRuns(folder()).size() <= runs; ++i) usleep(2000); // one that is new
    usleep(3'700 * static_cast<useconds_t>(round));                                              // and the next, or not
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    reader();
    const std::size_t now = history::listRuns(folder()).size();
    EXPECT_GE(now, runs);
    runs = now;
    EXPECT_EQ(static_cast<std::size_t>(reader().index().number("SELECT count(*) FROM run").value()), runs);
    Store store(folder(), Store::For::rebuilding);
    expectSameWhenRebuilt(store);
  }
  EXPECT_GE(runs, 12u);
}

TEST_F(StoreTest, ADiskThatFillsLosesNothing) {
  addNights(3);
  const std::string before = dumpOf(index());
  Nights nights({.scenes = 300});
  for (int i = 0; i < 4; ++i) nights.next();
  const history::RunRecord record = nights.next();
  {
    const base::FileSizeLimit limit(64 << 10); // of any file that is written from now on
    Store store = writer();
    base::expectError([&] { store.add(record); }, {"cannot be written"});
  }
  EXPECT_EQ(dumpOf(index()), before);
  Store store = writer();
  EXPECT_FALSE(store.add(record).isKnown);
}

} // namespace
} // namespace parity::tests

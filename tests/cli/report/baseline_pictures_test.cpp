// A report keeps the baseline's pictures where its own are not the same.
#include <set>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class BaselinePicturesTest : public RenderingTest {
protected:
  RunResult report(const std::string& folder, const std::vector<std::string>& more = {}) const {
    return runParity(join({{"report", "builtin:furnace", "-o", path(folder), "--size", "64x64", "--pixel-data", "none",
                            "--cache", path("cache")},
                           kRoughSky,
                           more}));
  }
  json view(const std::string& folder) const { return readReport(m_folder / folder)["scenes"][0]["views"][0]; }
  // Makes one pixel of a report's picture another one.
  void dot(const std::string& file) const {
    base::Image8 image = base::readImage8(path(file), 3);
    image.pixels[0] = static_cast<std::uint8_t>(255 - image.pixels[0]);
    base::writeImage8(path(file), image);
  }
};

TEST_F(BaselinePicturesTest, OnlyWhatChangedIsKeptAndEachContentOnce) {
  ASSERT_TRUE(isReported(report("old")));
  ASSERT_TRUE(isReported(report("same", {"--baseline", path("old")})));
  EXPECT_FALSE(fs::exists(m_folder / "same" / "baseline"));
  EXPECT_FALSE(view("same")["whole"]["baseline"].contains("images"));

  ASSERT_TRUE(isReported(report("new", {"--baseline", path("old"), "--mobile-preset", "karis2014"})));
  const json changed = view("new");
  const json images = changed["whole"]["baseline"]["images"];
  EXPECT_EQ(images["reference"], "") << "the high-end path is as it was";
  const std::string kept = images["test"];
  ASSERT_TRUE(kept.starts_with("baseline/")) << images;
  EXPECT_TRUE(readWholeFile(m_folder / "new" / kept) ==
              readWholeFile(m_folder / "old" / view("old")["images"]["test"].get<std::string>()));
  std::set<std::string> named;
  for (const json& row : changed["materials"])
    if (row["baseline"].contains("images")) named.insert(row["baseline"]["images"]["test"].get<std::string>());
  EXPECT_GT(named.size(), 1u) << "crops of materials, too";
  named.insert(kept);
  std::set<std::string> files;
  for (const std::string& file : listFiles(m_folder / "new"))
    if (file.starts_with("baseline/")) files.insert(file);
  EXPECT_EQ(files, named) << "no file that nothing names";

  // The next report in this folder, without a baseline, leaves none of them.
  fs::copy_file(m_folder / "new" / kept, m_folder / "new" / "baseline" / "mine.png");
  ASSERT_TRUE(isReported(report("new")));
  EXPECT_FALSE(fs::exists(m_folder / "new" / kept));
  EXPECT_TRUE(fs::exists(m_folder / "new" / "baseline" / "mine.png")) << "not a report's";
}

TEST_F(BaselinePicturesTest, TheBaselineMayLieInTheReportsOwnFolder) {
  ASSERT_TRUE(isReported(report("out")));
  const std::string before = readWholeFile(m_folder / "out" / view("out")["images"]["test"].get<std::string>());
  ASSERT_TRUE(isReported(report("out", {"--baseline", path("out"), "--mobile-preset", "karis2014"})));
  const std::string kept = view("out")["whole"]["baseline"]["images"]["test"];
  EXPECT_TRUE(readWholeFile(m_folder / "out" / kept) == before);
}

TEST_F(BaselinePicturesTest, ASingleFileHoldsThem) {
  if (!kHasPage) GTEST_SKIP() << "no page";
  ASSERT_TRUE(isReported(report("old")));
  ASSERT_TRUE(isReported(report("one", {"--baseline", path("old"), "--mobile-preset", "karis2014", "--single-file"})));
  EXPECT_FALSE(fs::exists(m_folder / "one" / "baseline"));
  const std::string kept = view("one")["whole"]["baseline"]["images"]["test"];
  EXPECT_TRUE(contains(readWholeFile(m_folder / "one" / "index.html"), "data-file=\"" + kept + "\""));
}

TEST_F(BaselinePicturesTest, WhatCannotBeHadIsNoErrorAndNoPicture) {
  ASSERT_TRUE(isReported(report("old")));
  const json old = readReport(m_folder / "old");
  const std::string picture = old["scenes"][0]["views"][0]["images"]["test"];
  const auto expectNone = [&](const std::string& baseline, const std::string& why) {
    const RunResult result = report("new", {"--baseline", baseline});
    EXPECT_TRUE(isReported(result)) << why << result.err;
    EXPECT_FALSE(view("new")["whole"]["baseline"].contains("images")) << why;
    EXPECT_FALSE(fs::exists(m_folder / "new" / "baseline")) << why;
  };
  const auto withPicture = [&](const std::string& folder, const std::string& named) {
    json other = old;
    other["scenes"][0]["views"][0]["images"]["test"] = named;
    fs::create_directories(m_folder / folder / "images");
    write(folder + "/report.json", other.dump());
  };
  dot("old/" + picture); // so that it would be kept
  ASSERT_TRUE(isReported(report("new", {"--baseline", path("old")})));
  ASSERT_TRUE(view("new")["whole"]["baseline"].contains("images"));

  const fs::path elsewhere = m_folder / "old" / picture;
  for (const std::string& named : {"../old/" + picture, elsewhere.string(), "images/../../old/" + picture,
                                   std::string("images/none.png"), std::string("report.json"), std::string()}) {
    withPicture("other", named);
    expectNone(path("other"), named);
  }
  withPicture("other", "images/link.png");
  fs::create_symlink(elsewhere, m_folder / "other/images/link.png");
  expectNone(path("other"), "a link out of the folder");
  withPicture("other", "images/small.png");
  base::writeImage8(path("other/images/small.png"), base::Image8(32, 64, 3, 9));
  expectNone(path("other"), "another size");
  withPicture("other", "images/damaged.png");
  std::string damaged = readWholeFile(elsewhere);
  damaged.resize(damaged.size() / 2);
  write("other/images/damaged.png", damaged);
  expectNone(path("other"), "half of a file");
  json bare = old; // as older versions, or other programs, may have written it
  bare["scenes"][0]["views"][0].erase("images");
  for (json& material : bare["scenes"][0]["views"][0]["materials"]) material.erase("crops");
  write("bare.json", bare.dump());
  expectNone(path("bare.json"), "JSON alone");
  // A copy of report.json beside pictures of a later run.
  fs::copy_file(m_folder / "old/report.json", m_folder / "old/kept.json");
  json later = old;
  later["version"] = "later";
  write("old/report.json", later.dump());
  expectNone(path("old/kept.json"), "the pictures beside it may be of another run");
}

} // namespace
} // namespace parity::tests

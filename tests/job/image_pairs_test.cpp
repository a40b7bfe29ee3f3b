// Pairs of files are found by name, and what has no counterpart is kept.
#include "job/image_pairs.h"

#include <fstream>

#include <gtest/gtest.h>

#include "base/error.h"

namespace parity::job {
namespace {

namespace fs = std::filesystem;

class ImagePairs : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    m_folder = fs::path(testing::TempDir()) / (std::string("parity_pairs_") + test->name());
    fs::remove_all(m_folder);
    fs::create_directories(m_folder / "r" / "deep");
    fs::create_directories(m_folder / "t" / "deep");
  }
  void TearDown() override { fs::remove_all(m_folder); }
  void touch(const std::string& name, const std::string& text = "x") const { std::ofstream(m_folder / name) << text; }
  std::vector<std::string> match() const {
    std::vector<std::string> found;
    for (const FilePair& pair : findPairs(m_folder / "r", m_folder / "t").pairs)
      found.push_back(pair.name + (pair.missing.empty() ? "" : " !"));
    return found;
  }
  fs::path m_folder;
};

TEST_F(ImagePairs, SameRelativePathComesBeforeSameStem) {
  for (const char* name : {"r/a.png", "r/a.exr", "t/a.png", "t/a.hdr", "r/deep/b.PNG", "t/deep/b.jpg"}) touch(name);
  EXPECT_EQ(match(), (std::vector<std::string>{"a.exr", "a.png", "deep/b"}));
}

TEST_F(ImagePairs, MissingOnEitherSideAreKeptByName) {
  for (const char* name : {"r/a.png", "t/a.png", "r/only.png", "t/extra.png"}) touch(name);
  EXPECT_EQ(match(), (std::vector<std::string>{"a", "extra !", "only !"}));
}

TEST_F(ImagePairs, OtherAndHiddenFilesArePassedOver) {
  for (const char* name : {"r/a.png", "t/a.png", "r/notes.txt", "t/.a.png"}) touch(name);
  fs::create_directories(m_folder / "r" / ".git");
  touch("r/.git/b.png");
  EXPECT_EQ(match(), (std::vector<std::string>{"a"}));
  EXPECT_EQ(findPairs(m_folder / "r", m_folder / "t").skippedFiles, 1u);
}

TEST_F(ImagePairs, NamesOfAListNeverLeaveTheFolderOfTheResults) {
  touch("list.txt", "../../x/a.png b.png\n/abs/a.png b.png\n./c\\d.png \"e \\\"f\\\" \\\\.png\"\n");
  const FilePairs pairs = readPairList(m_folder / "list.txt");
  ASSERT_EQ(pairs.pairs.size(), 3u);
  EXPECT_EQ(pairs.pairs[0].name, "x/a.png");
  EXPECT_EQ(pairs.pairs[1].name, "abs/a.png");
  EXPECT_EQ(pairs.pairs[1].reference, "/abs/a.png");
  EXPECT_EQ(pairs.pairs[2].test, m_folder / "e \"f\" \\.png");
}

} // namespace
} // namespace parity::job

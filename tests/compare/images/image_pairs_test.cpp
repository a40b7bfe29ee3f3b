// Pairs of files are found by name, and what has no counterpart is kept.
#include "compare/images/image_pairs.h"

#include <fstream>

#include <gtest/gtest.h>

#include "base/error.h"

namespace parity::compare {
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
  const std::vector<std::string> skipped = findPairs(m_folder / "r", m_folder / "t").skipped;
  EXPECT_EQ(skipped,
            (std::vector<std::string>{(m_folder / "r/.git").string() + " (hidden)", (m_folder / "r/notes.txt").string(),
                                      (m_folder / "t/.a.png").string() + " (hidden)"}));
}

TEST_F(ImagePairs, RarerKindsAndLinkedFoldersAreFound) {
  fs::create_directories(m_folder / "elsewhere");
  for (const char* name : {"r/a.tx", "r/b.JPE", "r/c.pbm", "r/d.jfif", "r/e.dib", "elsewhere/f.png"}) touch(name);
  fs::create_directory_symlink("../elsewhere", m_folder / "r" / "linked");
  fs::create_directory_symlink("..", m_folder / "r" / "deep" / "loop");
  for (const char* name : {"t/a.tx", "t/b.JPE", "t/c.pbm", "t/d.jfif", "t/e.dib"}) touch(name);
  EXPECT_EQ(match(), (std::vector<std::string>{"a", "b", "c", "d", "e", "linked/f !"}));
  const std::vector<std::string> skipped = findPairs(m_folder / "r", m_folder / "t").skipped;
  ASSERT_EQ(skipped.size(), 1u);
  EXPECT_NE(skipped[0].find("loop"), std::string::npos);
}

TEST_F(ImagePairs, NamesAreUniqueThoughOneIsTheStemOfAnother) {
  for (const char* side : {"r/", "t/"})
    for (const char* name : {"a.pfm", "a.exr", "a.pfm.exr"}) touch(std::string(side) + name);
  EXPECT_EQ(match(), (std::vector<std::string>{"a.exr", "a.pfm", "a.pfm.exr"}));
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
} // namespace parity::compare

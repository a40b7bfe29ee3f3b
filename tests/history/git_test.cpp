// What git is asked, and the run that a branch is held against.
#include "base/expect_error.h"
#include "base/file.h"
#include "history/baseline.h"
#include "history/git.h"
#include "history/git_repository.h"
#include "history/history_folder.h"
#include "history/synthetic_nights.h"

namespace parity::tests {
namespace {

using history::Git;

class GitTest : public HistoryTest {
protected:
  void SetUp() override {
    if (!GitRepository::canMake()) GTEST_SKIP() << "git is not installed: scripts/install-deps";
  }
};

TEST_F(GitTest, NamesAreFoundAndWhatIsNoCommitIsNot) {
  const GitRepository repository(m_folder / "repository");
  const std::string first = repository.commit("first");
  const Git git(repository.folder());
  EXPECT_TRUE(git.isThere());
  EXPECT_EQ(git.commit("HEAD"), first);
  EXPECT_EQ(git.commit(first.substr(0, 10)), first);
  EXPECT_EQ(git.branch(), "main");
  EXPECT_TRUE(git.commitTime("HEAD").value().ends_with("Z"));
  for (const char* name : {"", "nothing", "--all", "-h", "$(touch x)", "HEAD; touch x"})
    EXPECT_FALSE(git.commit(name)) << name;
  EXPECT_FALSE(std::filesystem::exists(repository.folder() / "x"));
  repository.run({"checkout", "--quiet", "--detach"});
  EXPECT_FALSE(git.branch());
  EXPECT_FALSE(Git(m_folder.path()).isThere());
}

TEST_F(GitTest, ABranchIsHeldAgainstTheNewestWholeRunThatItHasInCommonWithItsTarget) {
  const GitRepository repository(m_folder / "repository");
  std::vector<std::string> commits;
  for (int i = 0; i < 5; ++i) commits.push_back(repository.commit(std::to_string(i)));
  repository.run({"checkout", "--quiet", "-b", "feature", commits[3]});
  const std::string own = repository.commit("feature");
  const Git git(repository.folder());
  Nights nights({});
  history::Store store = writer();
  const auto add = [&](const std::string& commit, bool isComplete, bool isWhole) {
    history::RunRecord record = nights.next();
    record.commit = commit, record.isComplete = isComplete, record.isWhole = isWhole;
    record.report = "report of " + commit;
    return store.add(record).id;
  };
  EXPECT_FALSE(history::findBaseline(store.index(), git, {}));
  add(commits[0], true, true);
  const std::string wanted = add(commits[1], true, true);
  add(commits[2], false, true); // incomplete
  add(commits[3], true, false); // a part
  add(commits[4], true, true);  // is not in the branch
  add(own, true, true);         // is not in its target
  history::RunRecord broken = nights.next();
  broken.commit = commits[2], broken.scenes[0].error = "cannot be read";
  store.add(broken);
  const auto found = history::findBaseline(store.index(), git, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->run.name, wanted);
  EXPECT_EQ(found->report, "report of " + commits[1]);
  const std::string again = add(commits[1], true, true);
  EXPECT_EQ(history::findBaseline(store.index(), git, {})->run.name, again) << "the newest of a commit";
  EXPECT_FALSE(history::findBaseline(store.index(), git, {.suite = "another"}));
  base::expectError([&] { history::findBaseline(store.index(), git, {.into = "nowhere"}); }, "git", "is no commit");
  base::expectError([&] { history::findBaseline(store.index(), Git(m_folder.path()), {}); }, "git", "no repository");
}

} // namespace
} // namespace parity::tests

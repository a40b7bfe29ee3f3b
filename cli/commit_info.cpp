#include "cli/commit_info.h"

#include <cstdlib>
#include <initializer_list>

#include "history/git.h"

namespace parity::cli {

namespace {

// The first that is set: ours, GitHub's, GitLab's, Buildkite's, CircleCI's. Of a pull request the branch is its own.
constexpr std::initializer_list<const char*> kCommit = {"PARITY_COMMIT", "GITHUB_SHA", "CI_COMMIT_SHA",
                                                        "BUILDKITE_COMMIT", "CIRCLE_SHA1"};
constexpr std::initializer_list<const char*> kBranch = {
    "PARITY_BRANCH",    "GITHUB_HEAD_REF",  "GITHUB_REF_NAME", "CI_MERGE_REQUEST_SOURCE_BRANCH_NAME",
    "CI_COMMIT_BRANCH", "BUILDKITE_BRANCH", "CIRCLE_BRANCH"};
constexpr std::initializer_list<const char*> kTime = {"PARITY_COMMIT_TIME", "CI_COMMIT_TIMESTAMP"};

std::string fromEnvironment(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const char* value = std::getenv(name); value && *value) return value;
  return {};
}

} // namespace

history::CommitInfo commitInfo(history::CommitInfo given, const std::filesystem::path& repository) {
  const history::Git git(repository);
  const bool isGiven = !given.commit.empty();
  if (given.branch.empty()) given.branch = fromEnvironment(kBranch);
  if (given.commit.empty()) given.commit = fromEnvironment(kCommit);
  if (given.commitTime.empty() && !isGiven) given.commitTime = fromEnvironment(kTime); // which is that of its commit
  if (given.commit.empty()) given.commit = git.commit("HEAD").value_or("");
  if (given.branch.empty()) given.branch = git.branch().value_or("");
  if (const auto whole = git.commit(given.commit)) given.commit = *whole; // of a few digits, or a name
  if (given.commitTime.empty()) given.commitTime = git.commitTime(given.commit).value_or("");
  return given;
}

} // namespace parity::cli

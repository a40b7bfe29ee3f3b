#include "history/baseline.h"

#include <fmt/format.h>

#include "base/error.h"

namespace parity::history {

namespace {

constexpr std::size_t kMostCommits = 10'000; // that are looked at

} // namespace

std::optional<BaselineRun> findBaseline(const Database& index, const Git& git, const BaselineQuestion& question) {
  for (const std::string& name : {question.into, question.commit})
    if (!git.commit(name))
      throw base::fileError(
          "git", name, git.isThere() ? "is no commit of the repository" : "is not installed, or this is no repository");
  const std::optional<std::string> base = git.mergeBase(question.into, question.commit);
  if (!base)
    throw base::fileError("git", fmt::format("{} and {}", question.into, question.commit), "have no common ancestor");
  Statement find = index.prepare(
      "SELECT id, report FROM run WHERE commit_id=?1 AND complete AND whole AND broken=0 AND (?2 IS NULL OR "
      "suite=?3) ORDER BY id DESC LIMIT 1");
  for (const std::string& commit : git.ancestors(*base, kMostCommits)) {
    find.bind(commit, question.suite ? std::optional<std::int64_t>(1) : std::nullopt, question.suite.value_or(""));
    if (find.step()) return BaselineRun{findRun(index, find.integer(0)), find.text(1)};
  }
  return std::nullopt;
}

} // namespace parity::history

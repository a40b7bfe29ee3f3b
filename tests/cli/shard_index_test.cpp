// Which shard a scheduler means.
#include "cli/shard_index.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "base/expect_error.h"

namespace parity::cli {
namespace {

constexpr const char* kAll[] = {
    "PARITY_SHARD",           "SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "CI_NODE_INDEX",
    "BUILDKITE_PARALLEL_JOB", "CIRCLE_NODE_INDEX",   "TEST_SHARD_INDEX",     "PARALLEL_SEQ"};

// An environment of no scheduler, and what a test sets of one.
class ShardIndexTest : public testing::Test {
protected:
  void SetUp() override {
    for (const char* name : kAll) unsetenv(name);
  }
  void TearDown() override { SetUp(); }
};

TEST_F(ShardIndexTest, NumbersCountFromZeroAndEndBeforeTheCount) {
  EXPECT_EQ(shardIndex("0", 3), 0u);
  EXPECT_EQ(shardIndex("2", 3), 2u);
  for (const char* text : {"3", "-1", "1.0", " 1", "0x1", "one", "", "99999999999999999999"})
    base::expectError([&] { shardIndex(text, 3); }, "--shard", "shard", base::ExitCode::usage);
}

TEST_F(ShardIndexTest, EachSchedulersOwnNumberIsReadFromItsFirst) {
  for (const char* name : kAll) {
    SetUp();
    const bool fromOne = std::string(name) == "CI_NODE_INDEX" || std::string(name) == "PARALLEL_SEQ";
    setenv(name, "2", 1);
    EXPECT_EQ(shardIndex("auto", 3), fromOne ? 1u : 2u) << name;
    setenv(name, fromOne ? "4" : "3", 1);
    base::expectError([] { shardIndex("auto", 3); }, name, "there is no shard", base::ExitCode::usage);
    setenv(name, fromOne ? "0" : "-1", 1);
    base::expectError([] { shardIndex("auto", 3); }, name, "shard", base::ExitCode::usage);
    EXPECT_EQ(shardIndex("0", 3), 0u) << "a number goes before the environment";
  }
}

TEST_F(ShardIndexTest, ParitysOwnVariableGoesFirst) {
  setenv("SLURM_ARRAY_TASK_ID", "1", 1);
  setenv("PARITY_SHARD", "2", 1);
  EXPECT_EQ(shardIndex("auto", 3), 2u);
}

TEST_F(ShardIndexTest, WithoutASchedulerTheVariablesAreNamed) {
  base::expectError([] { shardIndex("auto", 3); }, "--shard auto", "JOB_COMPLETION_INDEX", base::ExitCode::usage);
}

} // namespace
} // namespace parity::cli

// Which shard a machine is to do, as its scheduler says.
#pragma once

#include <cstddef>
#include <string>

namespace parity::cli {

// shard: a number from 0, or "auto": what the first of these variables of the environment says: PARITY_SHARD,
// SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX (Kubernetes), CI_NODE_INDEX (GitLab, from 1), BUILDKITE_PARALLEL_JOB,
// CIRCLE_NODE_INDEX, TEST_SHARD_INDEX (Bazel), PARALLEL_SEQ (GNU parallel, from 1). count: of the plan's shards. Throws
// Error (usage) where there is no such number, or no such shard.
std::size_t shardIndex(const std::string& shard, std::size_t count);

// Tells Bazel that the test knows of shards (TEST_SHARD_STATUS_FILE).
void tellSharded();

} // namespace parity::cli

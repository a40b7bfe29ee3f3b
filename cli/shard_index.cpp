#include "cli/shard_index.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::cli {

namespace {

struct Variable {
  const char* name;
  std::size_t first; // index of the first shard
};
constexpr std::array<Variable, 8> kVariables = {{{"PARITY_SHARD", 0},
                                                 {"SLURM_ARRAY_TASK_ID", 0},
                                                 {"JOB_COMPLETION_INDEX", 0},
                                                 {"CI_NODE_INDEX", 1},
                                                 {"BUILDKITE_PARALLEL_JOB", 0},
                                                 {"CIRCLE_NODE_INDEX", 0},
                                                 {"TEST_SHARD_INDEX", 0},
                                                 {"PARALLEL_SEQ", 1}}};

std::size_t readIndex(const std::string& text, const std::string& where, std::size_t first, std::size_t count) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size() || text.empty())
    throw base::Error(base::ExitCode::usage, where, "", "'" + text + "' is not the number of a shard");
  if (index < first || index - first >= count)
    throw base::Error(
        base::ExitCode::usage, where, "",
        fmt::format("there is no shard {}: the plan has {} ({} to {})", text, count, first, first + count - 1));
  return index - first;
}

} // namespace

std::size_t shardIndex(const std::string& shard, std::size_t count) {
  if (shard != "auto") return readIndex(shard, "--shard", 0, count);
  for (const Variable& variable : kVariables)
    if (const char* value = std::getenv(variable.name); value && *value)
      return readIndex(value, variable.name, variable.first, count);
  std::string names;
  for (const Variable& variable : kVariables) names += (names.empty() ? "" : ", ") + std::string(variable.name);
  throw base::Error(base::ExitCode::usage, "--shard auto", "",
                    "no scheduler says which shard: none of these variables is set: " + names);
}

void tellSharded() {
  if (const char* file = std::getenv("TEST_SHARD_STATUS_FILE")) std::ofstream(file, std::ios::app).flush();
}

} // namespace parity::cli

// parity cache: what is kept between runs, and its end.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/cache.h"
#include "base/log.h"
#include "cli/invocation.h"
#include "cli/output.h"

namespace parity::cli {

namespace {

std::string describeBytes(std::uintmax_t bytes) {
  constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

} // namespace

int runCacheCommand(const CacheCommand& command) {
  const base::Cache cache(command.folder);
  std::error_code unknown; // what a folder on a full or foreign disk does not tell
  const std::uintmax_t free = std::filesystem::space(command.folder, unknown).available;
  base::logDetail(unknown ? fmt::format("{}: {}", command.folder.string(), unknown.message())
                          : fmt::format("{}: {} are free on its disk", command.folder.string(), describeBytes(free)));
  const base::CacheContents contents = command.clear ? cache.clear() : cache.describe();
  if (!command.json.empty()) {
    nlohmann::ordered_json kinds = nlohmann::ordered_json::array();
    for (const base::CacheKind& kind : contents.kinds)
      kinds.push_back({{"kind", kind.name}, {"entries", kind.entries}, {"bytes", kind.bytes}});
    const nlohmann::ordered_json json = {{"folder", command.folder.string()},
                                         {"entries", contents.entries},
                                         {"bytes", contents.bytes},
                                         {"kinds", kinds},
                                         {"cleared", command.clear}};
    writeJson(command.json, dumpJson(json));
  }
  if (command.json == "-") return 0;
  print("{}{}: {} entries, {}\n", command.clear ? "cleared " : "", command.folder.string(), contents.entries,
        describeBytes(contents.bytes));
  for (const base::CacheKind& kind : contents.kinds)
    print("  {:<12} {:>6} {:>12}\n", kind.name, kind.entries, describeBytes(kind.bytes));
  return 0;
}

} // namespace parity::cli

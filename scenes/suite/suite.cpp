// The suite file: TOML. docs/suite.md describes it.
#include "scenes/suite/suite.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "scenes/suite/expand.h"
#include "scenes/suite/suite_tables.h"

namespace parity::scenes {
namespace {

// Files that include each other, from the first.
using Chain = std::vector<std::string>;

Suite load(const std::filesystem::path& file, const SuiteKnobs& knobs, Chain& chain) {
  SuiteTables tables = readSuiteTables(file, knobs);
  Suite suite{.name = tables.name, .budgets = tables.budgets, .given = tables.defaults.given, .entries = {}};
  chain.push_back(std::filesystem::weakly_canonical(file).string());
  for (const auto& [path, where] : tables.include) {
    if (std::ranges::find(chain, std::filesystem::weakly_canonical(path).string()) != chain.end())
      throw base::Error(base::ExitCode::failed, where, "", fmt::format("'{}' includes itself", path));
    Suite included = load(path, knobs, chain);
    for (SuiteEntry& entry : included.entries) {
      entry.defaults = base::merged(included.given, entry.defaults);
      if (!entry.budgets) entry.budgets = included.budgets;
      suite.entries.push_back(std::move(entry));
    }
  }
  chain.pop_back();
  std::ranges::move(expandScenes(tables), std::back_inserter(suite.entries));
  applyOverrides(tables.overrides, suite.entries);
  if (suite.entries.size() > kMostScenes)
    throw base::fileError(file.string(), "", fmt::format("the suite has more than {} scenes", kMostScenes));
  return suite;
}

} // namespace

Suite loadSuite(const std::filesystem::path& file, const SuiteKnobs& knobs) {
  Chain chain;
  Suite suite = load(file, knobs, chain);
  if (suite.entries.empty()) throw base::fileError(file.string(), "", "has no scene; add [[scene]]");
  requireDifferentNames(suite.entries);
  return suite;
}

} // namespace parity::scenes

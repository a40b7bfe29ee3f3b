#include "job/paths.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "highend/path.h"
#include "mobile/path.h"

namespace parity::job {

namespace {

std::vector<const paths::Path*>& list() {
  static std::vector<const paths::Path*> paths = {&highend::path(), &mobile::path()};
  return paths;
}

} // namespace

const std::vector<const paths::Path*>& allPaths() { return list(); }

void addPath(const paths::Path& path) { list().push_back(&path); }

std::vector<std::string> pathNames() {
  std::vector<std::string> names;
  for (const paths::Path* path : list()) names.push_back(path->name());
  return names;
}

const paths::Path& pathByName(const std::string& name) {
  const auto found = std::ranges::find_if(list(), [&](const paths::Path* path) { return path->name() == name; });
  if (found == list().end())
    throw base::Error(base::ExitCode::usage, "--paths", name,
                      fmt::format("is not a path; the paths are {}", fmt::join(pathNames(), ", ")));
  return **found;
}

PathChoice pathsOf(const Settings& settings) {
  PathChoice choice{.chosen = {}, .truth = settings.truth};
  for (const std::string& name : settings.pathNames) choice.chosen.push_back(&pathByName(name));
  return choice;
}

} // namespace parity::job

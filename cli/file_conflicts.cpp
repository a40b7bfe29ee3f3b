#include "cli/file_conflicts.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::cli {

namespace {

namespace fs = std::filesystem;

// One path for each file, whether it exists or not.
fs::path identify(const fs::path& path) {
  std::error_code error;
  const fs::path known = fs::weakly_canonical(path, error);
  return error ? fs::absolute(path, error).lexically_normal() : known;
}

bool isNone(const fs::path& file) { return file.empty() || file == "-"; }

} // namespace

void requireSeparate(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  std::map<fs::path, const NamedFile*> taken;
  for (const NamedFile& input : inputs)
    if (!isNone(input.file)) taken.emplace(identify(input.file), &input);
  std::map<fs::path, const NamedFile*> written;
  for (const NamedFile& output : outputs) {
    if (isNone(output.file)) continue;
    const fs::path file = identify(output.file);
    if (const auto found = taken.find(file); found != taken.end())
      throw base::Error(base::ExitCode::usage, output.name, "'" + output.file.string() + "'",
                        fmt::format("would overwrite {}", found->second->name));
    if (const auto [other, isNew] = written.emplace(file, &output); !isNew)
      throw base::Error(base::ExitCode::usage, output.name, "'" + output.file.string() + "'",
                        fmt::format("is also the file of {}; give another file", other->second->name));
  }
}

bool liesIn(const fs::path& path, const fs::path& folder) {
  const fs::path inner = identify(path), outer = identify(folder);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

} // namespace parity::cli

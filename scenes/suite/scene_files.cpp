#include "scenes/suite/scene_files.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "base/text/glob.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 64; // of folders below each other

bool hasWildcard(std::string_view text) { return text.find_first_of("*?[") != std::string_view::npos; }

bool isSceneFile(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".gltf" || ending == ".glb";
}

std::vector<std::string> partsOf(const fs::path& path) {
  std::vector<std::string> parts;
  for (const fs::path& part : path) parts.push_back(part.string());
  return parts;
}

bool matchesPart(const std::string& glob, const std::string& name) {
  return (!name.starts_with('.') || glob.starts_with('.')) && base::matchesGlob(glob, name);
}

// Whether the parts from `at` on match the glob's from `from` on.
bool matchesPath(const std::vector<std::string>& glob, const std::vector<std::string>& path, std::size_t from = 0,
                 std::size_t at = 0) {
  for (; from < glob.size(); ++from, ++at) {
    if (glob[from] == "**") {
      for (std::size_t rest = at; rest <= path.size(); ++rest) {
        if (matchesPath(glob, path, from + 1, rest)) return true;
        if (rest < path.size() && path[rest].starts_with('.') && path[rest] != "..") return false;
      }
      return false;
    }
    if (at == path.size()) return false;
    if (glob[from] != path[at] && !matchesPart(glob[from], path[at])) return false;
  }
  return at == path.size();
}

// The scene files below a folder that the parts of a glob from `from` on match.
class Walk {
public:
  Walk(const std::vector<std::string>& parts, std::set<std::string>& found) : m_parts(parts), m_found(found) {}

  void enter(const fs::path& folder, std::size_t from, int depth = 0) {
    const bool isAnyFolder = m_parts[from] == "**", isLast = from + 1 == m_parts.size();
    if (isAnyFolder && !isLast) enter(folder, from + 1, depth);
    if (depth > kMaxDepth) return;
    std::error_code none;
    for (fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, none), end; entry != end;
         entry.increment(none)) {
      const std::string name = entry->path().filename().string();
      if (isAnyFolder ? name.starts_with('.') : !matchesPart(m_parts[from], name)) continue;
      if (entry->is_directory(none)) {
        if (isAnyFolder ? !entry->is_symlink(none) : !isLast)
          enter(folder / name, isAnyFolder ? from : from + 1, depth + 1);
      } else if (isLast && isSceneFile(entry->path())) {
        m_found.insert((folder / name).lexically_normal().generic_string());
        if (m_found.size() > kMostSceneFiles)
          throw std::runtime_error(fmt::format("more than {} scene files match", kMostSceneFiles));
      }
    }
  }

private:
  const std::vector<std::string>& m_parts;
  std::set<std::string>& m_found;
};

// The folder before the first wildcard, and the parts from there on.
std::pair<fs::path, std::vector<std::string>> split(const fs::path& folder, const std::string& glob) {
  std::vector<std::string> parts = partsOf(fs::path(glob).lexically_normal());
  const auto first = std::ranges::find_if(parts, hasWildcard);
  fs::path start = folder;
  for (auto part = parts.begin(); part != first; ++part) start /= *part;
  parts.erase(parts.begin(), first);
  const auto isTwice = [](const std::string& a, const std::string& b) { return a == "**" && b == "**"; };
  parts.erase(std::unique(parts.begin(), parts.end(), isTwice), parts.end());
  return {start.empty() ? fs::path(".") : start, parts};
}

std::string whyNone(const std::string& glob, const fs::path& start) {
  std::error_code none;
  if (!fs::is_directory(start, none)) return fmt::format("'{}': there is no folder '{}'", glob, start.string());
  return fmt::format("no scene file (.gltf, .glb) matches '{}'", glob);
}

} // namespace

std::vector<std::string> findSceneFiles(const FileGlobs& globs) {
  std::vector<std::vector<std::string>> excluded;
  for (const std::string& glob : globs.exclude)
    excluded.push_back(partsOf((globs.folder / glob).lexically_normal().generic_string()));
  std::vector<bool> isUsed(excluded.size(), false);
  const auto isExcluded = [&](const std::string& file) {
    const std::vector<std::string> parts = partsOf(file);
    bool is = false;
    for (std::size_t i = 0; i < excluded.size(); ++i)
      if (matchesPath(excluded[i], parts)) is = isUsed[i] = true;
    return is;
  };
  std::set<std::string> all;
  for (const std::string& glob : globs.files) {
    if (isBuiltin(glob)) {
      all.insert(glob);
      continue;
    }
    if (!hasWildcard(glob)) { // loading says whether it is there, as with `file`
      all.insert((globs.folder / glob).lexically_normal().generic_string());
      continue;
    }
    const auto [start, parts] = split(globs.folder, glob);
    std::set<std::string> found;
    Walk(parts, found).enter(start, 0);
    if (found.empty()) throw std::runtime_error(whyNone(glob, start));
    std::erase_if(found, isExcluded);
    if (found.empty()) throw std::runtime_error(fmt::format("'exclude' leaves no file of '{}'", glob));
    all.merge(found);
    if (all.size() > kMostSceneFiles)
      throw std::runtime_error(fmt::format("more than {} scene files match", kMostSceneFiles));
  }
  for (std::size_t i = 0; i < isUsed.size(); ++i)
    if (!isUsed[i]) throw std::runtime_error(fmt::format("'exclude': no file matches '{}'", globs.exclude[i]));
  return {all.begin(), all.end()};
}

} // namespace parity::scenes

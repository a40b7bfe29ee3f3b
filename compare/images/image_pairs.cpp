#include "compare/images/image_pairs.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/standard_input.h"

namespace parity::compare {

namespace {

namespace fs = std::filesystem;

// What the formats that are read (base/image/image_format.h) are called.
bool isPicture(const fs::path& file) {
  constexpr std::string_view kExtensions =
      " exr sxr mxr tif tiff tx env sm vsm jpg jpe jpeg jif jfif jfi bmp dib hdr rgbe png ppm pgm "
      "pbm pnm pfm tga tpic webp ";
  std::string extension = file.extension().string();
  if (extension.size() < 2 || extension.find(' ') != std::string::npos) return false;
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return kExtensions.find(" " + extension.substr(1) + " ") != std::string_view::npos;
}

// The pictures below a folder, by their relative paths, and what else lies there.
class Listing {
public:
  explicit Listing(const fs::path& folder) : m_root(folder) { visit(folder, {}); }

  std::set<fs::path> pictures;
  std::vector<std::string> skipped; // in words

private:
  // outer: the folders on the way, with all links resolved: one of them again would never end.
  void visit(const fs::path& folder, std::set<fs::path> outer) {
    std::error_code error;
    if (!outer.insert(fs::canonical(folder, error)).second) {
      skipped.push_back(folder.string() + " (a link to one of its parent folders)");
      return;
    }
    fs::directory_iterator it(folder, error);
    for (; !error && it != fs::directory_iterator(); it.increment(error)) {
      const fs::path& path = it->path();
      std::error_code ignored;
      if (path.filename().string().starts_with('.'))
        skipped.push_back(path.string() + " (hidden)");
      else if (it->is_directory(ignored))
        visit(path, outer);
      else if (isPicture(path))
        pictures.insert(path.lexically_relative(m_root));
      else
        skipped.push_back(path.string());
    }
    if (error) throw base::fileError(folder.string(), "cannot be listed", error.message());
  }

  fs::path m_root;
};

fs::path stemOf(const fs::path& relative) { return relative.parent_path() / relative.stem(); }

// Those of equal stem, by stem.
std::map<fs::path, std::vector<fs::path>> groupByStem(const std::set<fs::path>& pictures) {
  std::map<fs::path, std::vector<fs::path>> groups;
  for (const fs::path& picture : pictures) groups[stemOf(picture)].push_back(picture);
  return groups;
}

// Names without extension where that tells the pairs apart, also from the whole names of others: beside a.pfm and
// a.exr, a.pfm.exr keeps its own.
void nameByStem(std::vector<FilePair>& pairs) {
  std::map<std::string, int> uses;
  for (const FilePair& pair : pairs) {
    ++uses[stemOf(pair.name).generic_string()];
    ++uses[pair.name];
  }
  for (FilePair& pair : pairs)
    if (const std::string stem = stemOf(pair.name).generic_string(); uses[stem] == 1) pair.name = stem;
  std::sort(pairs.begin(), pairs.end(), [](const FilePair& a, const FilePair& b) { return a.name < b.name; });
}

FilePairs matchFolders(const fs::path& reference, const fs::path& test) {
  FilePairs result;
  result.many = true;
  const Listing referenceFiles(reference), testFiles(test);
  std::set<fs::path> references = referenceFiles.pictures, tests = testFiles.pictures;
  for (const Listing* listing : {&referenceFiles, &testFiles})
    result.skipped.insert(result.skipped.end(), listing->skipped.begin(), listing->skipped.end());
  std::sort(result.skipped.begin(), result.skipped.end());
  if (references.empty() && tests.empty())
    throw base::fileError(reference.string(), "", fmt::format("holds no picture, and neither does {}", test.string()));
  for (auto it = references.begin(); it != references.end();) {
    if (!tests.contains(*it)) {
      ++it;
      continue;
    }
    result.pairs.push_back({it->generic_string(), reference / *it, test / *it, ""});
    tests.erase(*it);
    it = references.erase(it);
  }
  auto testGroups = groupByStem(tests);
  for (const auto& [stem, group] : groupByStem(references)) {
    const std::vector<fs::path> others = testGroups[stem];
    if (group.size() == 1 && others.size() == 1) {
      result.pairs.push_back({group[0].generic_string(), reference / group[0], test / others[0], ""});
      testGroups.erase(stem);
      continue;
    }
    const std::string why = others.empty() ? "no counterpart" : "more than one possible counterpart";
    for (const fs::path& picture : group)
      result.pairs.push_back({picture.generic_string(),
                              reference / picture,
                              {},
                              fmt::format("{}: {} in {}", (reference / picture).string(), why, test.string())});
  }
  const bool anyPair =
      std::any_of(result.pairs.begin(), result.pairs.end(), [](const FilePair& p) { return p.missing.empty(); });
  if (!anyPair)
    throw base::fileError(
        reference.string(), "",
        fmt::format("no picture has a counterpart in {}, so there is nothing to compare", test.string()));
  for (const auto& [stem, group] : testGroups)
    for (const fs::path& picture : group)
      result.pairs.push_back({picture.generic_string(),
                              {},
                              test / picture,
                              fmt::format("{}: no counterpart in {}", (test / picture).string(), reference.string())});
  // One name on both sides, both without a counterpart, cannot be: they would be a pair.
  nameByStem(result.pairs);
  return result;
}

// The next path of a line, or nothing at its end or a comment.
std::optional<std::string> nextPath(const std::string& line, std::size_t& at, const std::string& list, int number) {
  while (at < line.size() && std::isspace(static_cast<unsigned char>(line[at]))) ++at;
  if (at == line.size() || line[at] == '#') return {};
  std::string path;
  if (line[at] != '"') {
    while (at < line.size() && !std::isspace(static_cast<unsigned char>(line[at]))) path += line[at++];
    return path;
  }
  for (++at; at < line.size() && line[at] != '"'; ++at) {
    if (line[at] == '\\' && at + 1 < line.size() && (line[at + 1] == '"' || line[at + 1] == '\\')) ++at;
    path += line[at];
  }
  if (at == line.size()) throw base::fileError(list, fmt::format("line {}", number), "a quote is not closed");
  ++at;
  return path;
}

// What tells two pairs apart, without climbing or a root: it may name a file of the output folder.
std::string pairName(const fs::path& reference) {
  fs::path name;
  for (const fs::path& part : reference.lexically_normal().relative_path())
    if (part != "..") name /= part;
  return name.generic_string();
}

void makeUnique(std::vector<FilePair>& pairs) {
  std::set<std::string> taken;
  for (FilePair& pair : pairs) {
    const std::string name = pair.name;
    for (int copy = 2; !taken.insert(pair.name).second; ++copy) pair.name = fmt::format("{} ({})", name, copy);
  }
}

} // namespace

FilePairs findPairs(const fs::path& reference, const fs::path& test) {
  std::error_code error;
  for (const fs::path& path : {reference, test})
    if (!fs::exists(path, error)) throw base::fileError(path.string(), "", "does not exist");
  const bool folders[] = {fs::is_directory(reference, error), fs::is_directory(test, error)};
  if (folders[0] != folders[1])
    throw base::Error(base::ExitCode::usage, test.string(), "",
                      fmt::format("is a {}, but the reference is a {}; give two files or two folders",
                                  folders[1] ? "folder" : "file", folders[0] ? "folder" : "file"));
  if (folders[0]) return matchFolders(reference, test);
  FilePairs result;
  result.pairs = {{pairName(reference.filename()), reference, test, ""}};
  return result;
}

FilePairs readPairList(const fs::path& list) {
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
  constexpr std::string_view kMark = "\xef\xbb\xbf"; // Windows programs begin UTF-8 with it
  const bool isStdin = list == "-";
  const std::string name = isStdin ? "stdin" : list.string();
  const std::string text = isStdin ? base::readStdin(kMaxBytes) : base::readText(list, kMaxBytes);
  std::istringstream lines(text.starts_with(kMark) ? text.substr(kMark.size()) : text);
  FilePairs result;
  result.many = true;
  std::set<std::pair<fs::path, fs::path>> seen;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto refuse = [&](const std::string& reason) {
      throw base::fileError(name, fmt::format("line {}", number), reason);
    };
    std::vector<std::string> paths;
    std::size_t at = 0;
    while (const auto path = nextPath(line, at, name, number)) paths.push_back(*path);
    if (paths.empty()) continue;
    if (paths.size() != 2)
      refuse(fmt::format("has {} path{}, expected two (put \"...\" around a path with spaces)", paths.size(),
                         paths.size() == 1 ? "" : "s"));
    if (paths[0].empty() || paths[1].empty()) refuse("a path is empty");
    const fs::path reference = list.parent_path() / paths[0], test = list.parent_path() / paths[1];
    if (!seen.insert({reference, test}).second) refuse("the list already has this pair");
    FilePair pair{pairName(paths[0]), reference, test, "", list, number};
    for (const fs::path& file : {reference, test}) {
      std::error_code error;
      if (!fs::exists(file, error))
        pair.missing += (pair.missing.empty() ? "" : "; ") + file.string() + ": does not exist";
    }
    result.pairs.push_back(pair);
  }
  if (result.pairs.empty()) throw base::fileError(name, "", "has no pairs");
  makeUnique(result.pairs);
  return result;
}

} // namespace parity::compare

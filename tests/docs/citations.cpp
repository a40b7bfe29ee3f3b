#include "citations.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>

#include "base/file.h"

namespace parity::test {
namespace {

namespace fs = std::filesystem;

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// As GitHub does: lower case, letters and digits, spaces to hyphens. A link counts by its text.
std::string anchorOf(const std::string& heading) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  std::string anchor;
  for (const char c : std::regex_replace(heading, link, "$1"))
    if (isWord(c) || c == '-')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  return anchor;
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  return lines;
}

// What follows a page's name, over the end of a line of comment, too: "8a", "8x9"; empty where it is no number.
std::string placeBehind(std::string_view text) {
  static const std::regex place(R"(^(?: |[ \t]*\n[ \t]*(?://|#|\*)?[ \t]*)([0-9][A-Za-z0-9]*))");
  const std::string near(text.substr(0, 200));
  std::smatch match;
  return std::regex_search(near, match, place) ? match[1].str() : "";
}

// What is wrong with the place in the page; empty: nothing.
std::string faultOf(const Page& page, const std::string& place) {
  static const std::regex form("([0-9]{1,3})([a-z]?)");
  std::smatch match;
  if (!std::regex_match(place, match, form)) return "is cited with '" + place + "', which is no section and item";
  const auto section = page.sections.find(std::stoi(match[1]));
  if (section == page.sections.end()) return "has no section " + match[1].str();
  if (match[2].length() != 0 && !section->second.contains(match[2].str()[0]))
    return "has no item " + match[2].str() + " in section " + match[1].str();
  return "";
}

std::string atLine(std::string_view text, std::size_t at, const std::string& fault) {
  return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + ": " +
         fault;
}

// Names of documents that are not in the repository, as they were cited once. FLIP is also the metric's name, so it
// counts as a file's alone.
std::optional<std::string> oldForm(std::string_view text, std::size_t at, std::string_view word) {
  if (at > 0 && (isWord(text[at - 1]) || text[at - 1] == '-')) return {};
  const std::string_view rest = text.substr(at + word.size());
  const bool isFile = rest.starts_with(".md");
  const bool isPlace = rest.size() > 1 && rest[0] == ' ' && std::isdigit(static_cast<unsigned char>(rest[1]));
  const bool isOwner = rest.starts_with("'s ");
  if (!isFile && (word == "FLIP" || word == "OWN" || (!isPlace && !isOwner))) return {};
  return "'" + std::string(text.substr(at, word.size() + (isFile ? 3 : 2))) + "' is no page of docs";
}

} // namespace

Page parsePage(std::string_view markdown) {
  static const std::regex heading("#{1,6} (.*)"), section(R"(## ([0-9]{1,3})\. .*)"),
      item(R"( *(?:- |\| )?\*\*\(([a-z])\)\*\*.*)");
  Page page;
  std::map<std::string, int> used;
  std::set<char>* items = nullptr;
  bool isCode = false;
  for (const std::string& line : linesOf(markdown)) {
    std::smatch match;
    if (line.starts_with("```")) isCode = !isCode;
    if (isCode) continue;
    if (line.starts_with("#") && std::regex_match(line, match, heading)) {
      const std::string anchor = anchorOf(match[1]);
      const int before = used[anchor]++;
      page.anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
      if (line.starts_with("## ")) items = nullptr;
      if (std::regex_match(line, match, section)) items = &page.sections[std::stoi(match[1])];
    } else if (items && line.find("**(") != std::string::npos && std::regex_match(line, match, item)) {
      items->insert(match[1].str()[0]);
    }
  }
  return page;
}

Citations checkCitations(std::string_view text, const Pages& pages) {
  Citations found;
  static constexpr std::string_view kFolder = "docs/", kEnding = ".md";
  for (std::size_t at = text.find(kFolder); at != text.npos; at = text.find(kFolder, at + 1)) {
    std::size_t end = at + kFolder.size();
    while (end < text.size() && (isWord(text[end]) || text[end] == '-')) ++end;
    if (!text.substr(end).starts_with(kEnding)) continue;
    const std::string name(text.substr(at, end + kEnding.size() - at));
    ++found.count;
    const auto page = pages.find(name);
    if (page == pages.end()) {
      found.faults.push_back(atLine(text, at, name + " does not exist"));
      continue;
    }
    const std::string place = placeBehind(text.substr(end + kEnding.size()));
    if (place.empty()) continue;
    ++found.sections;
    if (const std::string fault = faultOf(page->second, place); !fault.empty())
      found.faults.push_back(atLine(text, at, name + " " + fault));
  }
  for (const std::string_view word : {"DESIGN", "SHADING", "FLIP", "STYLE", "NIGHTLY", "INSIGHT", "OWN"})
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
      if (const auto fault = oldForm(text, at, word)) found.faults.push_back(atLine(text, at, *fault));
  return found;
}

Pages loadPages(const fs::path& root) {
  Pages pages;
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md")
      pages["docs/" + entry.path().filename().string()] = parsePage(base::readText(entry.path()));
  return pages;
}

std::vector<fs::path> listSources(const fs::path& root) {
  static const std::set<std::string> kEndings = {"",     ".cpp",  ".h",  ".glsl", ".comp",  ".vert", ".frag",
                                                 ".inc", ".in",   ".md", ".txt",  ".cmake", ".ts",   ".mjs",
                                                 ".css", ".html", ".py", ".sh",   ".toml",  ".yml",  ".yaml"};
  std::vector<fs::path> sources;
  for (auto entry = fs::recursive_directory_iterator(root); const auto& each : entry) {
    const std::string name = each.path().filename().string();
    if (each.is_directory()) {
      const bool isHidden = name.starts_with(".") && name != ".github" && name != ".ci";
      if (isHidden || name == "node_modules" || name == "corpus" || name == "out" ||
          fs::exists(each.path() / "CMakeCache.txt"))
        entry.disable_recursion_pending();
    } else if (each.is_regular_file() && kEndings.contains(each.path().extension().string()) &&
               !name.starts_with(".git"))
      sources.push_back(fs::relative(each.path(), root));
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

} // namespace parity::test

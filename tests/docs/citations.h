// Citations of the documentation in the sources, and what they resolve to.
//
// A citation is the path of a page, the number of a section and the letter of an item in it, of which the last two may
// be missing: "docs/NAME.md 8a". A section is a heading "## 8. Title"; an item begins a paragraph, a list item or a row
// of a table with its letter, bold and in brackets.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace parity::test {

// What can be cited of one page.
struct Page {
  std::map<int, std::set<char>> sections; // their items
  std::set<std::string> anchors;          // of all headings, as GitHub makes them
};
Page parsePage(std::string_view markdown);

using Pages = std::map<std::string, Page>; // by "docs/NAME.md"

// Of one text: how many citations there are, and what is wrong, a line each, with its line number.
struct Citations {
  int count = 0;                   // of pages
  int sections = 0;                // of these, how many name a section
  std::vector<std::string> faults; // "12: docs/NAME.md has no section 8", or one of the forms that no longer resolve
};
Citations checkCitations(std::string_view text, const Pages& pages);

// All pages of the folder docs below `root`.
Pages loadPages(const std::filesystem::path& root);

// The source files below `root` that people write, relative to it, sorted: no builds, packages or data.
std::vector<std::filesystem::path> listSources(const std::filesystem::path& root);

} // namespace parity::test

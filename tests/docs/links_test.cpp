// Links between the pages of the repository lead somewhere, and the index and its picture leave nothing out.
#include <regex>

#include <gtest/gtest.h>

#include "base/file.h"
#include "citations.h"

namespace parity::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PARITY_SOURCE_DIR;

// What is wrong with the links of a page, a line each.
std::vector<std::string> faultsOf(const fs::path& page, const std::string& text) {
  static const std::regex link(R"(\]\(([^)\s]+)\))"), code("`[^`\n]*`");
  const std::string prose = std::regex_replace(text, code, "");
  std::vector<std::string> faults;
  for (std::sregex_iterator match(prose.begin(), prose.end(), link), end; match != end; ++match) {
    const std::string target = (*match)[1];
    if (target.starts_with("http://") || target.starts_with("https://")) continue;
    const std::size_t hash = target.find('#');
    const std::string file = target.substr(0, hash);
    const fs::path path = file.empty() ? page : page.parent_path() / file;
    if (!fs::exists(path))
      faults.push_back(target + ": there is no such file");
    else if (hash != target.npos &&
             !parsePage(file.empty() ? text : base::readText(path)).anchors.contains(target.substr(hash + 1)))
      faults.push_back(target + ": there is no such heading");
  }
  return faults;
}

TEST(Links, ThatLeadNowhereAreFound) {
  const std::string text = "# Two words\n[a](#two-words) [b](#three) [c](../README.md) [d](none.md) `[e](f)`\n"
                           "[f](design.md#no-heading) [g](https://example.org/none)";
  EXPECT_EQ(faultsOf(kRoot / "docs/README.md", text),
            (std::vector<std::string>{"#three: there is no such heading", "none.md: there is no such file",
                                      "design.md#no-heading: there is no such heading"}));
}

TEST(Links, OfEveryPageLeadToFilesAndHeadings) {
  int pages = 0;
  for (const fs::path& file : listSources(kRoot)) {
    if (file.extension() != ".md") continue;
    ++pages;
    for (const std::string& fault : faultsOf(kRoot / file, base::readText(kRoot / file)))
      ADD_FAILURE() << file.string() << ": " << fault;
  }
  EXPECT_GT(pages, 25);
}

TEST(Index, NamesEveryPage) {
  const std::string index = base::readText(kRoot / "docs/README.md");
  for (const auto& [name, page] : loadPages(kRoot)) {
    const std::string file = name.substr(std::string("docs/").size());
    if (file == "README.md") continue;
    EXPECT_NE(index.find("](" + file + ")"), std::string::npos) << file;
  }
}

// The folders that CMakeLists.txt adds, in the picture of the house.
TEST(Index, DrawsEveryFolder) {
  const std::string cmake = base::readText(kRoot / "CMakeLists.txt"),
                    picture = base::readText(kRoot / "docs/house.svg");
  const std::size_t order = cmake.rfind("foreach(folder IN ITEMS ");
  ASSERT_NE(order, std::string::npos);
  std::istringstream folders(cmake.substr(order + 24, cmake.find(')', order) - order - 24));
  int count = 0;
  for (std::string folder; folders >> folder; ++count)
    EXPECT_NE(picture.find(">" + folder.substr(0, folder.find('/')) + "<"), std::string::npos) << folder;
  EXPECT_GT(count, 10);
}

} // namespace
} // namespace parity::test

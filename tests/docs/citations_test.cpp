// Every page, section and item of the documentation that a source cites is there.
#include "citations.h"

#include <gtest/gtest.h>

#include "base/file.h"

namespace parity::test {
namespace {

const Pages kPages = {{"docs/house.md", parsePage("# The house\n\n"
                                                  "## 1. Rooms\n\n- **(a)** one\n  **(b)** another\n\n"
                                                  "## 2. Doors\n\n| **(a)** | wide |\n\n```\n## 3. no heading\n```\n\n"
                                                  "## Without a number\n\n- **(c)** no item\n")}};

std::vector<std::string> faultsOf(std::string_view text) { return checkCitations(text, kPages).faults; }
using Faults = std::vector<std::string>;

TEST(Citations, ResolveToPagesSectionsAndItems) {
  const Citations found =
      checkCitations("// docs/house.md, docs/house.md 1, (docs/house.md 1b) docs/house.md 2a's doors: see\n"
                     "// docs/house.md\n"
                     "// 2a. [docs/house.md 2](house.md#2-doors)",
                     kPages);
  EXPECT_EQ(found.faults, Faults{});
  EXPECT_EQ(found.count, 6);
  EXPECT_EQ(found.sections, 5);
}

TEST(Citations, OfWhatIsNotThereAreNamedWithTheirLine) {
  EXPECT_EQ(faultsOf("\n docs/garden.md 1"), Faults{"2: docs/garden.md does not exist"});
  EXPECT_EQ(faultsOf("docs/house.md 4"), Faults{"1: docs/house.md has no section 4"});
  EXPECT_EQ(faultsOf("docs/house.md 3"), Faults{"1: docs/house.md has no section 3"}) << "a heading within code";
  EXPECT_EQ(faultsOf("docs/house.md 2b"), Faults{"1: docs/house.md has no item b in section 2"});
  EXPECT_EQ(faultsOf("docs/house.md 2c"), Faults{"1: docs/house.md has no item c in section 2"})
      << "of another section";
  EXPECT_EQ(faultsOf("docs/house.md\n  // 7 rooms"), Faults{"1: docs/house.md has no section 7"});
  EXPECT_EQ(faultsOf("docs/house.md 1ab"),
            Faults{"1: docs/house.md is cited with '1ab', which is no section and item"});
}

// Written in two parts, so that this file is not refused.
TEST(Citations, OfDocumentsThatAreNotInTheRepositoryAreRefused) {
  for (const std::string old : {"DESIGN"
                                " 8",
                                "SHADING"
                                " 2 (a)",
                                "SHADING"
                                "'s closed form",
                                "SHADING"
                                ".md",
                                "FLIP"
                                ".md, faults",
                                "STYLE"
                                ".md"})
    EXPECT_EQ(faultsOf("see " + old).size(), 1u) << old;
  for (const char* other : {"FLIP 0.031", "PARITY_SHADING_REAL", "STYLE_TEXT 1", "-D STYLE=a.css", "FLIP's filters"})
    EXPECT_EQ(faultsOf(other), Faults{}) << other;
}

TEST(Citations, OfTheSourcesResolve) {
  const Pages pages = loadPages(PARITY_SOURCE_DIR);
  int count = 0, sections = 0;
  for (const std::filesystem::path& file : listSources(PARITY_SOURCE_DIR)) {
    if (file == "tests/docs/citations_test.cpp" || file == "tests/docs/citations.h") continue; // of pages made up
    const Citations found = checkCitations(base::readText(std::filesystem::path(PARITY_SOURCE_DIR) / file), pages);
    for (const std::string& fault : found.faults) ADD_FAILURE() << file.string() << ":" << fault;
    count += found.count;
    sections += found.sections;
  }
  RecordProperty("citations", count);
  std::printf("%d citations, %d of a section\n", count, sections);
  EXPECT_GT(sections, 100) << "nothing is searched";
}

} // namespace
} // namespace parity::test

// Which path is meant is said by paths::Path, not by its name: the folders that work on any path name none, but for
// defaults and a few words for people.
#include <filesystem>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

namespace parity::job {
namespace {

constexpr const char* kFolders[] = {"job", "compare", "report", "study", "cli"};
constexpr std::size_t kMostLines = 15;

// The tables of what stress tries are about formulas, whose names they hold: mobileShadow, MobileMaterial. A study of
// presets is one of a path's own functions.
bool isCounted(const std::filesystem::path& file) {
  static const std::regex formulas("(study/stress/(function_)?table|study/preset/).*");
  return (file.extension() == ".cpp" || file.extension() == ".h") &&
         !std::regex_match(file.generic_string(), formulas) && !file.generic_string().starts_with("report/dashboard/");
}

// Lines that hold "highend", "high-end" or "mobile" in any case before a comment begins; texts count as code does.
std::vector<std::string> namingLines(const std::filesystem::path& root) {
  static const std::regex name("high-?end|mobile", std::regex::icase);
  std::vector<std::string> lines;
  for (const char* folder : kFolders)
    for (auto entry = std::filesystem::recursive_directory_iterator(root / folder); const auto& each : entry) {
      if (each.path().filename() == "node_modules") entry.disable_recursion_pending();
      const std::filesystem::path file = std::filesystem::relative(each.path(), root);
      if (!isCounted(file)) continue;
      std::ifstream stream(each.path());
      std::size_t number = 1;
      for (std::string line; std::getline(stream, line); ++number)
        if (const std::string code = line.substr(0, line.find("//")); std::regex_search(code, name))
          lines.push_back(file.string() + ":" + std::to_string(number) + ": " + code);
    }
  return lines;
}

TEST(PathNames, StandInFewLinesOfWhatWorksOnAnyPath) {
  const std::vector<std::string> lines = namingLines(PARITY_SOURCE_DIR);
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  EXPECT_LE(lines.size(), kMostLines) << "go by paths::Path (name(), title(), its place in the list):\n" << all;
  EXPECT_GT(lines.size(), 2u) << "job/paths.cpp names both: nothing is searched";
}

} // namespace
} // namespace parity::job

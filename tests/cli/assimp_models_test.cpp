// Debian's assimp-testmodels: real exports and broken files. Each loads or is refused with a reason, in bounded time
// and memory; what comes of each is frozen in assimp_models.txt, so that no change goes unnoticed.
#include <fstream>

#include <fmt/format.h>

#include "cli/checks.h"

namespace parity::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models"; // where the package puts them

std::vector<std::string> listGltf() {
  std::vector<std::string> files;
  for (const std::string& file : listFiles(kModels))
    if (file.ends_with(".gltf") || file.ends_with(".glb")) files.push_back(file);
  return files;
}

// "loads: ..." or "refused: ..." with the first problem.
std::string outcomeOf(const std::string& file, const RunResult& result) {
  if (result.exitCode == 0) {
    const nlohmann::json info = nlohmann::json::parse(result.out);
    const std::size_t warnings = info["warnings"].size();
    return fmt::format("loads: {} triangles{}", info["triangles"].get<std::size_t>(),
                       warnings ? fmt::format(", warnings: {}", warnings) : "");
  }
  const std::vector<std::string> lines = linesOf(result.err);
  std::string reason = lines.empty() ? "without a word" : lines.front();
  if (const std::string head = "error: " + file + ": "; reason.starts_with(head)) reason.erase(0, head.size());
  return fmt::format("refused: {}{}", reason, lines.size() > 1 ? fmt::format(" (and {} more)", lines.size() - 1) : "");
}

TEST(AssimpModels, EachLoadsOrIsRefusedWithAReason) {
  if (!fs::exists(kModels)) GTEST_SKIP() << "assimp-testmodels is not installed";
  std::size_t loaded = 0, refused = 0;
  std::string table;
  for (const std::string& file : listGltf()) {
    // The folder is the working one, so that no line holds its place.
    RunOptions options;
    options.workingFolder = kModels;
    options.timeoutS = 10;
    const RunResult result = runParity({"info", file, "--json", "-"}, options);
    EXPECT_FALSE(result.timedOut) << file << " hangs";
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 4)
        << file << ": exit " << result.exitCode << ", signal " << result.signal << "\n"
        << result.err;
    EXPECT_LT(result.peakMiB, 2048) << file;
    if (result.exitCode == 4) {
      for (const std::string& line : linesOf(result.err))
        EXPECT_TRUE(line.starts_with("error: " + file + ": ")) << line;
      EXPECT_TRUE(result.out.empty()) << file;
    }
    ++(result.exitCode == 0 ? loaded : refused);
    table += file + " | " + outcomeOf(file, result) + "\n";
  }
  fmt::print("{} files: {} load, {} are refused\n", loaded + refused, loaded, refused);
  EXPECT_GT(loaded, 0u);
  EXPECT_GT(refused, 0u);

  const fs::path known = fs::path(PARITY_SOURCE_DIR) / "tests/cli/assimp_models.txt";
  if (table != readWholeFile(known)) {
    const fs::path actual = fs::path(PARITY_BINARY_DIR) / "assimp_models-actual.txt";
    std::ofstream(actual, std::ios::binary) << table;
    ADD_FAILURE() << "the outcomes differ; if each is right: cp " << actual.string() << " " << known.string();
    EXPECT_EQ(linesOf(table), linesOf(readWholeFile(known)));
  }
}

} // namespace
} // namespace parity::tests

#include "cli/checks.h"

#include <algorithm>
#include <fstream>
#include <set>

#include "base/image/image_io.h"

namespace parity::tests {

std::string missingDriver() {
  // Every test that renders asks. A driver that was seen once in this build folder is taken to be there still.
  const std::filesystem::path seen = std::filesystem::path(PARITY_BINARY_DIR) / "test-caches" / "driver-was-seen";
  if (std::filesystem::exists(seen)) return "";
  const RunResult devices = runParity({"devices"});
  if (devices.exitCode == 0) {
    std::filesystem::create_directories(seen.parent_path());
    writeFile(seen, std::string());
  }
  // Only the message of a missing driver counts: any other failure is for the tests to find.
  return devices.exitCode == 4 && contains(devices.err, "mesa-vulkan-drivers") ? devices.err : "";
}

void RenderingTest::SetUp() {
  if (const std::string missing = missingDriver(); !missing.empty()) GTEST_SKIP() << missing;
}

base::Image RenderingTest::render(const std::string& scene, const std::string& by, const std::vector<std::string>& more,
                                  const std::string& file) const {
  const RunResult result = runParity(join({{"render", scene, "--path", by, "-o", path(file), "--validation"}, more}));
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_EQ(result.out, "");
  m_err = result.err;
  return base::readImage(m_folder / file);
}

testing::AssertionResult exitedWith(int code, const RunResult& result) {
  if (result.exitCode == code && !result.timedOut) return testing::AssertionSuccess();
  auto failure = testing::AssertionFailure() << "parity" << result.commandLine << "\n  ";
  if (result.timedOut)
    failure << "did not end in time";
  else if (result.signal)
    failure << "died of signal " << result.signal;
  else
    failure << "exit code " << result.exitCode << " instead of " << code;
  return failure << "\nstdout: " << result.out << "\nstderr: " << result.err;
}

bool isReported(const RunResult& result) {
  return result.exitCode == 0 || result.exitCode == 2 ||
         (result.exitCode == 4 && contains(result.err, "error: no material was compared"));
}

void expectRefused(const RunResult& result, int code, const std::vector<std::string>& parts) {
  EXPECT_TRUE(exitedWith(code, result));
  EXPECT_EQ(result.out, "") << result.commandLine;
  const std::vector<std::string> lines = linesOf(result.err);
  EXPECT_EQ(lines.size(), 1u) << result.commandLine << "\n" << result.err;
  EXPECT_TRUE(result.err.starts_with("error: ")) << result.err;
  for (const std::string& part : parts) EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
  EXPECT_LT(result.peakMiB, 2048) << result.commandLine;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string readWholeFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream) << file;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

nlohmann::json readReport(const std::filesystem::path& folder) {
  nlohmann::json report = nlohmann::json::parse(readWholeFile(folder / "report.json"), nullptr, false);
  EXPECT_FALSE(report.is_discarded()) << "report.json is not JSON";
  return report.is_discarded() ? nlohmann::json() : report;
}

std::vector<std::string> listFiles(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(folder).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> listPictures(const nlohmann::json& report) {
  std::set<std::string> pictures;
  const auto addAll = [&](const nlohmann::json& images) {
    for (const char* key : {"reference", "test", "flip"})
      if (images[key] != "") pictures.insert(images[key].get<std::string>());
  };
  for (const nlohmann::json& scene : report["scenes"]) {
    for (const nlohmann::json& view : scene["views"]) {
      addAll(view["images"]);
      for (const nlohmann::json& material : view["materials"]) addAll(material["crops"]);
    }
    for (const nlohmann::json& material : scene.value("materials", nlohmann::json::array()))
      for (const nlohmann::json& input : material["inputs"])
        if (input.contains("texture")) pictures.insert(input["texture"]["picture"].get<std::string>());
  }
  pictures.erase("");
  return {pictures.begin(), pictures.end()};
}

std::vector<std::string> listPixelFiles(const nlohmann::json& report) {
  std::set<std::string> files = {report["displayTable"].get<std::string>()};
  for (const nlohmann::json& scene : report["scenes"])
    for (const nlohmann::json& view : scene["views"])
      for (const nlohmann::json& file : view["pixels"]) files.insert(file.get<std::string>());
  files.erase("");
  return {files.begin(), files.end()};
}

std::vector<std::string> reportFiles(std::size_t scenes) {
  if (!kHasPage) return {"junit.xml", "report.json", "run.json"};
  std::vector<std::string> files = {"dashboard.css", "dashboard.js", "index.html",
                                    "junit.xml",     "report.json",  "run.json"};
  for (std::size_t i = 0; i < scenes; ++i) files.push_back("scenes/" + std::to_string(i) + ".js");
  std::sort(files.begin(), files.end());
  return files;
}

std::string writeBudgets(const TempFolder& folder, const std::string& limits) {
  const std::filesystem::path file = folder / "budgets.toml";
  const std::string check = "checks = [{ metric = \"flip.mean\", " + limits + " }]\n";
  writeFile(file, "[[material]]\nname = \"*\"\nmin_pixels = 1\n" + check + "[[whole]]\n" + check);
  return file.string();
}

} // namespace parity::tests

#include "cli/nightly/night.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>

namespace parity::tests {

void NightTest::writeScenes(int count) const {
  for (int i = 0; i < count; ++i) {
    GltfFile file = makeQuad();
    const double t = static_cast<double>(i) / 24;
    file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.2 + 0.7 * t, 0.5, 0.9 - 0.7 * t, 1};
    file.material()["pbrMetallicRoughness"]["roughnessFactor"] = 0.15 + 0.03 * (i % 24);
    file.material()["pbrMetallicRoughness"]["metallicFactor"] = i % 2;
    writeEmbedded(m_folder, std::move(file), fmt::format("{:02}", i));
    std::filesystem::rename(m_folder / fmt::format("{:02}-embedded.gltf", i), m_folder / fmt::format("{:02}.gltf", i));
  }
  write("night.toml", "name = \"night\"\n[defaults]\nsun = [60, 60, 4]\n[[scene]]\nfiles = [\"*.gltf\"]\n");
}

std::vector<std::string> NightTest::options() const {
  return {"--suite", path("night.toml"), "--size", "32x32", "--validation"};
}

Files NightTest::filesOf(const std::filesystem::path& folder) {
  Files files;
  for (const std::string& file : listFiles(folder))
    if (file != "run.json" && file != "junit.xml" && file != "index.html") files[file] = readWholeFile(folder / file);
  return files;
}

Files NightTest::reportHere() const {
  const RunResult run = runParity(join({{"report", "-o", path("plain")}, options()}));
  EXPECT_TRUE(isReported(run)) << run.err;
  return reportIn("plain");
}

RunResult NightTest::plan(int shards, const std::vector<std::string>& more) const {
  std::filesystem::remove_all(m_folder / "night");
  RunResult run = runParity(join({{"plan", "-o", path("night"), "--shards", std::to_string(shards)}, options(), more}));
  EXPECT_TRUE(exitedWith(0, run));
  return run;
}

RunResult NightTest::work(const std::vector<std::string>& more, const RunOptions& options) const {
  RunOptions patient = options;
  patient.timeoutS = 220;
  return runParity(join({{"work", path("night")}, more}), patient);
}

RunResult NightTest::merge(const std::string& to, const std::vector<std::string>& more,
                           const RunOptions& options) const {
  return runParity(join({{"merge", path("night"), "-o", path(to)}, more}), options);
}

void NightTest::expectMerged(const Files& expected, const std::string& to) const {
  EXPECT_TRUE(isReported(merge(to)));
  EXPECT_TRUE(sameFiles(reportIn(to), expected));
}

RunOptions NightTest::failing(const std::string& faults, bool once) const {
  RunOptions options;
  options.environment = {
      {"LD_PRELOAD", PARITY_FAULTS_LIBRARY}, {"PARITY_FAULTS", faults}, {"PARITY_FAULTS_LOG", path("begun.txt")}};
  if (once) {
    std::filesystem::create_directories(m_folder / "faults");
    options.environment.emplace_back("PARITY_FAULTS_ONCE", path("faults"));
  }
  return options;
}

std::vector<std::string> NightTest::begun() const {
  const std::vector<std::string> lines = linesOf(readWholeFile(m_folder / "begun.txt"));
  const std::set<std::string> once(lines.begin(), lines.end());
  return {once.begin(), once.end()};
}

std::vector<std::string> NightTest::units() const {
  std::vector<std::string> names;
  for (const std::string& file : listFiles(m_folder / "night"))
    if (file.starts_with("units/") && file.ends_with(".unit") && !contains(file, "/.")) names.push_back(file);
  return names;
}

testing::AssertionResult sameFiles(const Files& files, const Files& expected) {
  std::vector<std::string> differ;
  for (const auto& [file, content] : expected)
    if (const auto found = files.find(file); found == files.end())
      differ.push_back(file + " is missing");
    else if (found->second != content)
      differ.push_back(file + " differs");
  for (const auto& [file, content] : files)
    if (!expected.contains(file)) differ.push_back(file + " is not expected");
  if (differ.empty() && !expected.empty()) return testing::AssertionSuccess();
  auto failure = testing::AssertionFailure() << differ.size() << " of " << expected.size() << " files";
  for (std::size_t i = 0; i < std::min<std::size_t>(differ.size(), 5); ++i) failure << "\n  " << differ[i];
  return failure;
}

} // namespace parity::tests

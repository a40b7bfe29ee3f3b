// Workers, supervisors and the disk fail at random; the work goes on until it is done, and gives the same bytes.
#include <algorithm>
#include <cstdlib>
#include <random>

#include <fmt/format.h>

#include "cli/nightly/night.h"

namespace parity::tests {
namespace {

// PARITY_CHAOS_ROUNDS, for a longer run.
int rounds() {
  const char* asked = std::getenv("PARITY_CHAOS_ROUNDS");
  return asked ? std::atoi(asked) : 5;
}

std::vector<std::string> listFolders(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

class ChaosTest : public NightTest {};

TEST_F(ChaosTest, WhateverFailsTheWorkEndsWithTheSameBytes) {
  constexpr int kScenes = 10, kJobs = 2;
  writeScenes(kScenes);
  const Files expected = reportHere();
  for (int round = 0; round < rounds(); ++round) {
    std::mt19937 random(static_cast<unsigned>(round));
    // No scene twice: a scene that fails twice in one run is an error of the report, and should be.
    std::vector<int> scenes(kScenes);
    for (int i = 0; i < kScenes; ++i) scenes[static_cast<std::size_t>(i)] = i;
    std::shuffle(scenes.begin(), scenes.end(), random);
    std::vector<std::string> kinds = {"segv", "kill", "parent", round % 2 == 0 ? "stop" : "abort"};
    std::string faults = round % 3 == 0 ? "full units;full pictures" : "";
    for (std::size_t i = 0; i < kinds.size(); ++i) // as the scene is read, or as its unit is written
      faults += random() % 2 ? fmt::format(";{} {:02}.gltf", kinds[i], scenes[i])
                             : fmt::format(";{} .{:06}.*.unit", kinds[i], scenes[i]);
    if (faults.starts_with(';')) faults.erase(0, 1);
    std::filesystem::remove_all(m_folder / "faults");
    std::filesystem::remove(m_folder / "begun.txt");
    plan(1);
    const RunOptions failed = failing(faults, true);
    int ends = 0;
    for (RunResult run; run.exitCode != 0; ++ends) {
      ASSERT_LT(ends, 5) << faults << "\n" << run.err;
      run = work({"--jobs", std::to_string(kJobs), "--timeout", "15s"}, failed);
      EXPECT_TRUE(run.exitCode == 0 || run.exitCode == 75 || run.signal == SIGKILL) << faults << "\n" << run.err;
    }
    EXPECT_GE(ends, 2) << "the supervisor was killed once";
    EXPECT_EQ(listFolders(m_folder / "faults").size(), 1 + std::ranges::count(faults, ';'))
        << "each happened: " << faults;
    EXPECT_LE(begun().size(), kScenes + kinds.size() - 1 + static_cast<std::size_t>(kJobs * (ends - 1)))
        << "no more is done again than what ran when something was killed: " << faults;
    EXPECT_TRUE(isReported(merge(fmt::format("merged-{}", round))));
    EXPECT_TRUE(sameFiles(reportIn(fmt::format("merged-{}", round)), expected)) << faults;
  }
}

} // namespace
} // namespace parity::tests

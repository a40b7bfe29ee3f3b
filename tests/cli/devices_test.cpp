// Devices: which there are, which is taken and why; and what is said where there is none.
#include <set>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class DevicesTest : public RenderingTest {};

TEST_F(DevicesTest, AreListedWithReasons) {
  const RunResult result = runParity({"devices", "--json", "-"});
  ASSERT_TRUE(exitedWith(0, result));
  const nlohmann::json devices = nlohmann::json::parse(result.out);
  int taken = 0;
  for (const nlohmann::json& device : devices) {
    taken += device["taken"].get<bool>();
    EXPECT_NE(device["reason"], "") << device;
  }
  EXPECT_EQ(taken, 1) << devices;
}

// The id of the device that is taken; the same with and without what the cache holds, and in a plan.
TEST_F(DevicesTest, TheOneThatIsTakenHasANumericsId) {
  RunOptions alone;
  alone.environment = {{"XDG_CACHE_HOME", path("cache")}};
  std::set<std::string> ids;
  for (int i = 0; i < 2; ++i) // measured, then from the cache
    for (const nlohmann::json& device : nlohmann::json::parse(runParity({"devices", "--json", "-"}, alone).out)) {
      EXPECT_EQ(device.contains("numerics"), device["taken"].get<bool>());
      if (device["taken"]) ids.insert(device["numerics"].get<std::string>());
    }
  ASSERT_EQ(ids.size(), 1u);
  const std::string id = *ids.begin();
  EXPECT_EQ(id.size(), 32u);
  EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos) << id;
  EXPECT_TRUE(contains(runParity({"devices"}, alone).out, "numerics id " + id + "\n"));
  ASSERT_TRUE(exitedWith(0, runParity({"plan", "builtin:furnace", "--no-cache", "-o", path("night")})));
  EXPECT_EQ(nlohmann::json::parse(readWholeFile(m_folder / "night" / "plan.json"))["numerics"], id);
}

TEST_F(DevicesTest, SoftwareDeviceIsTheDefault) {
  const RunResult result = runParity({"devices"});
  ASSERT_TRUE(exitedWith(0, result));
  if (!contains(result.out, "llvmpipe")) GTEST_SKIP() << "no lavapipe here:\n" << result.out;
  bool found = false;
  for (const std::string& line : linesOf(result.out)) found |= line.starts_with("* ") && contains(line, "llvmpipe");
  EXPECT_TRUE(found) << result.out;
  EXPECT_TRUE(contains(result.out, "used: the software device is the default")) << result.out;
  EXPECT_TRUE(exitedWith(0, runParity({"devices", "--device", "LLVMpipe"})));
  EXPECT_TRUE(exitedWith(0, runParity({"devices", "--device", "0"})));
}

TEST_F(DevicesTest, UnknownNameIsRefusedWithTheDevicesThereAre) {
  const std::filesystem::path folder = m_folder / "out";
  const std::string first = nlohmann::json::parse(runParity({"devices", "--json", "-"}).out)[0]["name"];
  expectRefused(runParity({"report", "builtin:furnace", "--device", "voodoo", "-o", folder.string()}), 4,
                {"'voodoo'", first});
  EXPECT_FALSE(std::filesystem::exists(folder));
  expectRefused(runParity({"diff", "builtin:furnace", "--device", "99"}), 4, {"'99'", first});
  expectRefused(
      runParity({"bake", "builtin:room", "--device", "voodoo", "-o", folder.string(), "--cache", path("cache")}), 4,
      {"'voodoo'", first});
  EXPECT_EQ(listFiles(m_folder / "cache"), std::vector<std::string>()) << "no light was baked before";

  const RunResult listed = runParity({"devices", "--device", "voodoo"});
  EXPECT_TRUE(exitedWith(4, listed));
  EXPECT_TRUE(contains(listed.out, first)) << listed.out;
  EXPECT_EQ(linesOf(listed.err).size(), 1u) << listed.err;
  EXPECT_TRUE(contains(listed.err, "voodoo")) << listed.err;
}

TEST(MissingDriver, IsAnErrorThatNamesThePackage) {
  const TempFolder folder;
  RunOptions options;
  for (const char* variable : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES", "VK_ADD_DRIVER_FILES"})
    options.environment.emplace_back(variable, "/nonexistent.json");
  const std::vector<std::string> parts = {"no driver", "mesa-vulkan-drivers"};
  expectRefused(runParity({"devices"}, options), 4, parts);
  expectRefused(runParity({"diff", "builtin:furnace"}, options), 4, parts);
  expectRefused(runParity({"report", "builtin:furnace", "-o", (folder / "out").string()}, options), 4, parts);
  expectRefused(
      runParity({"render", "builtin:furnace", "--path", "mobile", "-o", (folder / "out.exr").string()}, options), 4,
      parts);
  EXPECT_EQ(listFiles(folder.path()), std::vector<std::string>());
}

} // namespace
} // namespace parity::tests

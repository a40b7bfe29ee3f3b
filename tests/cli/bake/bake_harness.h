// Small bakes by the real program, and scenes for them.
#pragma once

#include <glm/glm.hpp>

#include "cli/checks.h"

namespace parity::tests {

// Few texels and samples; no capture, so that no device is needed.
inline const std::vector<std::string> kQuickBake = {"--texels-per-metre", "4",   "--error",    "20%",
                                                    "--max-samples",      "512", "--captures", "0"};
// With one.
inline const std::vector<std::string> kCapturedBake = {
    "--texels-per-metre", "4", "--error", "20%", "--max-samples", "512", "--captures", "1", "--capture-size", "32"};

// A point light of KHR_lights_punctual at this place.
void addLamp(GltfFile& file, const glm::vec3& at, const std::string& kind = R"({"type": "point", "intensity": 20})");

// A floor, 2 m wide, in y = 0 and a wall of the same size behind it, by two materials.
GltfFile makeCorner();
// With a lamp before them.
GltfFile makeLitCorner();

// Content by name relative to the folder.
using FolderContent = std::map<std::string, std::string>;
FolderContent readFolder(const std::filesystem::path& folder);

// Bakes into folders below one of its own, with a cache of its own.
class BakeTest : public FolderTest {
protected:
  RunResult run(const std::vector<std::string>& words, const RunOptions& options = {}) const {
    return runParity(join({words, {"--cache", path("cache")}}), options);
  }
  // kQuickBake goes before `options`, which therefore may give none of its options again.
  RunResult tryBake(const std::vector<std::string>& scenes, const std::string& folder,
                    const std::vector<std::string>& options = {}) const {
    return run(join({{"bake"}, scenes, {"-o", path(folder)}, kQuickBake, options}));
  }
  // Expects success; the folder comes back.
  std::string bake(const std::vector<std::string>& scenes, const std::string& folder,
                   const std::vector<std::string>& options = {}) const {
    const RunResult result = tryBake(scenes, folder, options);
    EXPECT_TRUE(exitedWith(0, result));
    return path(folder);
  }
  // Names directly in the test's folder.
  std::vector<std::string> entries() const;
};

// Those that render.
class BakedRenderTest : public BakeTest {
protected:
  void SetUp() override;
};

} // namespace parity::tests

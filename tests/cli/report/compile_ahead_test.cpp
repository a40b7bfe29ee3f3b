// While an environment is prepared, shaders are compiled by another in its place: the same ones that are needed then.
#include <set>
#include <thread>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

class CompileAheadTest : public RenderingTest {
protected:
  struct Run {
    std::string err, report;
    std::set<std::string> shaders; // that the driver has compiled: its cache's files
  };
  Run reportOf(const std::string& scene, const std::string& name, const std::vector<std::string>& more) const {
    const std::filesystem::path shaders = m_folder / (name + " shaders"), out = m_folder / name;
    RunOptions options;
    options.environment = {{"MESA_SHADER_CACHE_DIR", shaders.string()}, {"MESA_SHADER_CACHE_DISABLE", "false"}};
    const RunResult result = runParity(join({{"report", scene, "--env", "builtin:studio", "--no-cache", "--timings",
                                              "--attribution", "over-budget", "-o", out.string()},
                                             kSmall,
                                             kRoughSky,
                                             more}),
                                       options);
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    Run run{.err = result.err, .report = readWholeFile(out / "report.json"), .shaders = {}};
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shaders))
      if (entry.is_regular_file() && entry.path().filename() != "index")
        run.shaders.insert(entry.path().filename().string());
    return run;
  }
};

// Glass before a textured wall: both are planned together, also for what-ifs, which are not compiled ahead. One thread
// prepares first, and compiles then.
TEST_F(CompileAheadTest, CompilesWhatIsNeededAndNothingElse) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core prepares first";
  base::writeImage8(m_folder / "texture.png", base::Image8(8, 8, 3, 120));
  GltfFile file = makeQuad();
  file.json["images"] = {{{"uri", "texture.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  file.json["materials"].push_back(
      {{"name", "glass"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}}});
  file.json["extensionsUsed"] = {"KHR_materials_transmission"};
  file.json["meshes"].push_back(file.json["meshes"][0]);
  file.json["meshes"][1]["primitives"][0]["material"] = 1;
  file.json["nodes"].push_back({{"mesh", 1}, {"translation", {0.25, 0.25, 0.2}}, {"scale", {0.5, 0.5, 0.5}}});
  file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
  const std::string glass = writeEmbedded(m_folder, std::move(file), "glass");
  const std::vector<std::string> whatIf = {"--orbit", "0,80,2", "--what-if", "refit"};
  const Run ahead = reportOf(glass, "ahead", whatIf),
            after = reportOf(glass, "after", join({whatIf, {"--threads", "1"}}));
  for (const char* stage : {"compile ahead", "device: compile highend", "device: compile mobile"})
    EXPECT_TRUE(contains(ahead.err, stage)) << stage << "\n" << ahead.err;
  EXPECT_FALSE(contains(after.err, "compile ahead")) << after.err;
  EXPECT_GE(after.shaders.size(), 4u) << "two of the surfaces, one of each path, at least";
  EXPECT_EQ(ahead.shaders, after.shaders);
  EXPECT_EQ(ahead.report, after.report);
}

} // namespace
} // namespace parity::tests

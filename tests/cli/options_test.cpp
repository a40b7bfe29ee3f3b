// Every option that `parity render` lists is read by it: another value makes another picture.
#include <algorithm>
#include <map>
#include <regex>

#include "base/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

// Another value of an option, and what is needed so that it can be seen.
struct Probe {
  std::vector<std::string> words; // the option, its value
  std::string scene = "spheres", path = "mobile";
  std::vector<std::string> base = {};
  std::string extension = ".pfm";
};

const std::vector<std::string> kFog = {"--fog", "0.5,0,0"}, kOrbit = {"--orbit", "10,50,4"}, kRough = {"--error", "5%"};

const std::vector<Probe> kProbes = {
    {{"--env", "builtin:sky"}},
    {{"--env-rotation", "90"}},
    {kSun},
    {{"--no-sun-extraction"}, "spheres", "highend", {"--env", "builtin:sky"}},
    {{"--subject", "ball"}, "lamps"},
    {{"--sky-light-color", "1,0,0"}},
    {{"--sun-specular-scale", "0"}, "spheres", "mobile", kSun},
    {{"--falloff", "ue4"}, "lamps"},
    {kFog},
    {{"--fog-color", "1,0,0"}, "spheres", "mobile", kFog},
    {{"--fog-start", "2"}, "spheres", "mobile", kFog},
    {{"--fog-opacity", "0.2"}, "spheres", "mobile", kFog},
    {{"--fully-rough", "*"}},
    {kOrbit},
    {{"--target", "0,1,0"}, "spheres", "mobile", kOrbit},
    {{"--fov", "20"}, "spheres", "mobile", kOrbit},
    {{"--samples", "4"}},
    {{"--exposure", "1"}, "spheres", "mobile", {}, ".png"},
    {{"--display", "ACES SDR"}, "spheres", "mobile", {}, ".png"},
    {{"--background", "1,0,0"}},
    {{"--shadows"}, "shadows", "highend"},
    {{"--shadow-map-size", "512"}, "shadows", "highend", {"--shadows"}},
    {{"--shadow-filter", "0"}, "shadows", "highend", {"--shadows"}},
    {{"--mobile-preset", "karis2014"}},
    {{"--precision", "fp32"}},
    {{"--sky-sh", "9"}},
    {{"--capture", "fp16"}},
    {{"--direct-lobe", "d-approx"}, "spheres", "mobile", kSun},
    {{"--mobile-target", "rgba8-srgb"}},
    {{"--mobile-textures", "astc6x6"}},
    {{"--specular-aa", "toksvig"}},
    {{"--mobile-spot-shadow"}, "shadows"},
    {{"--mobile-spot-sharpen", "8"}, "shadows", "mobile", {"--mobile-spot-shadow"}},
    {{"--mobile-spot-fade", "0.5"}, "shadows", "mobile", {"--mobile-spot-shadow"}},
    {{"--mobile-sun-shadow"}, "shadows"},
    {{"--mobile-sun-distance", "2"}, "shadows", "mobile", {"--mobile-sun-shadow"}},
    {{"--mobile-sun-fade", "1"}, "shadows", "mobile", {"--mobile-sun-shadow"}},
    {{"--geometry-term", "schlick-smith"}, "spheres", "highend"},
    {{"--fresnel", "spherical-gaussian"}, "spheres", "highend"},
    {{"--diffuse", "lambert"}, "spheres", "highend"},
    {{"--compensation", "none"}, "spheres", "highend"},
    {{"--off-specular", "none"}, "spheres", "highend"},
    {{"--error", "5%"}, "spheres", "reference", {}},
    {{"--scattering", "single"}, "spheres", "reference", kRough},
    {{"--interreflection", "1"}, "room", "reference", {"--error", "5%", "--shadows"}},
    {{"--term", "NoL"}, "spheres", "mobile", kSun},
    {{"--material", "dielectric*"}},
    {{"--material", "dielectric*"}, "spheres", "highend"},
    {{"--material", "dielectric*"}, "spheres", "reference", kRough},
};

// What shows elsewhere: in a file that has it, or in no picture.
const std::map<std::string, std::string> kElsewhere = {{"--help", "help_test"},
                                                       {"--path", "render_test"},
                                                       {"--output", "render_test"},
                                                       {"--terms", "render_test"},
                                                       {"--list-terms", "render_test"},
                                                       {"--size", "render_test"},
                                                       {"--error-map", "reference_test"},
                                                       {"--time", "gltf_pose_test"},
                                                       {"--animation", "gltf_animation_test"},
                                                       {"--scene", "gltf_node_test"},
                                                       {"--variant", "gltf_material_test"},
                                                       {"--camera", "render_test"},
                                                       {"--max-image", "gltf_limits_test"},
                                                       {"--max-memory", "gltf_limits_test"},
                                                       {"--indirect-color-scale", "bake_test"},
                                                       {"--baked", "bake_test"},
                                                       {"--capture-scale", "bake_test"},
                                                       {"--mixing-begin", "bake_test"},
                                                       {"--mixing-end", "bake_test"},
                                                       {"--mixing-largest", "bake_test"},
                                                       {"--device", "devices_test"},
                                                       {"--validation", "devices_test"},
                                                       {"--threads", "determinism_test"},
                                                       {"--cache", "result_cache_test"},
                                                       {"--cache-size", "result_cache_test"},
                                                       {"--no-cache", "result_cache_test"},
                                                       {"--timings", "help_test"},
                                                       {"--quiet", "output_test"},
                                                       {"--verbose", "help_test"}};

class OptionsTest : public RenderingTest {
protected:
  std::string render(const Probe& probe, bool asked) const {
    const std::string file = (m_folder / ("a" + probe.extension)).string();
    const RunResult result =
        runParity(join({{"render", "builtin:" + probe.scene, "--path", probe.path, "--size", "32x32", "-o", file},
                        probe.base,
                        asked ? probe.words : std::vector<std::string>()}));
    EXPECT_TRUE(exitedWith(0, result));
    return readWholeFile(file);
  }
};

TEST_F(OptionsTest, OfRenderMakeAnotherPicture) {
  std::map<std::string, std::string> without; // by what is asked for besides
  for (const Probe& probe : kProbes) {
    std::string key = probe.scene + " " + probe.path + probe.extension;
    for (const std::string& word : probe.base) key += " " + word;
    if (!without.contains(key)) without[key] = render(probe, false);
    EXPECT_TRUE(render(probe, true) != without[key]) << probe.words.front() << " does nothing";
  }
}

TEST(Options, OfRenderAreAllProbed) {
  const std::string help = runParity({"render", "--help"}).out;
  std::vector<std::string> listed;
  for (const std::string& line : splitLines(help)) {
    std::smatch match;
    if (std::regex_search(line, match, std::regex("^ +(-[a-z],)?(--[a-z-]+)"))) listed.push_back(match[2]);
  }
  EXPECT_GT(listed.size(), 60u);
  for (const std::string& option : listed)
    EXPECT_TRUE(kElsewhere.contains(option) ||
                std::ranges::any_of(kProbes, [&](const Probe& p) { return p.words.front() == option; }))
        << option << " is listed: what does it do?";
}

// What draws a material draws nothing else.
TEST_F(OptionsTest, MaterialOfRenderHasToMatchAndIsAllThatIsDrawn) {
  const std::vector<std::string> render = {"render", "builtin:spheres", "--path", "mobile",
                                           "--size", "32x32",           "-o",     (m_folder / "a.pfm").string()};
  expectRefused(runParity(join({render, {"--material", "no such *"}})), 4, {"--material 'no such *'", "no material"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.pfm"));
  const auto draw = [&](const std::vector<std::string>& more) {
    EXPECT_TRUE(exitedWith(0, runParity(join({render, {"--background", "0,0,0"}, more}))));
    const base::Image image = base::readImage(m_folder / "a.pfm");
    return std::ranges::count_if(image.pixels, [](float value) { return value > 0; });
  };
  const auto all = draw({}), metals = draw({"--material", "dielectric*"}), rest = draw({"--material", "metal*"});
  EXPECT_EQ(draw({"--material", "*"}), all);
  EXPECT_GT(metals, 0);
  EXPECT_LT(metals, all);
  EXPECT_LE(rest, all);
}

} // namespace
} // namespace parity::tests

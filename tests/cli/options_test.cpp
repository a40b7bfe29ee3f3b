// Every option that a command lists is read by it: another value makes another result.
#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

// Another value of an option, and what is needed so that it can be seen.
struct Probe {
  std::vector<std::string> words;                 // the option, its value
  std::string scene = "spheres", path = "mobile"; // a built-in scene, or kChoices
  std::vector<std::string> base = {};
  std::string extension = ".pfm";
};

const std::string kChoices = "choices"; // the file of writeChoices()
const std::vector<std::string> kFog = {"--fog", "0.5,0,0"}, kOrbit = {"--orbit", "10,50,4"}, kRough = {"--error", "5%"},
                               kFixed = join({kOrbit, {"--target", "0,0,0"}});

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
    {{"--filter-width", "2"}, "spheres", "mobile", {"--samples", "4"}},
    {{"--exposure", "1"}, "spheres", "mobile", {}, ".png"},
    {{"--display", "ACES SDR"}, "spheres", "mobile", {}, ".png"},
    {{"--background", "1,0,0"}},
    {{"--shadows"}, "shadows", "highend"},
    {{"--shadow-map-size", "512"}, "shadows", "highend", {"--shadows"}},
    {{"--shadow-filter", "0"}, "shadows", "highend", {"--shadows"}},
    {{"--mobile-preset", "karis2014"}},
    {{"--precision", "fp32"}},
    {{"--sky-sh", "9"}},
    {{"--mobile-coat", "none"}, "lobes"},
    {{"--mobile-sheen", "fit"}, "lobes"},
    {{"--mobile-anisotropy", "bent"}, "lobes"},
    {{"--mobile-iridescence", "tint"}, "lobes"},
    {{"--mobile-transmission", "refracted"}, "lobes"},
    {{"--mobile-diffuse-transmission", "lambert"}, "lobes"},
    {{"--mobile-nonmetal"}},
    {{"--capture", "fp16"}},
    {{"--direct-lobe", "d-approx"}, "spheres", "mobile", kSun},
    {{"--no-mobile-local-lights"}, "lamps"},
    {{"--no-mobile-light-cap"}, "lamps"},
    {{"--mobile-pixel-fog"}, "lamps", "mobile", kFog},
    {{"--mobile-roughness-floor", "0.9"}},
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
    {{"--highend-preset", PARITY_SOURCE_DIR "/highend/presets/khronos-sample"}, "spheres", "highend", kSun},
    {{"--off-specular", "none"}, "spheres", "highend"},
    {{"--lut-size", "8"}, "spheres", "highend"},
    {{"--prefilter-samples", "8"}, "spheres", "highend"},
    {{"--prefilter-size", "64"}, "spheres", "highend"},
    {{"--error", "5%"}, "spheres", "reference", {}},
    {{"--scattering", "single"}, "spheres", "reference", kRough},
    {{"--interreflection", "1"}, "room", "reference", {"--error", "5%", "--shadows"}},
    {{"--term", "NoL"}, "spheres", "mobile", kSun},
    {{"--material", "dielectric*"}},
    {{"--material", "dielectric*"}, "spheres", "highend"},
    {{"--material", "dielectric*"}, "spheres", "reference", kRough},
    {{"--time", "1"}, kChoices, "mobile", kFixed},
    {{"--animation", "none"}, kChoices, "mobile", join({kFixed, {"--time", "1"}})},
    {{"--scene", "1"}, kChoices, "mobile", kFixed},
    {{"--variant", "red"}, kChoices, "mobile", kFixed},
    {{"--camera", "0"}, kChoices},
};

// Of pairs of pictures; the figures or files that are another's with them.
const std::vector<std::vector<std::string>> kFlipProbes = {
    {"--start-exposure", "-4"}, {"--stop-exposure", "4"}, {"--exposures", "3"},       {"--tonemapper", "reinhard"},
    {"--mask-kind", "weights"}, {"--ppd", "20"},          {"--exposure-map", "e.png"}};

class OptionsTest : public RenderingTest {
protected:
  // A file with two scenes, a variant, a camera, and an animation that moves what the first scene shows.
  std::string writeChoices() const {
    GltfFile file = makeQuad();
    file.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}});
    file.json["extensionsUsed"] = {"KHR_materials_variants"};
    file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
    file.json["nodes"].push_back({{"mesh", 0}, {"scale", {0.5, 0.5, 0.5}}});
    file.json["scenes"].push_back({{"nodes", {1}}});
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    file.json["nodes"].push_back({{"camera", 0}, {"translation", {0.2, 0, 6}}});
    file.json["scenes"][0]["nodes"].push_back(2);
    const int times = file.add<float>({0, 1}, "SCALAR"), places = file.add<float>({0, 0, 0, 0.7f, 0, 0}, "VEC3");
    file.json["accessors"][times]["min"] = {0};
    file.json["accessors"][times]["max"] = {1};
    file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                                {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    return writeGlb(m_folder, file, kChoices);
  }
  std::string render(const Probe& probe, bool asked, const std::string& choices) const {
    const std::string file = (m_folder / ("a" + probe.extension)).string();
    const std::vector<std::string> light = probe.scene == kChoices ? kSun : std::vector<std::string>();
    const bool filters = probe.words.front().starts_with("--prefilter");
    const RunResult result = runParity(join({{"render", probe.scene == kChoices ? choices : "builtin:" + probe.scene,
                                              "--path", probe.path, "--size", "32x32", "-o", file},
                                             light,
                                             filters ? std::vector<std::string>() : kRoughSky,
                                             probe.base,
                                             asked ? probe.words : std::vector<std::string>()}));
    EXPECT_TRUE(exitedWith(0, result));
    return readWholeFile(file);
  }
};

// A test for each path, and of the mobile path's many probes for each fifth.
struct Share {
  std::string name, path;
  std::size_t part = 0, parts = 1;
};
const std::vector<Share> kShares = {
    {"highend", "highend"},      {"reference", "reference"},  {"mobile1", "mobile", 0, 5}, {"mobile2", "mobile", 1, 5},
    {"mobile3", "mobile", 2, 5}, {"mobile4", "mobile", 3, 5}, {"mobile5", "mobile", 4, 5}};

std::vector<Probe> probesOf(const Share& share) {
  std::vector<Probe> ofPath, found;
  std::ranges::copy_if(kProbes, std::back_inserter(ofPath), [&](const Probe& each) { return each.path == share.path; });
  for (std::size_t i = share.part * ofPath.size() / share.parts; i < (share.part + 1) * ofPath.size() / share.parts;
       ++i)
    found.push_back(ofPath[i]);
  return found;
}

class RenderOptionsTest : public OptionsTest, public testing::WithParamInterface<Share> {};

TEST_P(RenderOptionsTest, MakeAnotherPicture) {
  const std::string choices = writeChoices();
  std::map<std::string, std::string> without; // by what is asked for besides
  for (const Probe& probe : probesOf(GetParam())) {
    std::string key = probe.scene + " " + probe.path + probe.extension;
    if (probe.words.front().starts_with("--prefilter")) key += " finely";
    for (const std::string& word : probe.base) key += " " + word;
    if (!without.contains(key)) without[key] = render(probe, false, choices);
    EXPECT_TRUE(render(probe, true, choices) != without[key]) << probe.words.front() << " does nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(Of, RenderOptionsTest, testing::ValuesIn(kShares),
                         [](const auto& share) { return share.param.name; });

TEST(Options, OfRenderAreAllProbed) {
  std::size_t count = 0;
  for (const Share& share : kShares) count += probesOf(share).size();
  EXPECT_EQ(count, kProbes.size());
}

TEST_F(OptionsTest, OfFlipMakeOtherFigures) {
  base::Image a(32, 32, 3), b(32, 32, 3), ids(32, 32, 1);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    a.pixels[i] = 0.01f * static_cast<float>(i % 97) + (i % 7 == 0 ? 20.f : 0.f);
    b.pixels[i] = a.pixels[i] * (i % 5 == 0 ? 1.5f : 1.f);
  }
  for (std::size_t i = 0; i < ids.pixels.size(); ++i) ids.pixels[i] = static_cast<float>(1 + i % 2);
  base::writeImage(m_folder / "a.exr", a);
  base::writeImage(m_folder / "b.exr", b);
  base::writeImage(m_folder / "ids.exr", ids);
  RunOptions here;
  here.workingFolder = m_folder.path();
  const auto compare = [&](const std::vector<std::string>& words) {
    const std::vector<std::string> mask =
        words[0] == "--mask-kind" ? std::vector<std::string>{"--mask", "ids.exr"} : std::vector<std::string>();
    const RunResult plain = runParity(join({{"flip", "a.exr", "b.exr", "--json", "-"}, mask}), here);
    EXPECT_TRUE(exitedWith(0, plain));
    const RunResult asked = runParity(join({{"flip", "a.exr", "b.exr", "--json", "-"}, mask, words}), here);
    return plain.out != asked.out || std::filesystem::exists(m_folder / words[1]);
  };
  for (const std::vector<std::string>& words : kFlipProbes) EXPECT_TRUE(compare(words)) << words[0] << " does nothing";
}

// An option is one of the probes above, of a command that shares it with render, or some test runs the command with it.
TEST(Options, OfEveryCommandAreUsedByATest) {
  std::vector<std::string> sources;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(PARITY_SOURCE_DIR) / "tests/cli"))
    if (entry.path().extension() == ".cpp" && entry.path().filename() != "options_test.cpp")
      sources.push_back(readWholeFile(entry.path()));
  std::set<std::string> probed = {"--help"}; // which help_test.cpp asks of every command
  for (const Probe& probe : kProbes) probed.insert(probe.words.front());
  for (const std::vector<std::string>& words : kFlipProbes) probed.insert(words.front());
  const std::regex listed("^ +(?:(-[a-zA-Z]),)?(--[a-z0-9-]+)");
  std::size_t count = 0;
  for (const std::vector<std::string>& command : {std::vector<std::string>{"report"},
                                                  {"diff"},
                                                  {"render"},
                                                  {"flip"},
                                                  {"bake"},
                                                  {"bench"},
                                                  {"explain"},
                                                  {"worst"},
                                                  {"info"},
                                                  {"export"},
                                                  {"contract"},
                                                  {"calibrate"},
                                                  {"budget", "suggest"},
                                                  {"budget", "check"},
                                                  {"cache"},
                                                  {"devices"},
                                                  {"stress"},
                                                  {"fit"},
                                                  {"plot", "env-brdf"}}) {
    const auto isUsed = [&](const std::string& option) {
      return std::ranges::any_of(sources, [&](const std::string& text) {
        return contains(text, '"' + command.back() + '"') &&
               (contains(text, '"' + option + '"') || contains(text, '"' + option + ' '));
      });
    };
    for (const std::string& line : linesOf(runParity(join({command, {"--help"}})).out)) {
      std::smatch match;
      if (!std::regex_search(line, match, listed)) continue;
      ++count;
      EXPECT_TRUE(probed.contains(match[2]) || isUsed(match[2]) || (match[1].matched && isUsed(match[1])))
          << command.back() << " " << match[2] << ": which test would see that nobody reads it?";
    }
  }
  EXPECT_GT(count, 400u);
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

// What the user wrote cannot be meant: the parser refuses it. exit_code_test.cpp shows the same of the program.
#include <gtest/gtest.h>

#include "base/lines_of.h"
#include "cli/invocation.h"

namespace parity::tests {
namespace {

struct BadUsage {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> parts;
};

const BadUsage kBadUsages[] = {
    {"NoCommand", {}, {"subcommand"}},
    {"UnknownCommand", {"compare", "a", "b"}, {"compare"}},
    {"UnknownOption", {"diff", "builtin:furnace", "--colour"}, {"--colour"}},
    {"NoScene", {"diff"}, {"scene"}},
    {"TwoScenesForDiff", {"diff", "builtin:furnace", "builtin:spheres"}, {"builtin:spheres"}},
    {"ReportWithoutOutput", {"report", "builtin:furnace"}, {"--output"}},
    {"ReportOfNothing", {"report", "-o", "out"}, {"SCENE", "--suite"}},
    {"SuiteBesideScenes", {"report", "builtin:furnace", "--suite", "s.toml", "-o", "out"}, {"--suite"}},
    {"RenderWithoutPath", {"render", "builtin:furnace", "-o", "out.exr"}, {"--path"}},
    {"UnknownPath", {"render", "builtin:furnace", "-o", "out.exr", "--path", "middle"}, {"--path", "middle"}},
    {"UnknownPicture", {"render", "builtin:furnace", "-o", "out.tga", "--path", "mobile"}, {"out.tga", ".exr", ".png"}},
    {"PictureWithoutExtension", {"render", "builtin:furnace", "-o", "out", "--path", "mobile"}, {"out", ".exr"}},
    {"HugeReport",
     {"report", "builtin:furnace", "-o", "out", "--size", "16384x16384"},
     {"--size", "16384x16384", "MiB", "--max-memory"}},
    {"HugeRender",
     {"render", "builtin:furnace", "-o", "o.png", "--path", "mobile", "--size", "16384x16384"},
     {"--size", "--max-memory"}},
    {"FlipOfOneImage", {"flip", "a.png"}, {"test"}},
    {"FlipPpdOfNaN", {"flip", "a.png", "b.png", "--ppd", "nan"}, {"--ppd"}},
    {"CacheOfNoSize", {"diff", "builtin:furnace", "--cache-size", "0"}, {"--cache-size", "'0'"}},
    {"CacheOfAnUnknownUnit", {"diff", "builtin:furnace", "--cache-size", "4GB"}, {"--cache-size", "500M"}},
    {"CacheBeyondAll", {"diff", "builtin:furnace", "--cache-size", "99999999T"}, {"--cache-size"}},
    {"CacheWithoutACommand", {"cache"}, {"subcommand"}},
    {"SizeOfOneNumber", {"diff", "builtin:furnace", "--size", "96"}, {"--size", "'96'"}},
    {"SizeZero", {"diff", "builtin:furnace", "--size", "0x10"}, {"--size", "'0x10'"}},
    {"SizeNegative", {"diff", "builtin:furnace", "--size", "-4x4"}, {"--size"}},
    {"SizeWithATail", {"diff", "builtin:furnace", "--size", "96x96px"}, {"--size", "'96x96px'"}},
    {"SizeTooLarge", {"diff", "builtin:furnace", "--size", "99999x10"}, {"--size", "16384"}},
    {"SizeBeyondInt", {"diff", "builtin:furnace", "--size", "4294967297x1"}, {"--size"}},
    {"SunOfTwoNumbers", {"diff", "builtin:furnace", "--sun", "30,50"}, {"--sun", "AZIMUTH,ELEVATION,LUX"}},
    {"SunOfFourNumbers", {"diff", "builtin:furnace", "--sun", "30,50,4,1"}, {"--sun"}},
    {"SunInWords", {"diff", "builtin:furnace", "--sun", "30,high,4"}, {"--sun", "30,high,4"}},
    {"SunOfNaN", {"diff", "builtin:furnace", "--sun", "30,nan,4"}, {"--sun"}},
    {"SunNegative", {"diff", "builtin:furnace", "--sun", "30,50,-4"}, {"--sun", "negative"}},
    {"SunAboveTheZenith", {"diff", "builtin:furnace", "--sun", "-30,500,4"}, {"--sun", "-90", "90"}},
    {"SkyOfTwoNumbers", {"diff", "builtin:furnace", "--sky-light-color", "1,1"}, {"--sky-light-color", "R,G,B"}},
    {"SkyNegative", {"diff", "builtin:furnace", "--sky-light-color", "1,-1,1"}, {"--sky-light-color", "0 to 1000"}},
    {"IndirectOfNaN", {"diff", "builtin:furnace", "--indirect-color-scale", "1,nan,1"}, {"--indirect-color-scale"}},
    {"SpecularScaleOfNaN", {"diff", "builtin:furnace", "--sun-specular-scale", "nan"}, {"--sun-specular-scale"}},
    {"UnknownFalloff", {"diff", "builtin:furnace", "--falloff", "kr"}, {"--falloff", "'kr'", "did you mean 'khr'?"}},
    {"FalloffBesideASuite", {"report", "--suite", "s.toml", "--falloff", "ue4", "-o", "out"}, {"--suite", "--falloff"}},
    {"UnknownCaptureScale",
     {"diff", "builtin:furnace", "--capture-scale", "mixed"},
     {"--capture-scale", "did you mean 'mixing'?"}},
    {"CaptureScaleThatWasReplaced",
     {"diff", "builtin:furnace", "--capture-scale", "by-roughness"},
     {"--capture-scale", "'by-roughness' is no longer known: use 'mixing'", "--mixing-begin"}},
    {"MixingBackwards",
     {"diff", "builtin:furnace", "--mixing-begin", "0.5", "--mixing-end", "0.4"},
     {"--mixing-begin", "0.5 is not below --mixing-end", "0.4"}},
    {"MixingOfNoWidth", {"diff", "builtin:furnace", "--mixing-begin", "0.3"}, {"--mixing-begin", "0.3"}},
    {"MixingBeyondRough", {"diff", "builtin:furnace", "--mixing-end", "1.5"}, {"--mixing-end", "0 to 1"}},
    {"MixingOfNaN", {"diff", "builtin:furnace", "--mixing-begin", "nan"}, {"--mixing-begin", "0 to 1"}},
    {"MixingOfNoWeight", {"diff", "builtin:furnace", "--mixing-largest", "0"}, {"--mixing-largest", "65504"}},
    {"MixingBeyondHalf", {"diff", "builtin:furnace", "--mixing-largest", "1e6"}, {"--mixing-largest", "65504"}},
    {"FogOfTwoNumbers", {"diff", "builtin:furnace", "--fog", "1,1"}, {"--fog", "DENSITY,FALLOFF,HEIGHT"}},
    {"FogOfNegativeFalloff", {"diff", "builtin:furnace", "--fog", "1,-1,0"}, {"--fog", "FALLOFF", "'1,-1,0'"}},
    {"FogColorWithoutFog", {"diff", "builtin:furnace", "--fog-color", "1,1,1"}, {"--fog-color", "--fog"}},
    {"FogOfMoreThanAll", {"diff", "builtin:furnace", "--fog", "1,1,1", "--fog-opacity", "1.1"}, {"--fog-opacity"}},
    {"FogBeforeTheEye", {"diff", "builtin:furnace", "--fog", "1,1,1", "--fog-start", "-1"}, {"--fog-start"}},
    {"FogBesideASuite", {"report", "--suite", "s.toml", "--fog", "1,1,1", "-o", "out"}, {"--suite", "--fog"}},
    {"OrbitBelowTheNadir", {"diff", "builtin:furnace", "--orbit", "30,200,4"}, {"--orbit", "180"}},
    {"OrbitOfNegativeRadius", {"diff", "builtin:furnace", "--orbit", "30,70,-4"}, {"--orbit"}},
    {"CameraAndOrbit", {"diff", "builtin:furnace", "--camera", "a", "--orbit", "1,2,3"}, {"--camera", "--orbit"}},
    {"FovTooWide", {"diff", "builtin:furnace", "--fov", "180"}, {"--fov"}},
    {"FovOfNaN", {"diff", "builtin:furnace", "--fov", "nan"}, {"--fov"}},
    {"RotationInfinite", {"diff", "builtin:furnace", "--env-rotation", "inf"}, {"--env-rotation"}},
    {"ExposureOfNaN", {"diff", "builtin:furnace", "--exposure", "nan"}, {"--exposure"}},
    {"NoSamples", {"diff", "builtin:furnace", "--samples", "0"}, {"--samples"}},
    {"NegativeBackground", {"diff", "builtin:furnace", "--background", "0,-1,0"}, {"--background", "negative"}},
    {"UnknownDisplay", {"diff", "builtin:furnace", "--display", "Rec.2020"}, {"--display", "ACES SDR"}},
    {"UnknownTextures", {"diff", "builtin:furnace", "--mobile-textures", "astc5x5"}, {"--mobile-textures", "astc6x6"}},
    {"UnknownTarget", {"diff", "builtin:furnace", "--mobile-target", "rgb10a2"}, {"--mobile-target", "r11g11b10f"}},
    {"FilmToneMapperOverEightBits",
     {"diff", "builtin:furnace", "--mobile-target", "rgba8-srgb", "--display", "ACES SDR"},
     {"--mobile-target", "'ACES SDR' needs a float target"}},
    {"RawDisplayOfEightBits",
     {"diff", "builtin:furnace", "--mobile-target", "rgba8-gamma2", "--display", "raw"},
     {"--mobile-target", "'raw' needs a float target"}},
    {"UnknownLobe", {"diff", "builtin:furnace", "--direct-lobe", "phong"}, {"--direct-lobe", "phong-approx"}},
    {"LobeOfRefitElsewhere", {"diff", "builtin:furnace", "--direct-lobe", "refit"}, {"--direct-lobe", "ue4-2020"}},
    {"LobeOfOthersInRefit",
     {"diff", "builtin:furnace", "--mobile-preset", "refit", "--direct-lobe", "d-approx"},
     {"--direct-lobe", "preset refit"}},
    {"SpotFadeWithoutShadow", {"diff", "builtin:furnace", "--mobile-spot-fade", "0.5"}, {"--mobile-spot-shadow"}},
    {"SpotSharpenBelowOne",
     {"diff", "builtin:furnace", "--mobile-spot-shadow", "--mobile-spot-sharpen", "0.5"},
     {"--mobile-spot-sharpen", "1 to 8"}},
    {"SunDistanceWithoutShadow", {"diff", "builtin:furnace", "--mobile-sun-distance", "9"}, {"--mobile-sun-shadow"}},
    {"SunDistanceOfNothing",
     {"diff", "builtin:furnace", "--mobile-sun-shadow", "--mobile-sun-distance", "0"},
     {"--mobile-sun-distance"}},
    {"SunFadeOfNaN",
     {"diff", "builtin:furnace", "--mobile-sun-shadow", "--mobile-sun-fade", "nan"},
     {"--mobile-sun-fade", "0 to 1"}},
    {"UnknownPreset", {"diff", "builtin:furnace", "--mobile-preset", "ue5"}, {"--mobile-preset", "ue4-2020"}},
    {"UnknownPrecision", {"diff", "builtin:furnace", "--precision", "fp64"}, {"--precision", "fp32"}},
    {"UnknownMetric", {"diff", "builtin:furnace", "--metrics", "flip,pnsr"}, {"--metrics", "'pnsr'", "'psnr'"}},
    {"NoMetric", {"diff", "builtin:furnace", "--metrics", ""}, {"--metrics"}},
    {"MetricsOfARender",
     {"render", "builtin:furnace", "--path", "mobile", "-o", "o.exr", "--metrics", "flip"},
     {"--metrics"}},
    {"ErrorWithoutReference", {"diff", "builtin:furnace", "--error", "1%"}, {"--error", "--truth"}},
    {"ScatteringWithoutReference",
     {"report", "builtin:furnace", "-o", "out", "--scattering", "single"},
     {"--scattering", "--truth"}},
    {"ShadowMapSize", {"diff", "builtin:furnace", "--shadow-map-size", "1000"}, {"--shadow-map-size", "1024"}},
    {"ShadowFilter", {"diff", "builtin:furnace", "--shadow-filter", "2"}, {"--shadow-filter", "3"}},
    {"ReferenceErrorOfNothing", {"diff", "builtin:furnace", "--truth", "--error", "0"}, {"--error", "'0'"}},
    {"ReferenceOfARender", {"render", "builtin:furnace", "--path", "mobile", "-o", "o.exr", "--truth"}, {"--truth"}},
    {"UnknownSpecularAa", {"diff", "builtin:furnace", "--specular-aa", "lean"}, {"--specular-aa", "toksvig"}},
    {"UnknownPlot", {"plot", "env-brfd", "-o", "out"}, {"env-brfd", "env-brdf"}},
    {"PlotWithoutFolder", {"plot", "env-brdf"}, {"--output"}},
    {"UnknownFitFormat", {"fit", "--format", "wgsl"}, {"--format", "hlsl"}},
    {"UnknownFitCompensation", {"fit", "--compensation", "all"}, {"--compensation", "turquin"}},
    {"OutputOfNothing", {"report", "builtin:furnace", "-o", ""}, {"--output", "has an empty value"}},
    {"BakeIntoNothing", {"bake", "builtin:room", "-o", ""}, {"--output", "has an empty value"}},
    {"BenchIntoNothing", {"bench", "builtin:furnace", "-o", ""}, {"--output", "has an empty value"}},
    {"FlipMapOfNothing", {"flip", "a.png", "b.png", "-o", ""}, {"--output", "has an empty value"}},
    {"BudgetsIntoNothing", {"budget", "suggest", "r.json", "-o", ""}, {"--output", "has an empty value"}},
    {"FitIntoNothing", {"fit", "-o", ""}, {"--output", "has an empty value"}},
    {"StressIntoNothing", {"stress", "-o", ""}, {"--output", "has an empty value"}},
    {"SceneOfNothing", {"diff", ""}, {"scene", "has an empty value"}},
    {"BaselineOfNothing", {"diff", "builtin:furnace", "--baseline", ""}, {"--baseline", "has an empty value"}},
    {"BudgetsOfARender",
     {"render", "builtin:furnace", "--path", "mobile", "-o", "o.exr", "--budgets", "b.toml"},
     {"--budgets"}},
    {"UnknownGeometryTerm", {"diff", "builtin:furnace", "--geometry-term", "smith"}, {"height-correlated"}},
};

// In one test: a row takes a millisecond, a process of its own would take fifty.
TEST(Usage, EveryWrongCommandLineIsRefusedWithItsReason) {
  for (const BadUsage& usage : kBadUsages) {
    SCOPED_TRACE(usage.name);
    std::vector<const char*> arguments = {"parity"};
    for (const std::string& argument : usage.arguments) arguments.push_back(argument.c_str());
    const cli::Parsed parsed = cli::parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
    EXPECT_FALSE(parsed.command.has_value()) << "it is taken";
    EXPECT_EQ(parsed.exitCode, 64);
    for (const std::string& part : usage.parts)
      EXPECT_NE(parsed.text.find(part), std::string::npos) << part << " in: " << parsed.text;
    EXPECT_LE(linesOf(parsed.text).size(), 2u) << "a reason and where to find help: " << parsed.text;
  }
}

} // namespace
} // namespace parity::tests

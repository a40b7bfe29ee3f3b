// The table: complete, within the documents of the sources, and free of unexpected findings.
#include "study/stress/function_stress.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"

namespace parity::tests {
namespace {

using namespace stress;

TEST(StressTable, HasOneEntryForEachIdInOrder) {
  const std::vector<FunctionCase> table = functionTable();
  ASSERT_EQ(table.size(), static_cast<std::size_t>(kFunctionCount));
  std::set<std::string> names;
  for (int id = 0; id < kFunctionCount; ++id) {
    EXPECT_EQ(table[static_cast<std::size_t>(id)].id, id);
    names.insert(table[static_cast<std::size_t>(id)].name);
  }
  EXPECT_EQ(names.size(), table.size());
}

// Every FN of the sources that takes part in a picture is called by evaluate*.glsl, itself or by what it is part of.
TEST(StressTable, EvaluatesEveryPublicFunctionOfTheSources) {
  const std::filesystem::path root = PARITY_SOURCE_DIR;
  std::string text;
  for (const char* file : {"study/stress/shaders/evaluate.glsl", "study/stress/shaders/evaluate_base_pass.glsl",
                           "study/stress/shaders/evaluate_baked.glsl"}) {
    std::ifstream stream(root / file);
    text += std::string(std::istreambuf_iterator<char>(stream), {});
  }
  std::string sources;
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(root / "shading")) {
    if (entry.path().extension() != ".glsl") continue;
    std::ifstream stream(entry.path());
    std::string line;
    while (std::getline(stream, line)) {
      sources += line + "\n";
      std::istringstream words(line);
      std::string macro, type, name;
      words >> macro >> type >> name;
      if (macro == "FN" && name.find('(') != std::string::npos) names.insert(name.substr(0, name.find('(')));
    }
  }
  ASSERT_GT(names.size(), 70u);
  const auto callsOf = [](const std::string& in, const std::string& name) {
    std::size_t count = 0;
    for (std::size_t at = in.find(name + "("); at != std::string::npos; at = in.find(name + "(", at + 1)) ++count;
    return count;
  };
  // The first two give level numbers (tests/shading/off_specular_test.cpp); tests/shading/material_test.cpp has the
  // third, tests/shading/lamps_test.cpp and tests/highend/reflection_test.cpp the others of prefiltering, of the
  // high-end path alone. tests/shading/mobile_lobes_test.cpp and sheen_test.cpp ask those of coat and sheen over their
  // whole domain, in half, too; anisotropic_brdf_test.cpp, thin_film_test.cpp and
  // mobile_microfacets_test.cpp there those of anisotropy and films, refraction_test.cpp those of bodies.
  const std::set<std::string> elsewhere = {"prefilterBlend",
                                           "finePrefilterBlend",
                                           "sharpLobe",
                                           "prefilteredLobeIntegral",
                                           "meanOverSpread",
                                           "prefilteredLobe",
                                           "lobeScale",
                                           "meanOfGgx",
                                           "lampShare",
                                           "V_Charlie",
                                           "belowSheen",
                                           "coatLightUE4",
                                           "sheenAlbedoFit",
                                           "sheenLightFit",
                                           "underCoatUE4",
                                           "anisotropicAlpha",
                                           "D_GGXAnisotropic",
                                           "projectedAlpha",
                                           "thinFilmFresnel",
                                           "V_SmithGGXAnisotropic",
                                           "iridescentFresnel",
                                           "V_SchlickSmithAnisotropic",
                                           "mobileAnisotropy",
                                           "bentNormal",
                                           "squeezedSin2",
                                           "squeezedRefitLight",
                                           "squeezedCalcSpecular",
                                           "filmTint",
                                           "underFilm",
                                           "throughSphere",
                                           "leavingBody",
                                           "refracted",
                                           "meanVisibleNormal",
                                           "reflectedWithin",
                                           "reflectanceFromWithin",
                                           "cosineOutside",
                                           "addFacet",
                                           "crossingFromWithin",
                                           "turnOfRefraction2",
                                           "alphaOfTurn",
                                           "leavingLater",
                                           "transmittance",
                                           "dispersedIors",
                                           "alphaOfRefraction",
                                           "mobileSceneShare"};
  for (const std::string& name : names) {
    if (elsewhere.count(name)) continue;
    EXPECT_TRUE(callsOf(text, name) > 0 || callsOf(sources, name) > 1) << name << " is evaluated nowhere";
  }
}

// The ranges that the comments of shading/*.glsl state, by the sentence that states them.
TEST(StressTable, DomainsLieWithinWhatTheSourcesDocument) {
  struct Documented {
    const char *file, *sentence, *function, *input;
    double low, high;
  };
  const Documented documented[] = {
      {"brdf.glsl", "alpha in [0, 1], NoH in [0, 1].", "D_GGX", "alpha", 0, 1},
      {"brdf.glsl", "alpha in [0, 1], NoH in [0, 1].", "D_GGX", "NoH", 0, 1},
      {"brdf.glsl", "alpha in [0, 1], NoV and NoL in [0, 1].", "V_SmithGGXCorrelated", "NoV", 0, 1},
      {"brdf.glsl", "alpha in [0, 1], NoV and NoL in [0, 1].", "V_SchlickSmith", "NoL", 0, 1},
      {"brdf.glsl", "F0 in [0, 1], VoH in [0, 1].", "F_Schlick", "VoH", 0, 1},
      {"env_brdf.glsl", "roughness in [0, 1], NoV in [0, 1].", "EnvBRDFApproxAB", "Roughness", 0, 1},
      {"env_brdf.glsl", "Roughness, NoV in [0, 1].", "EnvBRDFApproxNonmetal", "NoV", 0, 1},
      {"mobile_direct.glsl", "RoL in [-1, 1].", "D_Approx", "RoL", -1, 1},
      {"mobile_direct.glsl", "RoL in [0, 1], where the engine's", "PhongApprox", "RoL", 0, 1},
      {"mobile_direct.glsl", "Roughness in [0.015625, 1], NoH in [0, 1]", "GGX_Mobile", "Roughness", 0.015625, 1},
      {"light.glsl", "all cosines in [-1, 1]", "spotAttenuation", "cosAngle", -1, 1},
      {"mips.glsl", "Roughness in [0, 1]", "mipFromRoughness", "Roughness", 0, 1},
      {"mips.glsl", "for mip in [0, 5]", "roughnessFromMip", "mip", 0, 5},
      {"material.glsl", "Specular in [0, 1]", "dielectricSpecular", "Specular", 0, 1},
      {"specular_aa.glsl", "grown in [0, 1]", "widenRoughness", "grown", 0, 1},
      {"refit.glsl", "F0 <= F90 in [0, 1]", "refitLobe", "F90", 0, 1},
      {"refit.glsl", "Roughness, NoV in [0, 1]; wide", "refitTap", "NoV", 0, 1},
      {"off_specular.glsl", "NoV, Roughness in [0, 1].", "threeTap", "Roughness", 0, 1},
      {"fog.glsl", "in [0, 1]: 1 - the least transmittance", "heightFogTransmittance", "maxOpacity", 0, 1},
  };
  for (const Documented& d : documented) {
    std::ifstream stream(std::filesystem::path(PARITY_SOURCE_DIR) / "shading" / d.file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    EXPECT_NE(text.find(d.sentence), std::string::npos) << d.file << " no longer says: " << d.sentence;
    const FunctionCase function = functionsNamed(d.function).front();
    const auto input = std::find_if(function.domain.inputs.begin(), function.domain.inputs.end(),
                                    [&](const Input& i) { return i.name == d.input; });
    ASSERT_NE(input, function.domain.inputs.end()) << d.function << " " << d.input;
    EXPECT_GE(input->low, d.low) << d.function << " " << d.input;
    EXPECT_LE(input->high, d.high) << d.function << " " << d.input;
  }
}

TEST(StressTable, EveryWitnessShowsItsFailure) {
  int witnesses = 0;
  for (const FunctionCase& function : functionTable()) {
    if (function.expected.empty()) continue;
    const FunctionResult result = stressFunction(function, {.points = 0, .devicePoints = 0}, nullptr);
    for (const Finding& finding : findingsOf(result)) EXPECT_TRUE(finding.expected) << finding.subject << finding.fault;
    for (const Expectation& expected : function.expected)
      for (const Precision precision : kPrecisions)
        if (expected.precisions & bitOf(precision) && expected.fault != Fault::notMonotone) {
          const Row row = roundTo(precision, function.domain, expected.witness);
          EXPECT_TRUE(function.domain.contains(row)) << function.name << ": " << expected.regionText;
          EXPECT_TRUE(expected.region(row)) << function.name << ": " << expected.regionText;
          Tally tally(function);
          const Result out = evaluateRounded(precision, function.id, row);
          countRow(function, precision, 0, row, function.domain.contains(row), out, evaluate64(function.id, row),
                   nullptr, tally);
          EXPECT_EQ(tally.faults[static_cast<std::size_t>(expected.fault)].rows, 1u)
              << function.name << " in " << nameOf(precision) << ": " << expected.regionText;
          ++witnesses;
        }
  }
  EXPECT_GT(witnesses, 30);
}

TEST(StressTable, NothingUnexpectedInAShortRun) {
  for (const FunctionCase& function : functionTable()) {
    if (function.domain.numbers() > 20) continue; // grids of 10^5 rows: parity stress itself
    const FunctionResult result = stressFunction(function, {.points = 2000, .devicePoints = 0}, nullptr);
    EXPECT_GT(result.columns[2].tally.inside, 0u) << function.name;
    for (const Finding& finding : findingsOf(result))
      EXPECT_TRUE(finding.expected) << finding.subject << " (" << finding.place << "): " << finding.fault << " "
                                    << finding.example;
  }
}

TEST(StressTable, AnUnknownFunctionIsRefusedWithTheNearestName) {
  base::expectError([] { functionsNamed("D_GXG"); }, {"D_GGX"}, base::ExitCode::usage);
}

} // namespace
} // namespace parity::tests

// brdf, env_brdf, mobile_direct, off_specular.
#include "study/stress/table_parts.h"

#include <algorithm>
#include <cmath>

namespace parity::stress {

using namespace parts;

namespace {

std::vector<Input> smithInputs() { return {unit(0, "alpha"), unit(1, "NoV"), unit(2, "NoL")}; }

std::vector<FunctionCase> brdfFunctions() {
  return {
      entry("D_GGX", kFnD_GGX, units(2))
          .takes({unit(0, "alpha"), unit(1, "NoH")})
          .gives(1, 1)
          .increases("NoH")
          .mapped(0, 1),
      entry("V_SmithGGXCorrelated", kFnV_SmithGGXCorrelated, units(3))
          .takes(smithInputs())
          .gives(1, 1)
          .decreases("NoV")
          .decreases("NoL")
          .sameSwapping("NoV", "NoL")
          .mapped(0, 1),
      entry("V_SchlickSmith", kFnV_SchlickSmith, units(3))
          .takes(smithInputs())
          .gives(1, 1)
          .decreases("NoV")
          .decreases("NoL")
          .sameSwapping("NoV", "NoL")
          .mapped(0, 1),
      entry("F_Schlick", kFnF_Schlick, units(6))
          .takes(join({{unit(0, "VoH")}, rgb(unit(3, "F0"))}))
          .gives(3, first(3), first(3))
          .decreases("VoH", first(3))
          .increases("F0.r"),
      entry("Fd_Lambert", kFnFd_Lambert, units(1)).gives(1, 1, 1),
      entry("schlickWeight", kFnSchlickWeight, units(1)).takes({unit(0, "VoH")}).gives(1, 1, 1).decreases("VoH"),
      entry("sphericalGaussianWeight", kFnSphericalGaussianWeight, units(1), kExp2)
          .takes({unit(0, "VoH")})
          .gives(1, 1, 1)
          .decreases("VoH"),
      entry("dielectricWeight", kFnDielectricWeight, units(1))
          .takes({unit(0, "VoH")})
          .gives(1, 1, 1)
          .decreases("VoH", 1, 1)
          .relativeTo(0.04), // F - 0.04 cancels
      entry("fresnelMeans", kFnFresnelMeans, units(1)).gives(3, first(3), first(3)),
      entry("mixFresnel", kFnMixFresnel, units(5))
          .takes(join({rgb(unit(0, "F0")), {unit(3, "F90"), unit(4, "f")}}))
          .gives(3, first(3), first(3))
          .increases("F0.r")
          .increases("F90", first(3)),
      entry("albedoScaling", kFnAlbedoScaling, uniforms(3, -0.5, 1.5))
          .takes(rgb(within(0, "E", -0.5, 1.5)))
          .gives(3, first(3), first(3))
          .decreases("E.r")
          .promises(Contract::forNumbers),
      entry("energyCompensation", kFnEnergyCompensation, uniforms(6, 0.1, 0.5))
          .takes(join({{unit(0, "A"), unit(1, "B")}, rgb(unit(3, "F0"))}))
          .where([](const Row& r) { return r[0] + r[1] > 0 && r[0] + r[1] <= 1; })
          .settledBy([](Row& r, double) { r[1] = std::min(r[1], 1 - r[0]); })
          .gives(3, first(3))
          .increases("F0.r"),
      entry("fdezAgueraAlbedo", kFnFdezAgueraAlbedo, uniforms(9, 0, 0.5))
          .takes(join({rgb(unit(0, "F0")), rgb(unit(3, "Favg")), {unit(6, "F90"), unit(7, "A"), unit(8, "B")}}))
          .where([](const Row& r) { return r[7] + r[8] > 0 && r[7] + r[8] <= 1; })
          .settledBy([](Row& r, double) { r[8] = std::min(r[8], 1 - r[7]); })
          .gives(3, first(3))
          .relativeTo(kCode)
          .increases("F0.r"),
      entry("kullaContyAlbedo", kFnKullaContyAlbedo, uniforms(5, 0, 1))
          .takes(join({rgb(unit(0, "Favg")), {unit(3, "E"), unit(4, "Eavg")}}))
          .where([](const Row& r) { return r[3] > 0 && r[4] > 0; })
          .gives(3, first(3), first(3))
          .relativeTo(kCode)
          .decreases("E", first(3))
          .increases("Favg.r"),
      entry("kullaContyLobe", kFnKullaContyLobe, units(2))
          .takes({unit(0, "EofNoL"), unit(1, "Eavg")})
          .gives(1, 1)
          .decreases("EofNoL"),
  };
}

// Where A, the factor of F0, is negative: smooth and grazing.
bool isSmoothAndGrazing(double roughness, double NoV) { return roughness < 0.09 && NoV < 0.09; }
bool isRoughAndBlack(double roughness, double F0) { return roughness > 0.7 && F0 < 0.006; }

std::vector<FunctionCase> environmentBrdfFunctions() {
  const char* const kB = "B falls to -0.0024 in the fit itself, which the article does not clamp";
  const char* const kA = "A falls to -0.044 in the fit itself, which the article does not clamp";
  const char* const kSum = "A + B is 1 - 0.55 R, but B alone reaches 1.044";
  const auto grazing = [](const Row& r) { return isSmoothAndGrazing(r[0], r[1]); };
  std::vector<FunctionCase> all = {
      entry("EnvBRDFApproxAB", kFnEnvBRDFApproxAB, units(2), kEnvBrdf)
          .takes({unit(0, "Roughness"), unit(1, "NoV")})
          .gives(2, first(2), first(2))
          .relativeTo(1.04)
          .mapped(0, 1)
          .expect({Fault::negative, kInAll, [](const Row& r) { return isSmoothAndGrazing(r[0], r[1]) || r[0] > 0.7; },
                   "roughness < 0.09 and NoV < 0.09; roughness > 0.7",
                   "A falls to -0.044 and B to -0.0024 in the fit itself", rowOf({{0, 1}, {1, 1}})})
          .expect({Fault::overUnity, kInAll, grazing, "roughness < 0.09 and NoV < 0.09", kSum, rowOf({})}),
      entry("EnvBRDFApproxNonmetal", kFnEnvBRDFApproxNonmetal, units(2), kEnvBrdf)
          .takes({unit(0, "Roughness"), unit(1, "NoV")})
          .gives(1, 1, 1)
          .relativeTo(0.04)
          .mapped(0, 1)
          .expect({Fault::overUnity, kInAll, grazing, "roughness < 0.09 and NoV < 0.09", "the fit reaches 1.0425",
                   rowOf({})}),
  };
  for (const bool ue4 : {false, true})
    all.push_back(
        entry(ue4 ? "EnvBRDFApproxUE4" : "EnvBRDFApprox", ue4 ? kFnEnvBRDFApproxUE4 : kFnEnvBRDFApprox, units(6),
              kEnvBrdf)
            .takes(join({{unit(0, "Roughness"), unit(1, "NoV")}, rgb(unit(3, "F0"))}))
            .gives(3, first(3), first(3))
            .relativeTo(0.04)
            .increases("F0.r", 1, 1.04)
            .mapped(0, 1)
            .expect({Fault::negative, kInAll,
                     ue4 ? [](const Row& r) { return isRoughAndBlack(r[0], std::min({r[3], r[4], r[5]})) && r[4] > 0; }
                         : [](const Row& r) { return isRoughAndBlack(r[0], std::min({r[3], r[4], r[5]})); },
                     ue4 ? "roughness > 0.7, a channel of F0 < 0.006, green not 0" : "roughness > 0.7, F0 < 0.006",
                     ue4 ? "B falls to -0.0024, and saturate(50 g) uses only green" : kB,
                     rowOf({{0, 1}, {1, 1}, {4, ue4 ? 0.04 : 0.0}})})
            .expect({Fault::overUnity, kInAll, grazing, "roughness < 0.09 and NoV < 0.09", kSum,
                     rowOf({{3, 0.04}, {4, 0.04}, {5, 0.04}})})
            .expect({Fault::notMonotone, kInAll, grazing, "roughness < 0.09 and NoV < 0.09", kA,
                     rowOf({{3, 0.04}, {4, 0.04}, {5, 0.04}})}));
  all.back().expect({Fault::negative, kInAll,
                     [](const Row& r) { return isSmoothAndGrazing(r[0], r[1]) && r[4] < 0.02; },
                     "roughness < 0.09 and NoV < 0.09, green of F0 < 0.02",
                     "A falls to -0.044, and saturate(50 g) removes the B that is larger than it", rowOf({{3, 1}})});
  all.push_back(entry("FullyRough", kFnFullyRough, units(6))
                    .takes(join({rgb(unit(0, "DiffuseColor")), rgb(unit(3, "SpecularColor"))}))
                    .gives(6, first(6))
                    .increases("SpecularColor.r"));
  return all;
}

std::vector<FunctionCase> directFunctions() {
  const Agreement dApprox{8, 8, 1e-4,
                          "exp2; its denormals are flushed to 0, and 1/alpha^2 makes this visible below 1e-4"};
  const Input floored = within(0, "Roughness", 0.015625, 1);
  const char* const kPower = "1/R^4 is infinite, because the article has no roughness floor";
  return {
      entry("D_Approx", kFnD_Approx, lobe(0.0625, -1), dApprox)
          .takes({unit(0, "Roughness"), cosine(1, "RoL")})
          .gives(1, 1)
          .increases("RoL")
          .relativeTo(0x1p-14)
          .mapped(0, 1)
          .expect({Fault::notFinite, kIn16, [](const Row& r) { return r[0] <= 0.0625; }, "roughness <= 0.0625",
                   "c = 0.72 / R^4 + 0.4 is infinite in half, and c RoL - c is NaN (docs/shading.md 4)",
                   rowOf({{1, 1}})})
          .expect({Fault::notFinite, kIn32, [](const Row& r) { return r[0] <= 7.5e-10; }, "roughness <= 7.5e-10",
                   kPower, rowOf({{1, 1}})})
          .expect({Fault::notFinite, kIn64, [](const Row& r) { return r[0] == 0; }, "roughness 0", kPower,
                   rowOf({{1, 1}})}),
      entry("PhongApprox", kFnPhongApprox, lobe(0, 0), dApprox)
          .takes({unit(0, "Roughness"), unit(1, "RoL")})
          .gives(1, 1)
          .increases("RoL")
          .relativeTo(0x1p-14)
          .mapped(0, 1),
      entry("GGX_Mobile", kFnGGX_Mobile, lobe(0.015625, 0))
          .takes({floored, wide(unit(1, "NoH"))})
          .gives(1, 1)
          .increases("NoH")
          .relativeTo(0x1p-14)
          .mapped(0, 1),
      entry("CalcSpecular", kFnCalcSpecular, lobe(0.015625, 0))
          .takes({floored, wide(unit(1, "NoH"))})
          .gives(1, 1)
          .increases("NoH")
          .relativeTo(0x1p-14)
          .mapped(0, 1),
  };
}

std::vector<FunctionCase> tapFunctions() {
  std::vector<FunctionCase> all = {entry("dominantBlend", kFnDominantBlend, units(1))
                                       .takes({unit(0, "alpha")})
                                       .gives(1, 1, 1)
                                       .decreases("alpha", 1, 1)};
  for (const auto& [name, id, taps] :
       {std::tuple{"stretchedTap", kFnStretchedTap, 2}, {"twoTap", kFnTwoTap, 2}, {"threeTap", kFnThreeTap, 3}})
    all.push_back(entry(name, id, units(3), kMip)
                      .takes({unit(0, "NoV"), unit(1, "Roughness"),
                              choice(2, "tap", taps == 2 ? std::vector<double>{0, 1} : std::vector<double>{0, 0.5, 1})})
                      .gives(3, 0b100, 0b100) // mips below 0 are of lobes sharper than the cube has
                      .relativeTo(1)
                      .mapped(1, 0));
  return all;
}

} // namespace

std::vector<FunctionCase> specularFunctions() {
  std::vector<FunctionCase> all;
  for (auto piece : {brdfFunctions(), environmentBrdfFunctions(), directFunctions(), tapFunctions()})
    all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

} // namespace parity::stress

// mobile_base_pass, rgbm, refit.
#include "study/stress/table_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::stress {

using namespace parts;

namespace {

Input radianceInput(int at, const char* name) { return powers(at, name, 0, 65504, 0x1p-24, 65504); }

bool isDApprox(double form) { return form < 0.12; } // and PhongApprox in between
// Which of UE4 and refit row[at] chooses; below them karis2014.
bool isUe4(double form) { return form >= 0.33 && form < 0.67; }
bool isRefit(double form) { return form >= 0.67; }
double leastF0(const Row& r, int base, int dielectric, int metallic) {
  double least = 1;
  for (int c = 0; c < 3; ++c)
    least = std::min(least, r[dielectric + c] * (1 - r[metallic]) + r[base + c] * r[metallic]);
  return least;
}

bool isGreenless(const Row& r, int base, int dielectric, int metallic) {
  return r[dielectric + 1] * (1 - r[metallic]) + r[base + 1] * r[metallic] < 0.02;
}
const char* const kGreenless = "A falls to -0.044, and saturate(50 g) removes the B that is larger than it";

FunctionCase shadingModelContext() {
  FunctionCase f = entry("initShadingModelContext", kFnInitShadingModelContext, units(12), kEnvBrdf);
  f.takes(join({rgb(unit(0, "BaseColor")),
                rgb(unit(3, "DielectricSpecular")),
                {unit(6, "Metallic"), unit(7, "Roughness"), unit(8, "NoV"), choice(9, "form", {0, 0.5, 1}),
                 choice(10, "nonmetal", {0, 1}), choice(11, "fullyRough", {0, 1})}}))
      .gives(10, first(10), 0b0111111000)
      .relativeTo(0.04)
      .mapped(7, 8)
      .expect({Fault::negative, kInAll,
               [](const Row& r) { return !isRefit(r[9]) && r[11] < 0.75 && r[7] > 0.7 && leastF0(r, 0, 3, 6) < 0.006; },
               "forms karis2014 and UE4, roughness > 0.7, a channel of F0 < 0.006",
               "B of EnvBRDFApprox falls to -0.0024; UE4's saturate(50 g) uses only green", rowOf({{7, 1}, {8, 1}})})
      .expect({Fault::overUnity, kInAll, [](const Row& r) { return !isRefit(r[9]) && r[7] < 0.09 && r[8] < 0.09; },
               "forms karis2014 and UE4, roughness < 0.09 and NoV < 0.09", "B of EnvBRDFApprox reaches 1.044",
               rowOf({{3, 0.04}, {4, 0.04}, {5, 0.04}})})
      .expect({Fault::negative, kInAll,
               [](const Row& r) {
                 return isUe4(r[9]) && r[11] < 0.75 && r[7] < 0.09 && r[8] < 0.09 && isGreenless(r, 0, 3, 6);
               },
               "form UE4, roughness < 0.09 and NoV < 0.09, green of F0 < 0.02", kGreenless,
               rowOf({{0, 1}, {6, 1}, {9, 0.5}})});
  return f;
}

// Half of the light directions near the mirror direction, where lobes have their peaks.
void putNearMirror(Row& r, double u) {
  const double NoV = r[7] * r[10] + r[8] * r[11] + r[9] * r[12];
  if (NoV < 0 && u < 0.9)
    for (const int at : {10, 11, 12}) r[at] = -r[at];
  if (u > 0.6) return;
  const double cosine = std::fabs(NoV), width = std::exp2(-40 * u);
  double squares = 0;
  for (int c = 0; c < 3; ++c) {
    r[13 + c] = 2 * cosine * r[7 + c] - r[10 + c] + width * r[13 + c];
    squares += r[13 + c] * r[13 + c];
  }
  for (int c = 0; c < 3 && squares > 0; ++c) r[13 + c] /= std::sqrt(squares);
}

// The light is where the view is reflected to, within 6 degrees.
bool isNearMirror(const Row& r) {
  const double NoV = r[7] * r[10] + r[8] * r[11] + r[9] * r[12];
  double RoL = 0;
  for (int c = 0; c < 3; ++c) RoL += (2 * NoV * r[7 + c] - r[10 + c]) * r[13 + c];
  return RoL > 0.995;
}

FunctionCase integrateBxDF() {
  const Row mirror = rowOf({{9, 1}, {12, 1}, {15, 1}, {0, 1}, {1, 1}, {2, 1}, {18, 1}});
  FunctionCase f =
      entry("mobileIntegrateBxDF", kFnMobileIntegrateBxDF, litPoint, {8, 8, 0.25, "exp2; 1 - (S + M) cancels"});
  f.takes(join({rgb(unit(0, "BaseColor")),
                rgb(unit(3, "DielectricSpecular")),
                {unit(6, "Roughness"), wide(direction(7, "N")), wide(direction(10, "V")), wide(direction(13, "L")),
                 choice(16, "preset", {0, 0.25, 0.5, 1}), choice(17, "fullyRough", {0, 1}), unit(18, "Metallic")}}))
      .where([](const Row& r) { return !isUe4(r[16]) || r[6] >= 0.015625; }) // the floor is the preset's
      .settledBy([](Row& r, double u) {
        if (isUe4(r[16])) r[6] = std::max(r[6], 0.015625);
        putNearMirror(r, u);
      })
      .gives(6, first(6))
      .relativeTo(0.04)
      .expect({Fault::notFinite, kIn16,
               [](const Row& r) {
                 return isDApprox(r[16]) && r[17] < 0.75 && (r[6] <= 0.0625 || (r[6] <= 0.17 && isNearMirror(r)));
               },
               "karis2014, roughness <= 0.0625; to 0.17 where R.L rounds to above 1",
               "D_Approx: c = 0.72 / R^4 + 0.4 is infinite in half; and where R.L is 1.001, 2^(c R.L - c) is huge",
               mirror})
      .expect({Fault::notFinite, kIn32 | kIn64,
               [](const Row& r) {
                 return isDApprox(r[16]) && r[17] < 0.75 && (r[6] <= 7.5e-10 || (r[6] <= 0.01 && isNearMirror(r)));
               },
               "karis2014, roughness <= 7.5e-10; to 0.01 where R.L rounds to above 1",
               "D_Approx: 1/R^4 is infinite; and 2^(c R.L - c) where R.L is above 1 by a rounding", mirror})
      .expect(
          {Fault::negative, kInAll,
           [](const Row& r) { return !isRefit(r[16]) && r[17] < 0.75 && r[6] > 0.7 && leastF0(r, 0, 3, 18) < 0.006; },
           "karis2014 and UE4, roughness > 0.7, a channel of F0 < 0.006",
           "B of EnvBRDFApprox falls to -0.0024; UE4's saturate(50 g) uses only green",
           rowOf({{9, 1}, {12, 1}, {15, 1}, {6, 1}})})
      .expect(
          {Fault::negative, kInAll,
           [](const Row& r) {
             const double NoV = r[7] * r[10] + r[8] * r[11] + r[9] * r[12];
             return isUe4(r[16]) && r[17] < 0.75 && r[6] < 0.09 && NoV < 0.09 && isGreenless(r, 0, 3, 18);
           },
           "UE4, roughness < 0.09 and NoV < 0.09, green of F0 < 0.02", kGreenless,
           rowOf(
               {{0, 1}, {18, 1}, {6, 0.015625}, {9, 1}, {10, 1}, {12, 0x1p-10}, {13, -1}, {15, 0x1p-10}, {16, 0.5}})});
  return f;
}

std::vector<FunctionCase> basePassFunctions() {
  return {
      shadingModelContext(),
      entry("reflectionVector", kFnReflectionVector, directions(2))
          .takes({direction(0, "N"), direction(3, "V")})
          .gives(3)
          .relativeTo(1),
      entry("halfVector", kFnHalfVector, directions(3))
          .takes({direction(0, "V"), wide(direction(3, "L")), direction(6, "N")})
          .settledBy([](Row& r, double u) { // V = -L, or nearly
            for (int c = 0; c < 3 && u < 0.25; ++c) r[3 + c] = -r[c];
          })
          .gives(3)
          .relativeTo(1),
      entry("cosineOf", kFnCosineOf, directions(2))
          .takes({direction(0, "N"), wide(direction(3, "L"))})
          .gives(1, 1, 1)
          .relativeTo(1),
      integrateBxDF(),
      entry("lightWith", kFnLightWith, uniforms(10, 0, 100))
          .takes(join({rgb(wide(powers(0, "color", 0, 1e6, 0x1p-30, 1e6))),
                       rgb(radianceInput(3, "Diffuse")),
                       rgb(radianceInput(6, "Specular")),
                       {powers(9, "SpecularScale", 0, 1000, 0x1p-10, 1000)}}))
          .gives(3, first(3))
          .increases("color.r")
          .increases("Specular.r"),
      entry("luminanceUE4", kFnLuminanceUE4, uniforms(3, 0, 100))
          .takes(rgb(radianceInput(0, "c")))
          .gives(1, 1)
          .increases("c.g"),
      entry("captureScale", kFnCaptureScale, units(5))
          .takes({radianceInput(0, "IndirectIrradiance"), wide(powers(1, "averageBrightness", 0, 1e6, 0x1p-30, 1e6)),
                  unit(2, "Roughness"), choice(3, "mode", {0, 0.4, 0.6, 1}), unit(4, "MaterialAO")})
          .gives(1, 1)
          .relativeTo(1) // 1 - s cancels
          .increases("IndirectIrradiance"),
      entry("specularIBL", kFnSpecularIBL, uniforms(4, 0, 300))
          .takes(join({rgb(radianceInput(0, "radiance")), {radianceInput(3, "scale")}}))
          .gives(3, first(3))
          .increases("scale", first(3)),
      entry("modulate", kFnModulate, uniforms(6, 0, 300))
          .takes(join({rgb(radianceInput(0, "a")), rgb(radianceInput(3, "b"))}))
          .gives(3, first(3))
          .sameSwapping("a.r", "b.r"),
      entry("localLightAt", kFnLocalLightAt, localLight)
          .takes(join({rgb(wide(powers(0, "toLight", -1e6, 1e6, 0x1p-20, 1e6))),
                       rgb(wide(powers(3, "candela", 0, 1e6, 0x1p-30, 1e6))),
                       {wide(powers(6, "range", 0, kInf, 0x1p-10, 0x1p20)), choice(7, "isSpot", {0, 1}),
                        wide(direction(8, "direction")), wide(cosine(11, "cosInner")), wide(cosine(12, "cosOuter")),
                        choice(13, "ue4", {1, 0}), wide(powers(14, "exponent", 0, 1000, 0x1p-6, 1000))}}))
          .where([](const Row& r) { return r[11] >= r[12]; })
          .settledBy([](Row& r, double) {
            if (r[11] < r[12]) std::swap(r[11], r[12]);
          })
          .gives(6, 0b111000)
          .relativeTo(1)
          .increases("candela.r", 0b1000),
  };
}

std::vector<FunctionCase> rgbmFunctions() {
  return {
      entry("encodeRgbm", kFnEncodeRgbm, radiance)
          .takes(rgb(wide(powers(0, "radiance", -std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
                                 0x1p-30, 0x1p20))))
          .gives(4, first(4), first(4))
          .promises(Contract::forNumbers),
      entry("decodeRgbm", kFnDecodeRgbm, units(4))
          .takes(join({rgb(unit(0, "rgb")), {unit(3, "a")}}))
          .gives(3, first(3))
          .increases("rgb.r")
          .increases("a", first(3)),
      entry("decodeOfEncodedRgbm", kFnRgbmRoundTrip, radiance)
          .takes(rgb(wide(powers(0, "radiance", 0, std::numeric_limits<float>::max(), 0x1p-30, 0x1p12))))
          .gives(3, first(3))
          .increases("radiance.r")
          .promises(Contract::forNumbers),
  };
}

void putF90AboveF0(Row& r, double) { r[3] = std::max({r[0], r[1], r[2], r[3]}); }

std::vector<FunctionCase> refitFunctions() {
  const std::vector<Input> lightInputs = {unit(0, "Roughness"), wide(unit(1, "NoH")), wide(unit(2, "VoH"))};
  return {
      entry("refitLobe", kFnRefitLobe, units(6), kExp2AtOne)
          .takes(join({rgb(unit(0, "F0")), {unit(3, "F90"), unit(4, "Roughness"), unit(5, "NoV")}}))
          .where([](const Row& r) {
            return r[3] >= std::max({r[0], r[1], r[2]});
          })
          .settledBy(putF90AboveF0)
          .gives(10, first(10), first(10))
          .relativeTo(0.04)
          .mapped(4, 5),
      entry("refitTap", kFnRefitTap, units(2), kMip)
          .takes({unit(0, "Roughness"), unit(1, "NoV")})
          .gives(3)
          .relativeTo(1)
          .mapped(0, 1),
      entry("refitDirection", kFnRefitDirection, directions(2))
          .takes({direction(0, "N"), direction(3, "V"), within(6, "lean", -1, 10)})
          .gives(3)
          .relativeTo(1),
      entry("refitHalfVector", kFnRefitHalfVector, directions(3))
          .takes({wide(direction(0, "V")), wide(direction(3, "L")), wide(direction(6, "N"))})
          .settledBy([](Row& r, double u) {
            for (int c = 0; c < 3 && u < 0.25; ++c) r[3 + c] = -r[c];
          })
          .gives(2, 0b10, 0b11)
          .relativeTo(1),
      entry("refitLight", kFnRefitLight, litLobe)
          .takes(join({lightInputs, rgb(unit(3, "F0")), rgb(unit(9, "multiple")), {unit(12, "NoL"), unit(13, "NoV")}}))
          .gives(3, first(3))
          .increases("NoH", first(3))
          .relativeTo(0x1p-14)
          .mapped(0, 1),
      entry("refitNonmetal", kFnRefitNonmetal, litLobe, kExp2AtOne)
          .takes(join({lightInputs, {unit(12, "NoL"), unit(13, "NoV")}}))
          .gives(3, first(3), 0b101)
          .increases("NoH", 0b10)
          .relativeTo(0x1p-14)
          .mapped(0, 13),
  };
}

std::vector<FunctionCase> shadowFunctions() {
  return {
      entry("mobileShadow", kFnMobileShadow, shadowAndFade)
          .takes({unit(0, "ShadowmapDepth"), unit(1, "SceneDepth"), within(2, "TransitionScale", 0.5, 8),
                  within(3, "Sharpen", 0, 8), unit(4, "FadeFraction"), wide(within(5, "ViewDepth", 0, 4)),
                  wide(within(6, "Far", 0.25, 4)), wide(unit(7, "DistanceFraction"))})
          .gives(3, first(3), first(3))
          .increases("ViewDepth", 0b100)
          .increases("ShadowmapDepth", first(2))
          .decreases("SceneDepth", first(2))
          .relativeTo(1)
          .mapped(0, 1),
  };
}

} // namespace

std::vector<FunctionCase> mobileFunctions() {
  std::vector<FunctionCase> all;
  for (auto piece : {basePassFunctions(), rgbmFunctions(), refitFunctions(), shadowFunctions()})
    all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

} // namespace parity::stress

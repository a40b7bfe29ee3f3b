// real, material, light, mips, sh, fog, target, specular_aa.
#include "study/stress/table_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::stress {

using namespace parts;

namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();

Input anyNumber(int at, const char* name) { return powers(at, name, -kInf, kInf, 0x1p-30, 0x1p20); }
// Radiance, from black to what half still holds.
Input light(int at, const char* name) { return powers(at, name, 0, 65504, 0x1p-24, 65504); }

std::vector<Input> coefficients(int at, int count, bool inSingle) {
  std::vector<Input> inputs;
  for (int k = 0; k < count; ++k) {
    Input input = within(at + k, "", -1000, 1000);
    input.name = "c" + std::to_string(k / 3) + "." + "rgb"[k % 3];
    input.wide = inSingle;
    inputs.push_back(input);
  }
  return inputs;
}

double dotOf(const Row& r) { return std::fabs(r[0] * r[3]) + std::fabs(r[1] * r[4]) + std::fabs(r[2] * r[5]); }

std::vector<Input> attenuationInputs() {
  return {wide(powers(0, "d2", 0, kLargestFloat, 0x1p-40, 0x1p40)), wide(powers(1, "range", 0, kInf, 0x1p-14, 0x1p20))};
}

FunctionCase heightFog() {
  const Agreement fog{12, 1, 1,
                      "exp2 of a product with exp2: an error of the exponent becomes an error of the transmittance"};
  FunctionCase f = entry("heightFogTransmittance", kFnHeightFogTransmittance, fogAndWay, fog);
  f.takes({wide(powers(0, "density", 0, 1000, 0x1p-20, 1000)), wide(powers(1, "heightFalloff", 0, 1000, 0x1p-20, 1000)),
           wide(powers(2, "height", -1e6, 1e6, 0x1p-4, 1e6)), wide(powers(3, "startDistance", 0, 1e6, 0x1p-4, 1e6)),
           wide(unit(4, "maxOpacity")), wide(powers(5, "eyeHeight", -1e6, 1e6, 0x1p-4, 1e6)),
           wide(powers(6, "rise", -1e6, 1e6, 0x1p-4, 1e6)), wide(powers(7, "distance", 0, 1e7, 0x1p-4, 1e7))})
      .where([](const Row& r) { return r[7] >= std::fabs(r[6]); })
      .settledBy([](Row& r, double u) {
        r[7] = std::max(r[7], std::fabs(r[6]));
        // Ways within a few hundred metres, else most are through a wall.
        if (u < 0.5)
          for (const int at : {2, 3, 5, 6, 7}) r[at] *= 1e-4;
      })
      .gives(1, 1, 1)
      .decreases("density", 1, 1)
      .decreases("maxOpacity", 1, 1)
      .relativeTo(1e-3)
      .promises(Contract::forFinite);
  return f;
}

std::vector<FunctionCase> realFunctions() {
  const Agreement transfer{22, 16, 0, "pow as exp2 of a product with log2: up to 22 ulp in wide sweeps"};
  Input anyWide = wide(powers(0, "v", -kInf, kInf, 0x1p-126, 0x1p126));
  anyWide.takesNan = true;
  Input vx = anyWide, vy = anyWide, vz = anyWide;
  vx.name = "v.x", vy.name = "v.y", vz.name = "v.z";
  vy.at = 1, vz.at = 2;
  return {
      entry("saturate", kFnSaturate, uniforms(3, -2, 3))
          .takes(rgb(anyNumber(0, "x")))
          .gives(3, first(3), first(3))
          .increases("x.r")
          .promises(Contract::forNumbers),
      entry("safeNormalize", kFnSafeNormalize, vectorAndFallback)
          .takes({vx, vy, vz, wide(direction(3, "fallback"))})
          .gives(3)
          .relativeTo(1),
      entry("luminance", kFnLuminance, uniforms(3, 0, 100)).takes(rgb(light(0, "c"))).gives(1, 1).increases("c.g"),
      entry("srgbToLinear", kFnSrgbToLinear, units(3), transfer)
          .takes(rgb(unit(0, "s")))
          .gives(3, first(3), first(3))
          .increases("s.r"),
      entry("linearToSrgb", kFnLinearToSrgb, units(3), transfer)
          .takes(rgb(unit(0, "l")))
          .gives(3, first(3), first(3))
          .increases("l.r"),
      entry("decodeOfEncodedSrgb", kFnSrgbRoundTrip, units(3), {44, 32, 0.04, "pow of pow"})
          .takes(rgb(unit(0, "l")))
          .gives(3, first(3), first(3))
          .increases("l.r", 1, 0.04),
      entry("constants", kFnConstants, units(1)).gives(8), // the next two differ between precisions on purpose
      entry("dot3", kFnDot3, uniforms(6, -1, 1))
          .takes(join({rgb(within(0, "a", -1000, 1000)), rgb(within(3, "b", -1000, 1000))}))
          .gives(1)
          .relativeTo(1)
          .expect({Fault::notFinite, kIn16, [](const Row& r) { return dotOf(r) > 65472; }, "sum of |a b| > 65472",
                   "a product or a sum exceeds the largest half; unit vectors stay within 3",
                   rowOf({{0, 1000}, {3, 1000}})}),
      entry("sqr", kFnSqr, uniforms(1, -10, 10))
          .takes({within(0, "x", -10000, 10000)})
          .gives(1, 1)
          .expect({Fault::notFinite, kIn16, [](const Row& r) { return std::fabs(r[0]) >= 255.9; }, "|x| >= 256",
                   "x^2 exceeds the largest half; squared distances are computed in single", rowOf({{0, 256}})}),
      entry("narrow", kFnNarrow, uniforms(1, 0, 65504))
          .takes({wide(powers(0, "x", -65504, kInf, 0x1p-30, 0x1p126))})
          .gives(1)
          .increases("x"),
      entry("dot32", kFnDot32, uniforms(6, -1, 1))
          .takes(join({rgb(wide(within(0, "a", -1000, 1000))), rgb(wide(within(3, "b", -1000, 1000)))}))
          .gives(6)
          .relativeTo(1),
  };
}

std::vector<FunctionCase> materialFunctions() {
  return {
      entry("dielectricSpecular", kFnDielectricSpecular, units(1))
          .takes({unit(0, "Specular")})
          .gives(1, 1, 1)
          .increases("Specular"),
      entry("diffuseColor", kFnDiffuseColor, units(7))
          .takes(join({rgb(unit(0, "BaseColor")), {unit(6, "Metallic")}}))
          .gives(3, first(3), first(3))
          .increases("BaseColor.r", 1, 1)
          .decreases("Metallic", first(3), 1)
          .relativeTo(kCode),
      entry("specularColor", kFnSpecularColor, units(7))
          .takes(join({rgb(unit(0, "DielectricSpecular")), rgb(unit(3, "BaseColor")), {unit(6, "Metallic")}}))
          .gives(3, first(3), first(3))
          .increases("BaseColor.r")
          .increases("DielectricSpecular.r", 1, 1)
          .relativeTo(kCode),
      entry("alphaSquaredOfNormals", kFnAlphaSquaredOfNormals, units(1))
          .takes({unit(0, "length")})
          .gives(1, 1, 1)
          .decreases("length", 1, 1),
      entry("widenRoughness", kFnWidenRoughness, units(2))
          .takes({wide(unit(0, "Roughness")), wide(unit(1, "grown"))})
          .gives(1, 1, 1)
          .increases("Roughness")
          .increases("grown"),
      entry("mipFromRoughness", kFnMipFromRoughness, roughnessNearOne, kMip)
          .takes({unit(0, "Roughness")})
          .gives(1, 1)
          .relativeTo(1)
          .increases("Roughness", 1, 5),
      entry("roughnessFromMip", kFnRoughnessFromMip, uniforms(1, 0, 5), kExp2)
          .takes({within(0, "mip", 0, 5)})
          .gives(1, 1, 1)
          .increases("mip"),
      entry("encodeGamma2", kFnEncodeGamma2, uniforms(3, -0.5, 1.5))
          .takes(rgb(anyNumber(0, "c")))
          .gives(3, first(3), first(3))
          .increases("c.r")
          .promises(Contract::forNumbers),
      entry("saturateToHalf", kFnSaturateToHalf, uniforms(3, -1e5, 1e5))
          .takes(rgb(anyNumber(0, "c")))
          .gives(3)
          .increases("c.r")
          .promises(Contract::forNumbers),
  };
}

std::vector<FunctionCase> lightFunctions() {
  return {
      entry("squareFalloff", kFnSquareFalloff, distanceAndRange)
          .takes(attenuationInputs())
          .gives(1, 1)
          .decreases("d2")
          .increases("range", 1, 0, 0)
          .relativeTo(0x1p-14),
      entry("squareFalloffUE4", kFnSquareFalloffUE4, distanceAndRange)
          .takes(attenuationInputs())
          .gives(1, 1)
          .decreases("d2")
          .increases("range", 1, 0, 0)
          .relativeTo(0x1p-14),
      entry("exponentFalloff", kFnExponentFalloff, distanceRangeAndExponent, kPow)
          .takes(join({attenuationInputs(), {wide(powers(2, "exponent", 0, 1000, 0x1p-6, 1000))}}))
          .where([](const Row& r) { return r[1] > 0 && std::isfinite(r[1]) && r[2] > 0; })
          .settledBy([](Row& r, double u) {
            if (u < 0.5 && std::isfinite(r[1])) r[0] = std::min(r[1] * r[1] * 2 * u, kLargestFloat); // within the range
          })
          .gives(1, 1, 1)
          .decreases("d2", 1, 1)
          .increases("range", 1, 1)
          .relativeTo(1e-3)
          .promises(Contract::forFinite),
      entry("spotAttenuation", kFnSpotAttenuation, spotCosines)
          .takes({cosine(0, "cosAngle"), cosine(1, "cosInner"), cosine(2, "cosOuter")})
          .where([](const Row& r) { return r[1] >= r[2]; })
          .settledBy([](Row& r, double u) {
            if (r[1] < r[2]) std::swap(r[1], r[2]);
            if (u < 0.5) r[0] = r[2] + (r[1] - r[2]) * 2 * u; // between the cones
          })
          .gives(1, 1, 1)
          .increases("cosAngle")
          .relativeTo(1),
      entry("clampContribution65000", kFnClampContribution65000, uniforms(3, 0, 65500))
          .takes(rgb(powers(0, "contribution", 0, kInf, 0x1p-24, 0x1p24)))
          .gives(3, first(3))
          .increases("contribution.r"),
      heightFog(),
  };
}

} // namespace

std::vector<FunctionCase> generalFunctions() {
  std::vector<FunctionCase> all;
  for (auto piece : {realFunctions(), materialFunctions(), lightFunctions()})
    all.insert(all.end(), piece.begin(), piece.end());
  all.push_back(entry("shBasis", kFnShBasis, normalAndCoefficients).takes({direction(0, "n")}).gives(9).relativeTo(1));
  all.push_back(entry("shCosineKernel", kFnShCosineKernel, units(1)).gives(3, first(3)));
  all.push_back(entry("evalIrradianceSH", kFnEvalIrradianceSH, normalAndCoefficients)
                    .takes(join({{direction(0, "n")}, coefficients(3, 27, false)}))
                    .gives(3, first(3))
                    .relativeTo(1000)); // the sizes of what cancels
  for (const bool simple : {true, false})
    all.push_back(entry(simple ? "GetSkySHDiffuseSimple" : "GetSkySHDiffuse",
                        simple ? kFnGetSkySHDiffuseSimple : kFnGetSkySHDiffuse, normalAndCoefficients)
                      .takes(join({{direction(0, "N")}, coefficients(3, simple ? 12 : 27, true)}))
                      .gives(3, first(3))
                      .relativeTo(1000));
  all.push_back(entry("tintedSkyDiffuse", kFnTintedSkyDiffuse, normalAndCoefficients)
                    .takes(join({{direction(0, "N")}, coefficients(3, 20, true)}))
                    .gives(3, first(3))
                    .relativeTo(1e6)); // products of the sizes of what cancels
  all.push_back(entry("packSkySh", kFnPackSkySh, uniforms(28, -1, 1))
                    .takes(join({coefficients(0, 27, false), {choice(27, "coefficients", {0, 1})}}))
                    .gives(9)
                    .relativeTo(1000));
  return all;
}

} // namespace parity::stress

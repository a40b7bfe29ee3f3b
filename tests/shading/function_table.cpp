// Every function of shading/*.glsl with the rows it is tried on (see function_table.h).
#include "shading/function_table.h"

#include <cmath>
#include <limits>

#include "shading/shading.h"

// evaluate.glsl is written in the shared subset; its macros mean what they mean in shading/shading.h.
#define FN inline
#define R(x) real(x)
#define R32(x) real32(x)
namespace parity::tests::at64 {
using namespace parity::shading::f64;
#include "shading/evaluate.glsl"
#include "shading/evaluate_base_pass.glsl"
} // namespace parity::tests::at64
namespace parity::tests::at32 {
using namespace parity::shading::f32;
#include "shading/evaluate.glsl"
#include "shading/evaluate_base_pass.glsl"
} // namespace parity::tests::at32
namespace parity::tests::at16 {
using namespace parity::shading::f16;
#include "shading/evaluate.glsl"
#include "shading/evaluate_base_pass.glsl"
} // namespace parity::tests::at16
#undef FN
#undef R
#undef R32

namespace parity::tests {
namespace {

using Maker = std::function<Row(Random&)>;

double uniform(Random& random, double low, double high) { return low + (high - low) * (random() * 0x1p-32); }

// Often 0 or 1, else in between: the ends are where guards act.
double unit(Random& random) {
  const auto pick = random() % 16;
  return pick == 0 ? 0.0 : pick == 1 ? 1.0 : uniform(random, 0, 1);
}

// The first `count` inputs in [low, high].
Maker uniforms(int count, double low, double high) {
  return [=](Random& random) {
    Row row{};
    for (int i = 0; i < count; ++i) row[i] = uniform(random, low, high);
    return row;
  };
}

// The first `count` inputs in [0, 1], ends included.
Maker units(int count) {
  return [=](Random& random) {
    Row row{};
    for (int i = 0; i < count; ++i) row[i] = unit(random);
    return row;
  };
}

// Roughness in [low, 1], then a cosine in [cosineLow, 1] that is near 1 (within a smooth lobe) half of the time.
Maker lobe(double low, double cosineLow) {
  return [=](Random& random) {
    Row row{};
    row[0] = uniform(random, low, 1);
    const double width = random() % 2 == 0 ? 1 : std::pow(row[0], 4);
    row[1] = std::max(cosineLow, 1 - width * uniform(random, 0, 3));
    return row;
  };
}

// Roughness in [0, 1], within 1e-3 of 1 half of the time, where log2 is least exact.
Row roughnessNearOne(Random& random) {
  Row row{};
  row[0] = random() % 2 == 0 ? unit(random) : uniform(random, 0.999, 1);
  return row;
}

Row normalAndCoefficients(Random& random) {
  Row row{};
  const double z = uniform(random, -1, 1), phi = uniform(random, 0, 6.2831853);
  row[0] = std::sqrt(1 - z * z) * std::cos(phi);
  row[1] = std::sqrt(1 - z * z) * std::sin(phi);
  row[2] = z;
  for (int i = 3; i < 30; ++i) row[i] = uniform(random, -2, 4);
  return row;
}

Row distanceAndRange(Random& random) {
  Row row{};
  row[0] = random() % 16 == 0 ? 0.0 : std::exp2(uniform(random, -20, 15)); // squared distance
  row[1] = random() % 4 == 0 ? 0.0 : std::exp2(uniform(random, -3, 10));
  if (random() % 16 == 0) row[1] = std::numeric_limits<double>::infinity();
  return row;
}

Row spotCosines(Random& random) {
  Row row{};
  row[0] = uniform(random, -1, 1);
  row[2] = uniform(random, -1, 1);
  row[1] = random() % 8 == 0 ? row[2] : uniform(random, row[2], 1); // inner = outer now and then
  if (random() % 2 == 0) row[0] = uniform(random, row[2], row[1]);
  return row;
}

// Vectors of any length that fp32 or, for half, fp16 holds; zero, NaN and infinite ones too.
Row vectorAndFallback(Random& random) {
  Row row{};
  const double length = std::exp2(uniform(random, -13, 15));
  for (int i = 0; i < 3; ++i) row[i] = length * uniform(random, -1, 1);
  const auto pick = random() % 16;
  if (pick == 0) row[0] = row[1] = row[2] = 0;
  if (pick == 1) row[random() % 3] = std::numeric_limits<double>::quiet_NaN();
  if (pick == 2) row[random() % 3] = std::numeric_limits<double>::infinity();
  row[5] = 1;
  return row;
}

void putDirection(Random& random, Row& row, int at) {
  const double z = uniform(random, -1, 1), phi = uniform(random, 0, 6.2831853);
  row[at] = std::sqrt(1 - z * z) * std::cos(phi);
  row[at + 1] = std::sqrt(1 - z * z) * std::sin(phi);
  row[at + 2] = z;
}

// `count` unit vectors, one after the other.
Maker directions(int count) {
  return [=](Random& random) {
    Row row{};
    for (int i = 0; i < count; ++i) putDirection(random, row, 3 * i);
    return row;
  };
}

// Base colour, dielectric F0, roughness, N, V, L, the preset, fully rough, metallic.
Row litPoint(Random& random) {
  Row row{};
  for (int i = 0; i < 6; ++i) row[i] = unit(random);
  row[6] = uniform(random, 0.0626, 1);
  for (const int at : {7, 10, 13}) putDirection(random, row, at);
  for (const int at : {16, 17, 18}) row[at] = unit(random);
  return row;
}

// Roughness and NoH within a lobe, VoH, colours, NoL and NoV.
Row litLobe(Random& random) {
  Row row = lobe(0.015625, 0)(random);
  for (int i = 2; i < 14; ++i) row[i] = unit(random);
  return row;
}

// The way to a light of up to 1e6 candela, its range, axis and cone.
Row localLight(Random& random) {
  Row row{};
  const double distance = std::exp2(uniform(random, -8, 10));
  putDirection(random, row, 0);
  for (int i = 0; i < 3; ++i) row[i] *= distance;
  for (int i = 3; i < 6; ++i) row[i] = std::exp2(uniform(random, -20, 15));
  row[6] = random() % 4 == 0 ? 0.0 : std::exp2(uniform(random, -3, 10));
  row[7] = unit(random);
  putDirection(random, row, 8);
  row[12] = uniform(random, -1, 1);
  row[11] = uniform(random, row[12], 1);
  row[13] = unit(random);
  return row;
}

// Radiance over the whole range of RGBM and beyond, black too.
Row radiance(Random& random) {
  Row row{};
  for (int i = 0; i < 3; ++i) row[i] = random() % 8 == 0 ? 0.0 : std::exp2(uniform(random, -14, 10));
  return row;
}

// Fog from thin to thick, ways from a decimetre to kilometres, up, down and level.
Row fogAndWay(Random& random) {
  Row row{};
  row[0] = random() % 16 == 0 ? 0.0 : std::exp2(uniform(random, -12, 2));
  row[1] = random() % 4 == 0 ? 0.0 : std::exp2(uniform(random, -10, 3));
  row[2] = uniform(random, -50, 50);
  row[3] = random() % 2 == 0 ? 0.0 : uniform(random, 0, 100);
  row[4] = unit(random);
  row[5] = uniform(random, -100, 100);
  row[7] = std::exp2(uniform(random, -4, 12));
  row[6] = row[7] * (random() % 8 == 0 ? 0.0 : uniform(random, -1, 1));
  return row;
}

template <typename Out> Result toResult(const Out& out) {
  Result result;
  for (int i = 0; i < kOutputs; ++i) result[i] = out.y[i];
  return result;
}

} // namespace

std::vector<FunctionCase> functionTable() {
  const Agreement exact{};
  // lavapipe's exp2 is within 2.9 ulp; what is computed from it inherits that.
  const Agreement envBrdf{8, 8, 1.04, "exp2; -1.04 a004 + r.z and 1.04 a004 + r.w cancel"};
  const Agreement dApprox{8, 8, 1e-4, "exp2; its denormals are flushed, which 1/alpha^2 makes visible below 1e-4"};
  const Agreement mip{8, 8, 5, "log2; near roughness 1 it is small beside the 5 it is added to"};
  const Agreement roughness{8, 8, 0, "exp2"};
  const Agreement fog{12, 1, 1, "exp2 of a product with exp2: an error of the exponent is one of the transmittance"};
  const Agreement transfer{22, 16, 0, "pow as exp2 of a product with log2: up to 22 ulp in wide sweeps"};
  return {
      {"D_GGX", kFnD_GGX, units(2), exact},
      {"V_SmithGGXCorrelated", kFnV_SmithGGXCorrelated, units(3), exact},
      {"V_SchlickSmith", kFnV_SchlickSmith, units(3), exact},
      {"F_Schlick", kFnF_Schlick, units(6), exact},
      {"Fd_Lambert", kFnFd_Lambert, units(1), exact},
      {"energyCompensation", kFnEnergyCompensation, uniforms(6, 0.1, 0.5), exact},
      {"EnvBRDFApproxAB", kFnEnvBRDFApproxAB, units(2), envBrdf},
      {"EnvBRDFApprox", kFnEnvBRDFApprox, units(6), envBrdf},
      {"EnvBRDFApproxUE4", kFnEnvBRDFApproxUE4, units(6), envBrdf},
      {"EnvBRDFApproxNonmetal", kFnEnvBRDFApproxNonmetal, units(2), envBrdf},
      {"FullyRough", kFnFullyRough, units(6), exact},
      {"D_Approx", kFnD_Approx, lobe(0.0625, -1), dApprox},
      {"GGX_Mobile", kFnGGX_Mobile, lobe(0.015625, 0), exact},
      {"CalcSpecular", kFnCalcSpecular, lobe(0.015625, 0), exact},
      {"shBasis", kFnShBasis, normalAndCoefficients, exact},
      {"shCosineKernel", kFnShCosineKernel, units(1), exact},
      {"evalIrradianceSH", kFnEvalIrradianceSH, normalAndCoefficients, exact},
      {"squareFalloff", kFnSquareFalloff, distanceAndRange, exact},
      {"squareFalloffUE4", kFnSquareFalloffUE4, distanceAndRange, exact},
      {"spotAttenuation", kFnSpotAttenuation, spotCosines, exact},
      {"clampContribution65000", kFnClampContribution65000, uniforms(3, 0, 65500), exact},
      {"mipFromRoughness", kFnMipFromRoughness, roughnessNearOne, mip},
      {"roughnessFromMip", kFnRoughnessFromMip, uniforms(1, 0, 5), roughness},
      {"dielectricSpecular", kFnDielectricSpecular, units(1), exact},
      {"diffuseColor", kFnDiffuseColor, units(7), exact},
      {"specularColor", kFnSpecularColor, units(7), exact},
      {"saturate", kFnSaturate, uniforms(3, -2, 3), exact},
      {"safeNormalize", kFnSafeNormalize, vectorAndFallback, exact},
      {"luminance", kFnLuminance, uniforms(3, 0, 100), exact},
      {"srgbToLinear", kFnSrgbToLinear, units(3), transfer},
      {"linearToSrgb", kFnLinearToSrgb, units(3), transfer},
      {"constants", kFnConstants, units(1), exact},
      {"dot3", kFnDot3, uniforms(6, -1, 1), exact},
      {"sqr", kFnSqr, uniforms(1, -10, 10), exact},
      {"schlickWeight", kFnSchlickWeight, units(1), exact},
      {"sphericalGaussianWeight", kFnSphericalGaussianWeight, units(1), roughness},
      {"dielectricWeight", kFnDielectricWeight, units(1), exact},
      {"Fresnel's means", kFnFresnelMeans, units(1), exact},
      {"mixFresnel", kFnMixFresnel, units(5), exact},
      {"albedoScaling", kFnAlbedoScaling, uniforms(3, -0.5, 1.5), exact},
      {"fdezAgueraAlbedo", kFnFdezAgueraAlbedo, uniforms(9, 0, 0.5), exact},
      {"kullaContyAlbedo", kFnKullaContyAlbedo, uniforms(5, 0, 1), exact},
      {"kullaContyLobe", kFnKullaContyLobe, units(2), exact},
      {"dominantBlend", kFnDominantBlend, units(1), exact},
      {"stretchedTap", kFnStretchedTap, units(3), mip},
      {"twoTap", kFnTwoTap, units(3), mip},
      {"threeTap", kFnThreeTap, units(3), mip},
      {"alphaSquaredOfNormals", kFnAlphaSquaredOfNormals, units(1), exact},
      {"widenRoughness", kFnWidenRoughness, units(2), exact},
      {"heightFogTransmittance", kFnHeightFogTransmittance, fogAndWay, fog},
      {"encodeGamma2", kFnEncodeGamma2, uniforms(3, -0.5, 1.5), exact},
      {"saturateToHalf", kFnSaturateToHalf, uniforms(3, -1e5, 1e5), exact},
      {"narrow", kFnNarrow, uniforms(1, 0, 65504), exact},
      {"dot32", kFnDot32, uniforms(6, -1, 1), exact},
      {"encodeRgbm", kFnEncodeRgbm, radiance, exact},
      {"decodeRgbm", kFnDecodeRgbm, units(4), exact},
      {"GetSkySHDiffuseSimple", kFnGetSkySHDiffuseSimple, normalAndCoefficients, exact},
      {"GetSkySHDiffuse", kFnGetSkySHDiffuse, normalAndCoefficients, exact},
      {"packSkySh", kFnPackSkySh, uniforms(28, -1, 1), exact},
      {"initShadingModelContext", kFnInitShadingModelContext, units(12), envBrdf},
      {"reflectionVector", kFnReflectionVector, directions(2), exact},
      {"halfVector", kFnHalfVector, directions(3), exact},
      {"cosineOf", kFnCosineOf, directions(2), exact},
      {"mobileIntegrateBxDF", kFnMobileIntegrateBxDF, litPoint, {8, 8, 0.25, "exp2; 1 - (S + M) cancels"}},
      {"lightWith", kFnLightWith, uniforms(10, 0, 100), exact},
      {"luminanceUE4", kFnLuminanceUE4, uniforms(3, 0, 100), exact},
      {"captureScale", kFnCaptureScale, units(5), exact},
      {"specularIBL", kFnSpecularIBL, uniforms(4, 0, 300), exact},
      {"modulate", kFnModulate, uniforms(6, 0, 300), exact},
      {"localLightAt", kFnLocalLightAt, localLight, exact},
      {"refitLobe", kFnRefitLobe, units(6), {8, 8, 1, "exp2"}},
      {"refitTap", kFnRefitTap, units(2), mip},
      {"refitDirection", kFnRefitDirection, directions(2), exact},
      {"refitHalfVector", kFnRefitHalfVector, directions(3), exact},
      {"refitLight", kFnRefitLight, litLobe, exact},
      {"refitNonmetal", kFnRefitNonmetal, litLobe, {8, 8, 1, "exp2"}},
  };
}

Result evaluate64(int id, const Row& row) {
  at64::Inputs inputs;
  for (int i = 0; i < kInputs; ++i) inputs.x[i] = row[i];
  return toResult(id < kFirstOfBasePass ? at64::evaluate(id, inputs) : at64::evaluateBasePass(id, inputs));
}

Result evaluate32(int id, const Row& row) {
  at32::Inputs inputs;
  for (int i = 0; i < kInputs; ++i) inputs.x[i] = static_cast<float>(row[i]);
  return toResult(id < kFirstOfBasePass ? at32::evaluate(id, inputs) : at32::evaluateBasePass(id, inputs));
}

Result evaluate16(int id, const Row& row) {
  at16::Inputs inputs;
  for (int i = 0; i < kInputs; ++i) inputs.x[i] = shading::Half(row[i]);
  return toResult(id < kFirstOfBasePass ? at16::evaluate(id, inputs) : at16::evaluateBasePass(id, inputs));
}

Row roundToHalf(const Row& row) {
  Row rounded;
  for (int i = 0; i < kInputs; ++i) rounded[i] = shading::Half(row[i]);
  return rounded;
}

double ulpDistance(double actual, double expected, double scale, int mantissaBits, int minExponent) {
  if (actual == expected || (std::isnan(actual) && std::isnan(expected))) return 0;
  if (!std::isfinite(actual) || !std::isfinite(expected)) return std::numeric_limits<double>::infinity();
  const double magnitude = std::max(std::fabs(expected), scale);
  const int exponent = magnitude > 0 ? std::max(std::ilogb(magnitude), minExponent) : minExponent;
  return std::fabs(actual - expected) / std::ldexp(1.0, exponent - mantissaBits);
}

} // namespace parity::tests

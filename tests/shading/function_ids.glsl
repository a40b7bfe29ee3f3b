// The functions that the device test runs, by number: for GLSL (a specialization constant picks one) and C++.
#ifndef PARITY_TESTS_FUNCTION_IDS
#define PARITY_TESTS_FUNCTION_IDS

const int kFnD_GGX = 0;
const int kFnV_SmithGGXCorrelated = 1;
const int kFnV_SchlickSmith = 2;
const int kFnF_Schlick = 3;
const int kFnFd_Lambert = 4;
const int kFnEnergyCompensation = 5;
const int kFnEnvBRDFApproxAB = 6;
const int kFnEnvBRDFApprox = 7;
const int kFnEnvBRDFApproxUE4 = 8;
const int kFnEnvBRDFApproxNonmetal = 9;
const int kFnFullyRough = 10;
const int kFnD_Approx = 11;
const int kFnGGX_Mobile = 12;
const int kFnCalcSpecular = 13;
const int kFnShBasis = 14;
const int kFnShCosineKernel = 15;
const int kFnEvalIrradianceSH = 16;
const int kFnSquareFalloff = 17;
const int kFnSquareFalloffUE4 = 18;
const int kFnSpotAttenuation = 19;
const int kFnClampContribution65000 = 20;
const int kFnMipFromRoughness = 21;
const int kFnRoughnessFromMip = 22;
const int kFnDielectricSpecular = 23;
const int kFnDiffuseColor = 24;
const int kFnSpecularColor = 25;
const int kFnSaturate = 26;
const int kFnSafeNormalize = 27;
const int kFnLuminance = 28;
const int kFnSrgbToLinear = 29;
const int kFnLinearToSrgb = 30;
const int kFnConstants = 31;
const int kFnDot3 = 32;
const int kFnSqr = 33;
const int kFnSchlickWeight = 34;
const int kFnSphericalGaussianWeight = 35;
const int kFnDielectricWeight = 36;
const int kFnFresnelMeans = 37;
const int kFnMixFresnel = 38;
const int kFnAlbedoScaling = 39;
const int kFnFdezAgueraAlbedo = 40;
const int kFnKullaContyAlbedo = 41;
const int kFnKullaContyLobe = 42;
const int kFnDominantBlend = 43;
const int kFnStretchedTap = 44;
const int kFnTwoTap = 45;
const int kFnThreeTap = 46;
const int kFnAlphaSquaredOfNormals = 47;
const int kFnWidenRoughness = 48;
const int kFnHeightFogTransmittance = 49;
const int kFnEncodeGamma2 = 50;
const int kFnSaturateToHalf = 51;
// From here to kFunctionCount by evaluate_base_pass.glsl.
const int kFnNarrow = 52;
const int kFirstOfBasePass = 52;
const int kFnDot32 = 53;
const int kFnEncodeRgbm = 54;
const int kFnDecodeRgbm = 55;
const int kFnGetSkySHDiffuseSimple = 56;
const int kFnGetSkySHDiffuse = 57;
const int kFnPackSkySh = 58;
const int kFnInitShadingModelContext = 59;
const int kFnReflectionVector = 60;
const int kFnHalfVector = 61;
const int kFnCosineOf = 62;
const int kFnMobileIntegrateBxDF = 63;
const int kFnLightWith = 64;
const int kFnLuminanceUE4 = 65;
const int kFnCaptureScale = 66;
const int kFnSpecularIBL = 67;
const int kFnModulate = 68;
const int kFnLocalLightAt = 69;
const int kFnRefitLobe = 70;
const int kFnRefitTap = 71;
const int kFnRefitDirection = 72;
const int kFnRefitHalfVector = 73;
const int kFnRefitLight = 74;
const int kFnRefitNonmetal = 75;
const int kFunctionCount = 76;

const int kInputs = 32;  // numbers a row going in
const int kOutputs = 12; // and coming out

#endif

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
// From here to kFunctionCount by evaluate_base_pass.glsl.
const int kFnNarrow = 50;
const int kFirstOfBasePass = 50;
const int kFnDot32 = 51;
const int kFnEncodeRgbm = 52;
const int kFnDecodeRgbm = 53;
const int kFnGetSkySHDiffuseSimple = 54;
const int kFnGetSkySHDiffuse = 55;
const int kFnPackSkySh = 56;
const int kFnInitShadingModelContext = 57;
const int kFnReflectionVector = 58;
const int kFnHalfVector = 59;
const int kFnCosineOf = 60;
const int kFnMobileIntegrateBxDF = 61;
const int kFnLightWith = 62;
const int kFnLuminanceUE4 = 63;
const int kFnCaptureScale = 64;
const int kFnSpecularIBL = 65;
const int kFnModulate = 66;
const int kFnLocalLightAt = 67;
const int kFnRefitLobe = 68;
const int kFnRefitTap = 69;
const int kFnRefitDirection = 70;
const int kFnRefitHalfVector = 71;
const int kFnRefitLight = 72;
const int kFunctionCount = 73;

const int kInputs = 32;  // numbers a row going in
const int kOutputs = 12; // and coming out

#endif

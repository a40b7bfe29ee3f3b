// Presets of the mobile path, and the knobs that they set.
#pragma once

#include <string>
#include <vector>

namespace parity::mobile {

// What the device computes in: half wherever Unreal Engine 4 would (shading/mobile_base_pass.glsl), or the same code in
// fp32.
enum class Precision { fp16, fp32 };

// The environment BRDF: Karis' EnvBRDFApprox, UE4's with AB.y *= saturate(50 g), or our own (shading/refit.glsl), whose
// one read leans off the mirror direction and to which the direct lobe `refit` belongs.
enum class EnvironmentBrdf { karis2014, ue4, refit };

// The lobe of direct light: D_Approx around the reflection vector, CalcSpecular around the half vector, or GGX and
// Smith whole.
enum class DirectLobe { dApprox, calcSpecular, refit };

// How the reflected environment follows the baked light (captureScale of shading/capture.glsl).
enum class CaptureScale { none, full, byRoughness, occlusion };

// How the capture is stored: RGBM in 8 bits, or 16-bit floats.
enum class CaptureEncoding { rgbm, fp16 };

struct Options {
  std::string preset = "ue4-2020"; // the name of the set that the knobs began as
  EnvironmentBrdf environmentBrdf = EnvironmentBrdf::ue4;
  DirectLobe directLobe = DirectLobe::calcSpecular;
  CaptureScale captureScale = CaptureScale::byRoughness;
  CaptureEncoding capture = CaptureEncoding::rgbm;
  int skyCoefficients = 4;          // of the SH irradiance: 4 or 9
  bool localLights = true;          // up to four an object; false: all are baked
  bool spotShadow = false;          // of the one spot light that is the brightest (mobile/light_choice.h)
  float roughnessFloor = 0.015625f; // 0.015625^4 = 2^-24
  Precision precision = Precision::fp16;
};

// "karis2014": the article. EnvBRDFApprox, D_Approx, no local lights, the environment scaled fully by the baked light,
// no roughness floor. "ue4-2020": UE4's base pass. "refit": our own, as close to the high-end path as the cost of
// ue4-2020 allows.
const std::vector<std::string>& presetNames();
// Throws Error (usage) naming the known presets.
Options presetByName(const std::string& name);

// Names as the command line and reports have them, in the order of the enumerators.
const std::vector<std::string>& precisionNames();       // "fp16", "fp32"
const std::vector<std::string>& captureScaleNames();    // "none", "full", "by-roughness", "occlusion"
const std::vector<std::string>& captureEncodingNames(); // "rgbm", "fp16"

} // namespace parity::mobile

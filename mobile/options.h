// Presets of the mobile path, and the knobs that they set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/image/texture_block.h"
#include "gpu/surface/output_target.h"

namespace parity::paths {
class PresetFolder;
}

namespace parity::mobile {

// What the device computes in: half wherever Unreal Engine 4 would (shading/mobile_base_pass.glsl), or the same code in
// fp32.
enum class Precision { fp16, fp32 };

// The environment BRDF: Karis' EnvBRDFApprox, UE4's with AB.y *= saturate(50 g), or our own (shading/refit.glsl), whose
// one read leans off the mirror direction and to which the direct lobe `refit` belongs; or a preset folder's.
enum class EnvironmentBrdf { karis2014, ue4, refit, own };

// The lobe of direct light: D_Approx around the reflection vector, CalcSpecular around the half vector, GGX and Smith
// whole (of EnvironmentBrdf::refit alone), D_Approx as the engine ships it, with a floor and a bound, or a preset
// folder's.
enum class DirectLobe { dApprox, calcSpecular, refit, phongApprox, own };

// How the reflected environment follows the indirect light (captureScale of shading/capture.glsl), besides
// SkyLightColor, which scales every environment that is no scene capture. automatic: as the engine, by what the cube is
// (captureScaleOf).
enum class CaptureScale { automatic, sky, mixing, full, occlusion };

// Of the mixing weight: the roughness where it begins and where it is whole, 0 <= begin < end <= 1; the largest weight,
// above 0, at most kMaxMixingWeight. Unreal Engine 4's defaults.
struct Mixing {
  float begin = 0.1f, end = 0.3f, largest = 10000;
};
inline constexpr float kMaxMixingWeight = 65504; // the largest half

// How the capture is stored: RGBM in 8 bits, which the shader decodes after filtering; in as many bits RGB with a
// shared exponent, which the texture unit decodes before; or 16-bit floats.
enum class CaptureEncoding { rgbm, rgb9e5, fp16 };

// The irradiance of the sky: four or nine SH coefficients a channel (shading/sky_sh.glsl), or nine whose second band
// has one tint for all channels (shading/tinted_sky.glsl).
enum class SkyForm { sh4, sh9, tinted };

// The clear coat: none shows the base alone; a second lobe as Unreal Engine 4's, about the base's normal; or with the
// formulas of EnvironmentBrdf::refit, about its own normal.
enum class CoatForm { none, ue4, refit };

// The sheen: none shows the base alone; or an analytic fit of its albedo, by the sky's diffuse light.
enum class SheenForm { none, fit };

// Anisotropy: none shows a round lobe; or reads of the environment about a bent normal, and lights by the elongated
// lobe (by dApprox and phongApprox: by the round lobe about the bent normal's reflection).
enum class AnisotropyForm { none, bent };

// A thin film: none shows the base alone; or a tint of its specular colour, interference at three wavelengths.
enum class IridescenceForm { none, tint };

// Light that passes through: none shows the base alone, opaque; the picture behind by the share of the light, as
// blended surfaces; one fetch of the environment in the refracted direction; or of thin walls both, the picture tinted
// and fading out with roughness.
enum class TransmissionForm { none, alpha, refracted, mixed };

// Diffuse light that passes through: none, or the other side's by Lambert's lobe.
enum class DiffuseTransmissionForm { none, lambert };

// The lightmap: Unreal Engine 4's low quality, 8 bits a channel; or the high-end path's, 16-bit floats of irradiance
// with its direction.
enum class LightmapForm { lq, hq };

struct Options {
  std::string preset = "ue4-2020"; // the name of the set that the knobs began as; of a folder its path and hash
  std::shared_ptr<const paths::PresetFolder> own = nullptr; // the folder; null: none
  EnvironmentBrdf environmentBrdf = EnvironmentBrdf::ue4;
  DirectLobe directLobe = DirectLobe::calcSpecular;
  CaptureScale captureScale = CaptureScale::automatic;
  Mixing mixing{};
  CaptureEncoding capture = CaptureEncoding::rgbm;
  SkyForm sky = SkyForm::sh4;
  CoatForm coat = CoatForm::ue4;
  SheenForm sheen = SheenForm::none;                   // Unreal Engine 4's mobile renderer has no cloth
  AnisotropyForm anisotropy = AnisotropyForm::none;    // nor brushed metal
  IridescenceForm iridescence = IridescenceForm::none; // nor thin films
  TransmissionForm transmission = TransmissionForm::alpha;
  DiffuseTransmissionForm diffuseTransmission = DiffuseTransmissionForm::none;
  // Unreal Engine's overrides of material quality: every material as fully rough (no specular light, no fetch of the
  // environment, no further lobes), or as a nonmetal (F0 .04).
  bool fullyRough = false, nonmetal = false;
  // Reflections of baked captures are those of the walls of the capture's box, as the high-end path has them.
  bool parallax = false;
  bool localLights = true;          // up to four an object (lightCap); false: all are baked
  bool spotShadow = false;          // of the one spot light that is the brightest (mobile/light_choice.h)
  float spotShadowSharpen = 1;      // about the middle of its soft edge, 1 to 8 (sharpenedShadow)
  float spotShadowFade = 1;         // how much of it is seen, 0 to 1
  bool sunShadow = false;           // of the one sun, by a map of its own, beside the baked one
  float sunShadowDistance = 200;    // metres along the view from which on it is gone
  float sunShadowFade = 0.1f;       // the last share of that over which it goes, 0 to 1
  float roughnessFloor = 0.015625f; // 0.015625^4 = 2^-24
  // What no preset sets.
  Precision precision = Precision::fp16;
  bool lightCap = true;  // false: every local light, however many reach an object
  bool pixelFog = false; // false: interpolated from the vertices
  LightmapForm lightmap = LightmapForm::lq;
  gpu::OutputTarget target = gpu::OutputTarget::rgba16f;  // what its colour is stored in
  base::TextureBlock textures = base::TextureBlock::none; // what its material textures go through
};

// "karis2014": the article. EnvBRDFApprox, D_Approx, no local lights, the environment scaled fully by the baked light,
// no roughness floor. "ue4-2020": UE4's base pass. "refit": our own, as close to the high-end path as the cost of
// ue4-2020 allows.
const std::vector<std::string>& presetNames();
// Throws Error (usage) naming the known presets.
Options presetByName(const std::string& name);
// The options of a preset, and of `rest` what no preset sets.
Options withRest(Options preset, const Options& rest);

// What acts: of `automatic` mixing where the cubes are scene captures, sky where the cube is the environment.
CaptureScale captureScaleOf(const Options& options, bool hasCaptures);

// Names as the command line and reports have them, in the order of the enumerators.
const std::vector<std::string>& environmentBrdfNames();  // "karis2014", "ue4", "refit", "own"
const std::vector<std::string>& directLobeNames();       // "d-approx", "calc-specular", "refit", "phong-approx", "own"
const std::vector<std::string>& precisionNames();        // "fp16", "fp32"
const std::vector<std::string>& captureScaleNames();     // "auto", "sky", "mixing", "full", "occlusion"
const std::vector<std::string>& captureEncodingNames();  // "rgbm", "rgb9e5", "fp16"
const std::vector<std::string>& skyFormNames();          // "4", "9", "tinted"
const std::vector<std::string>& coatFormNames();         // "none", "ue4", "refit"
const std::vector<std::string>& sheenFormNames();        // "none", "fit"
const std::vector<std::string>& anisotropyFormNames();   // "none", "bent"
const std::vector<std::string>& iridescenceFormNames();  // "none", "tint"
const std::vector<std::string>& transmissionFormNames(); // "none", "alpha", "refracted", "mixed"
const std::vector<std::string>& diffuseTransmissionFormNames(); // "none", "lambert"
const std::vector<std::string>& lightmapFormNames();            // "lq", "hq"

} // namespace parity::mobile

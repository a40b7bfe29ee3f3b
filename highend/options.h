// Knobs of the high-end path, plain data.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "highend/env_brdf_lut.h"
#include "lighting/environment/environment_light.h"

namespace parity::paths {
class PresetFolder;
}

namespace parity::highend {

using shading::Compensation;
using shading::DiffuseLobe;

inline constexpr const char* kBuiltInPreset = "standard";

// How the prefiltered environment is read where the view is not along the normal (shading/off_specular.glsl).
enum class OffSpecular {
  none,      // in the mirror direction: N = V = R (Karis 2013)
  dominant,  // in the lobe's dominant direction (Lagarde and de Rousiers 2014)
  stretched, // twice, along the plane of incidence
  twoTaps,   // twice, by two lobes fitted to the true one
  threeTaps, // three times, so too
};

struct Options {
  std::string preset = kBuiltInPreset;                      // or of a folder its path and hash
  std::shared_ptr<const paths::PresetFolder> own = nullptr; // the folder; null: none
  shading::SurfaceModel model{};
  Compensation compensation = Compensation::kullaConty;
  OffSpecular offSpecular = OffSpecular::threeTaps;
  int lutSize = 128; // texels a side of the environment BRDF's table
  // Of lighting::PrefilterOptions.
  int prefilterSamples = lighting::kFinePrefilter.sampleCount, prefilterSize = lighting::kFinePrefilter.faceSize;
};

// Names as the command line and reports have them, in the order of the enumerators.
const std::vector<std::string>& geometryTermNames(); // "height-correlated", "schlick-smith"
const std::vector<std::string>& fresnelNames();      // "schlick", "spherical-gaussian", "dielectric"
const std::vector<std::string>& diffuseNames();      // "balanced", "lambert"
const std::vector<std::string>& compensationNames(); // "none", "turquin", "fdez-aguera", "kulla-conty"
const std::vector<std::string>& offSpecularNames();  // "none", "dominant", "stretched", "two-taps", "three-taps"

} // namespace parity::highend

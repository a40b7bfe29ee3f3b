// What presets of the mobile path are worth: how far their functions are from the truth, what happens at the edges of
// their domains, what they cost, and how scenes look with them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "job/context.h"
#include "job/report_run.h"

namespace parity::presets {

// One function over its domain, in one precision.
struct FunctionStress {
  std::string function; // "environment BRDF"
  bool half = false;
  std::uint64_t points = 0, nan = 0, infinite = 0, negative = 0; // negative: below -0.01 (A and B may be)
  double least = 0, greatest = 0;                                // of what is finite
  std::string firstBad;                                          // the first input that gives NaN or infinity, in words
};

// Absolute error of F0 A + B against the high-end path's table, over roughness and N.V from .05 to 1.
struct EnvBrdfError {
  double F0 = 0;
  bool half = false;
  double max = 0, rms = 0;
};

// The lobe of one light at F0 = 1 against the high-end path's: GGX with the height-correlated Smith term, and what
// scatters more than once (Kulla and Conty 2017). In fp32, over N.V of .1, .25, .5, .75 and 1 and light directions on
// the hemisphere.
struct LobeError {
  double roughness = 0;
  double energy = 0; // light that it reflects, over the truth's: the mean over N.V
  double rms = 0;    // of the difference, over the root mean square of the truth
};

// A scene under an environment, by the high-end path and this preset.
struct SceneFigures {
  std::string environment;
  std::vector<std::pair<std::string, double>> flip;                  // mean FLIP by material, in the scene's order
  double meanFlip = 0;                                               // over materials
  std::uint64_t operations = 0, fp16 = 0, fetches = 0, samplers = 0; // of a pixel of the mobile path, its mean
};

struct PresetStudy {
  std::string preset;                 // as settings have it: "ue4-2020", "./mypreset@0123456789ab"
  std::string base;                   // of a folder
  std::vector<std::string> functions; // that the folder defines
  std::vector<EnvBrdfError> envBrdf;
  std::vector<LobeError> lobe;
  std::vector<FunctionStress> stress;
  std::vector<SceneFigures> scenes;
  std::optional<base::Image8> plot; // its environment BRDF, the table's and the difference
  std::string failure;              // why it could not be studied to the end; empty: it was
};

struct StudyRequest {
  std::vector<std::string> presets;      // names or folders, in order
  std::vector<std::string> environments; // files or builtin:NAME
  std::string scene = "builtin:materials";
  int size = 256;
  bool plots = true;
  job::Settings plain;    // of the run, without any of its knobs
  base::GivenKnobs given; // its knobs, but the preset
};

// A preset that fails is told with its reason, and the next one is studied. Throws Error (usage) for settings that no
// preset can be studied with.
std::vector<PresetStudy> studyPresets(job::Context& context, const StudyRequest& request,
                                      const job::Progress& progress);

// The number of findings: NaN and infinities of functions.
std::uint64_t findingsOf(const PresetStudy& study);

// For a terminal; study.json; and the page, whose pictures lie beside it as plotFile() says.
std::string toText(const std::vector<PresetStudy>& studies);
std::string toJson(const std::vector<PresetStudy>& studies, const StudyRequest& request);
std::string toPage(const std::vector<PresetStudy>& studies, const StudyRequest& request);
std::string plotFile(std::size_t study); // "env-brdf-1.png"

} // namespace parity::presets

// The settings that a sweep tries: each path as it is asked for, and with one knob turned.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/texture_block.h"
#include "gpu/output_target.h"
#include "highend/options.h"
#include "lighting/environment_light.h"
#include "mobile/options.h"

namespace parity::sweep {

// Where a knob costs: device time for every pixel; time once, before the first one; or only bits of what is stored,
// which is not timed here.
enum class Stage { shading, preparation, storage };
// "shading", "preparation", "storage".
const std::vector<std::string>& stageKinds();

struct Variant {
  std::string path;             // "highend", "mobile"
  std::string name = "default"; // what is not as in the path's default
  std::string knob;             // the one that is turned; empty: none, or several
  Stage stage = Stage::shading; // where that knob costs
  std::string needs;            // "environment", "directional light", "local light", "texture"; empty: nothing
  highend::Options highend;
  mobile::Options mobile;
  gpu::OutputTarget target = gpu::OutputTarget::rgba16f;  // of the mobile path
  base::TextureBlock textures = base::TextureBlock::none; // likewise
  int lutSize = 128;                                      // of the high-end path, as the next one
  lighting::PrefilterOptions prefilter = lighting::kFinePrefilter;

  std::string id() const { return path + ": " + name; }
  // Every knob of the path with its value, as the command line names them where it has them.
  std::vector<std::pair<std::string, std::string>> knobs() const;
};

// The defaults of both paths first, in this order; then one knob at a time, and a few sets known from the literature.
// The mobile path: every preset in both precisions, and the knobs of the one asked for.
std::vector<Variant> makeVariants(const highend::Options& highend, const mobile::Options& mobile,
                                  gpu::OutputTarget target, base::TextureBlock textures);

} // namespace parity::sweep

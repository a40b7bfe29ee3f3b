// The files that parity flip writes for a pair: maps and histograms.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/frame.h"
#include "base/image/image.h"
#include "compare/images/flip_run.h"

namespace parity::compare {

struct FlipImages {
  const base::Image& flip;     // of the pair: LDR- or HDR-FLIP; 1 channel, 0 outside the area that was measured
  const base::Image* exposure; // HDR pairs: the exposure map; else null
  const std::vector<base::PixelList>& regions;
};

// A file that a run may write, and the option that asks for it.
struct OutputFile {
  std::string option;
  std::filesystem::path file;
};
std::vector<OutputFile> listFlipFiles(const FlipRequest& request);

// Writes what request.outputs asks for and notes it in result.written. Throws Error (exit 4) where a file cannot be
// written.
void writeFlipFiles(const FlipRequest& request, const FlipImages& images, FlipPair& result);

} // namespace parity::compare

// Which material each pixel of a view shows, as a picture for other programs.
#pragma once

#include <filesystem>
#include <vector>

#include "base/image/image.h"
#include "gpu/surface/material_swap.h"

namespace parity::job {

// Channels: id (1 + the place in the scene of the material that covers most of the pixel; 0: none), coverage (how much
// it does) and seen (how much all materials cover together), the last two from 0 to 1. coverage: a list a material.
base::Image materialIds(const std::vector<base::PixelList>& coverage, int width, int height);

// As an .exr of these channels. Throws Error (exit 4).
void writeMaterialIds(const std::filesystem::path& file, const std::vector<base::PixelList>& coverage, int width,
                      int height);

} // namespace parity::job

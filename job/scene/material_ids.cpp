#include "job/scene/material_ids.h"

#include <algorithm>

#include "base/image/image_io.h"

namespace parity::job {

base::Image materialIds(const std::vector<base::PixelList>& coverage, int width, int height) {
  base::Image ids(width, height, 3);
  for (std::size_t m = 0; m < coverage.size(); ++m)
    for (std::size_t i = 0; i < coverage[m].pixels.size(); ++i) {
      const float weight = coverage[m].weights.empty() ? 1.f : coverage[m].weights[i];
      float* pixel = &ids.pixels[3 * std::size_t{coverage[m].pixels[i]}];
      if (weight > pixel[1]) pixel[0] = static_cast<float>(m + 1), pixel[1] = weight;
      pixel[2] = std::min(pixel[2] + weight, 1.f);
    }
  return ids;
}

void writeMaterialIds(const std::filesystem::path& file, const std::vector<base::PixelList>& coverage, int width,
                      int height) {
  base::WriteOptions options;
  options.channelNames = {"id", "coverage", "seen"};
  base::writeImage(file, materialIds(coverage, width, height), options);
}

} // namespace parity::job

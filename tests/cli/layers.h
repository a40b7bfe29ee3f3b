// The layers of a picture that `parity render --terms` wrote, as base::readImage gives them.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/image/image.h"
#include "shading/terms.h"

namespace parity::tests {

// Over all pixels and three channels.
inline double sumOf(const base::Image& image, int firstChannel) {
  double sum = 0;
  for (std::size_t p = 0; p < image.pixelCount(); ++p)
    for (int c = 0; c < 3; ++c) sum += image.pixels[p * image.channels + static_cast<std::size_t>(firstChannel + c)];
  return sum;
}

// First channel of a term's layer among so many: the file's layers come back sorted by name.
inline int channelOf(shading::Term term, std::size_t terms = shading::kBaseTermCount) {
  std::vector<std::string_view> names(shading::kTermNames.begin(), shading::kTermNames.begin() + terms);
  std::sort(names.begin(), names.end());
  const std::string_view name = shading::kTermNames[static_cast<std::size_t>(term)];
  return 3 * (1 + static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()));
}

} // namespace parity::tests

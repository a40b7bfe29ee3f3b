// JPEGs for tests.
#pragma once

#include <cstddef>
#include <vector>

namespace parity::base {

// A baseline JPEG of coloured noise, which fills its data evenly.
std::vector<std::byte> makeNoisyJpeg(int width, int height);

} // namespace parity::base

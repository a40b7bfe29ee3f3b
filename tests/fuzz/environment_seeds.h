// Small sound environment images in every storage that their readers know: what fuzzing begins with.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace parity::tests {

// By name, "rle.exr". Each loads.
std::map<std::string, std::vector<std::byte>> makeEnvironmentSeeds();

} // namespace parity::tests

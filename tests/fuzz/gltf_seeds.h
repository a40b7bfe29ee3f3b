// Small sound glTF files, one for each thing that the loader reads: what fuzzing begins with.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace parity::tests {

// By name, "draco.glb". Each loads.
std::map<std::string, std::vector<std::byte>> makeGltfSeeds();

} // namespace parity::tests

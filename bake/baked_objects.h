// The objects of a bake as a file holds them: where they lie in the lightmap, and how their texels are scaled.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "bake/baked_light.h"

namespace parity::bake {

// Little-endian, as they are in memory.
std::vector<std::byte> objectBytes(const BakedLight& baked);

// Fills uvs and scales of `baked`, whose pages are read already. captures: that it has. Throws base::Error (exit 4)
// naming the file where it is truncated, or where an object does not fit pages, corners or captures: shaders trust
// them.
void readObjects(const std::filesystem::path& file, std::size_t captures, BakedLight& baked);

} // namespace parity::bake

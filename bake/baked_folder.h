// A folder of baked light: manifest.json, the sources as OpenEXR, and what the paths read.
#pragma once

#include <filesystem>
#include <string>

#include "bake/baked_light.h"

namespace parity::bake {

inline constexpr const char* kManifestFile = "manifest.json";

// Throws base::Error (exit 4) where it cannot be made, and where something is there already that is neither empty nor
// an earlier bake.
void requireBakeFolder(const std::filesystem::path& folder);

// All of it, or nothing: written beside under a temporary name, which then takes the folder's place. Throws Error (exit
// 4).
void writeBaked(const std::filesystem::path& folder, const BakedLight& baked);

// Whether every file that readBaked() reads is there and is what the manifest lists, by size and checksum.
bool isWhole(const std::filesystem::path& folder);

// Throws Error (exit 4) naming the file: no manifest, a foreign or newer one, a file that is missing, truncated or not
// the one that the manifest names. sources are not read.
BakedLight readBaked(const std::filesystem::path& folder);

} // namespace parity::bake

// Which extensions of glTF are read, and which are known not to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "scenes/problems.h"

namespace parity::scenes {

// Adds a problem for each extension that the document requires and we do not read, and a line to `warnings` for those
// that it merely uses. Those of materials that no path models (subsurface scattering and the like) are neither: each
// material says them itself (Material::notModelled).
void checkGltfExtensions(const nlohmann::json& document, Problems& problems, std::vector<std::string>& warnings);

// What a material's extension is called in reports ("subsurface"), if it is one that is not modelled; else empty.
std::string_view notModelledName(std::string_view extension);

} // namespace parity::scenes

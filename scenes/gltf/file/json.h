// The JSON of a glTF file: parsed with limits, and every known property checked for its type.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "scenes/problems.h"

namespace parity::scenes {

// Deepest nesting, and most values, that a glTF's JSON may have: what parses it further on is recursive, and a value
// takes up to fifty times its text.
inline constexpr int kMaxJsonDepth = 64;
inline constexpr std::size_t kMaxJsonValues = std::size_t{1} << 23;

// Parses JSON text. `label` is for messages. Throws Error (exit 4) with line and column, or naming the limit.
nlohmann::json parseGltfJson(std::string_view text, const std::string& label);

// Checks all that scenes/ reads of a glTF 2.0 document (scenes/gltf/file/rules.h): types, array sizes, finite numbers,
// known words and codes, and that every index lies within the array that it refers to. Each problem is told with its
// place, such as "/materials/3/alphaCutoff". Numbers come out normalised: whole floats become integers where an index
// or a count is meant, and the other way round.
void checkGltfSchema(nlohmann::json& document, Problems& problems);

} // namespace parity::scenes

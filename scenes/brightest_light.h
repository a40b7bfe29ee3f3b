// The brightest of a scene's lights of one kind.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scenes/scene.h"

namespace parity::scenes {

// Index of the brightest light of that kind by luminance, of spot lights by luminous intensity (the first among
// equals); nothing where there is none.
std::optional<std::size_t> brightestOf(std::span<const Light> lights, LightKind kind);

} // namespace parity::scenes

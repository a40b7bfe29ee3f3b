// What reports call a scene's lights.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

const char* nameOf(LightKind kind); // "directional", "point", "spot"

// Of each light its own name, else "point light 17" by its place in the list, from 1; unique: a second "lamp" is
// "lamp (2)".
std::vector<std::string> lightNames(std::span<const Light> lights);

} // namespace parity::scenes

// The names of the scenes and environments that the program carries within itself.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

// What stands behind "builtin:" for loadScene and loadEnvironment, in the order that help texts list them.
std::vector<std::string> builtinSceneNames();
std::vector<std::string> builtinEnvironmentNames();

// One built-in scene or environment by its bare name. Deterministic: the same data on every machine. Throws Error (exit
// 4) that names the nearest known one.
Scene makeBuiltinScene(const std::string& name);
Environment makeBuiltinEnvironment(const std::string& name);

} // namespace parity::scenes

// A contract: all that another engine needs to render the very views of a run (docs/own-engine.md), as a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "job/context.h"
#include "job/scene_request.h"
#include "job/settings.h"

namespace parity::job {

inline constexpr int kContractFormat = 1;
inline constexpr const char* kContractFile = "contract.json";

// What writeContract writes for so many scenes, relative to the folder: but the pictures of views.
std::vector<std::string> contractFiles(std::size_t scenes);

// Writes contract.json; of each scene a folder with its environment, and of each view its ids and the first path's
// picture, linear; calibration.glb and calibration.hdr. Built-in scenes, and those of whose file a pose, a variant, a
// scene or the balls of its materials are shown, are written as .glb. Throws Error (usage) where two pictures would
// have one name, Error (exit 4) where a scene cannot be read or a file not be written, and what prepareScene throws.
void writeContract(Context& context, const std::vector<SceneRequest>& scenes, const std::filesystem::path& folder,
                   const Progress& progress);

} // namespace parity::job

// Preset folders that come with the program: to start from, and to learn from.
#pragma once

#include <string>
#include <vector>

#include "paths/preset/preset_folder.h"

namespace parity::paths {

// Their names, in the order of the alphabet: "ue4-2020", "lazarov2013".
std::vector<std::string> presetTemplates(const PresetHost& host);

// Writes a folder that starts as the template of that name. Throws Error: usage for a name that is not known, failed
// where the folder has files already or cannot be written.
void writePresetTemplate(const PresetHost& host, const std::string& name, const std::string& folder);

// The functions that folders of the path may define, for docs/presets.md: a heading, then words and prototype of each.
std::string describeFunctions(const PresetHost& host);

} // namespace parity::paths

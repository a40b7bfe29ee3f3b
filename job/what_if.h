// --what-if: presets of the paths that are compared, which a run measures beside its own settings.
#pragma once

#include <string>
#include <vector>

#include "base/knob/table.h"
#include "job/settings.h"
#include "paths/path.h"

namespace parity::job {

// The path that has this preset; null where none does.
const paths::Path* pathOfPreset(const std::string& preset);

// Presets of all paths.
std::vector<std::string> presetsOfPaths();

// As the knob takes them: names, and lists of names. Throws KnobError for an unknown one, with the nearest name.
void setWhatIfs(Settings& settings, const base::KnobValue& value);

// For the cache's key: the names, and all that each preset sets beside what else was given.
std::string whatIfText(const Settings& settings);
// The value by which they are read again, folders with their content.
std::string pinnedWhatIfs(const Settings& settings);

// Gives each the options that a run with that preset would have: what else was given stays. plain: the settings before
// anything given.
void deriveWhatIfs(Settings& settings, const Settings& plain, const base::GivenKnobs& given);

// Throws Error (usage) where the preset is of no path that is compared with the first, where it does not go together
// with what was given, and where the run's light or textures are not those that it needs.
void requireWhatIfs(const Settings& settings);

} // namespace parity::job

// Every knob of a run in one table: the command line, suite files, reports, cache keys and docs/knobs.md are made of
// it.
#pragma once

#include <vector>

#include "base/knob/table.h"
#include "job/scene_request.h"
#include "job/settings.h"
#include "scenes/suite/suite.h"

namespace parity::job {

const base::KnobTable<Settings>& knobs();

// Those that a suite file may hold.
const scenes::SuiteKnobs& suiteKnobs();

// `settings` with what is given. Throws Error (usage) for a value that is refused, and for what does not go together.
Settings withKnobs(Settings settings, const base::GivenKnobs& given);

// What holds for the scenes of a suite that say nothing else. Each scene is asked by requestsOf
// whether it goes together.
Settings defaultsOf(const base::GivenKnobs& ofSuite, const Settings& settings, const base::GivenKnobs& commandLine);

// The scenes of a suite. What a scene says goes before the command line, the command line before [defaults]. settings:
// of the run, without any of its knobs. Throws Error (failed) with the scene, as withKnobs does.
std::vector<SceneRequest> requestsOf(const scenes::Suite& suite, const Settings& settings,
                                     const base::GivenKnobs& commandLine);

// The given knobs, where each folder is named with the hash of its content. A later reader refuses a folder whose
// content differs. settings: made of them.
base::GivenKnobs withPinnedFolders(base::GivenKnobs given, const Settings& settings);

// Whether the knob does anything with these settings: not where the one that it needs is off.
bool isActive(const base::Knob& knob, const Settings& settings);

} // namespace parity::job

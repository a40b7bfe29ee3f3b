// Scenes that are compared anew although the cache holds their results: the cache hides nondeterminism.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "job/scene/scene_record.h"
#include "job/scene_request.h"

namespace parity::job {

// Of a run: eight, or a hundredth of the scenes where that is more, at most all. Chosen by a hash of the date
// ("2026-11-25") and their names: others each day, the same on every machine. Places, in order.
std::vector<std::size_t> chooseSentinels(const std::vector<SceneRequest>& scenes, const std::string& date);

// Throws Error (exit 4) where a scene came out otherwise than its result in the cache, naming what differs.
void requireSame(const SceneRecord& cached, const SceneRecord& now);

} // namespace parity::job

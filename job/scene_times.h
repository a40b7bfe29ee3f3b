// How long scenes took, kept in the cache for the next run's order and plan.
#pragma once

#include <optional>
#include <vector>

#include "base/cache.h"
#include "job/scene_request.h"

namespace parity::job {

// Seconds from its start to its end, in a run that compared it. Kept by what the scene is (its file and its own knobs,
// how many views), whatever the run was asked for.
void keepSceneTime(const base::Cache& cache, const SceneRequest& request, double seconds);
std::optional<double> findSceneTime(const base::Cache& cache, const SceneRequest& request);

// Of each scene, in their order: what is known, and the median of that for the others. Empty where nothing is known.
struct SceneTimes {
  std::vector<double> seconds;
  std::size_t known = 0;
};
SceneTimes estimateTimes(const base::Cache& cache, const std::vector<SceneRequest>& requests);

} // namespace parity::job

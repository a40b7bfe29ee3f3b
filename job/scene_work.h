// What the scenes of a run will take, before they are loaded: in which order they are begun, and how much the driver
// optimises its shaders. Neither changes the results.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cache.h"
#include "job/scene_request.h"

namespace parity::job {

// The order in which two threads begin scenes: the longest first, so that the last two end together. A scene moves only
// within its block, because messages about a scene wait for those before it. The last block of a run has kScenesInBlock
// scenes, or all there are.
inline constexpr std::size_t kScenesInBlock = 16;
// The places of the scenes of the block that begins at this place. Scenes under one environment stay together, because
// the run has the last environment at hand; environments keep the order of their first scenes. What a scene takes is
// what an earlier run took (scene_times.h). For a scene that is not known it is promisedWork, to the scale of those
// that are.
std::vector<std::size_t> orderOfBlock(const base::Cache& cache, const std::vector<SceneRequest>& scenes,
                                      std::size_t begin);

// About the seconds of a first run, by what a glTF file names: further lobes, lights and textures take longer to
// compile. 1 for any other file, and for one that cannot be read.
double promisedWork(const SceneRequest& scene);

// Of a scene of the whole run on average: all views, and all samples of their pixels.
std::uint64_t samplesOfAScene(const std::vector<SceneRequest>& scenes);

// Up to this many samples a scene, lavapipe's optimisations take longer than they save (docs/benchmarks.md, many
// scenes).
inline constexpr std::uint64_t kQuickCompilationSamples = std::uint64_t{1} << 18;

// Asks for quick compilation (gpu/device/compiler_effort.h) where that pays. Commands call it before they make a
// device.
void chooseCompilerEffort(const std::vector<SceneRequest>& scenes);

} // namespace parity::job

// What the scenes of a run will take, before they are loaded: in which order they are begun, and how much the driver
// optimises its shaders. Neither shows in what comes out.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cache.h"
#include "job/scene_request.h"

namespace parity::job {

// Where scenes are compared two at a time: their places, those first that will take longest, so that the last two end
// together. Only kScenesInOrder neighbours change places: what is said of a scene waits for those before it. Of these,
// scenes under one environment stay together, because the run has the last one at hand; environments keep the order of
// their first scenes. What a scene takes is what an earlier run took (scene_times.h); where none is known, the file's
// text tells (promisedWork).
inline constexpr std::size_t kScenesInOrder = 16;
std::vector<std::size_t> orderOfWork(const base::Cache& cache, const std::vector<SceneRequest>& scenes);

// About the seconds of a first run, by what a glTF file names: further lobes and lights take longer to compile, as do
// textures. 1 for any other file, and for one that cannot be read.
double promisedWork(const SceneRequest& scene);

// Of a scene of the run on average: all views, samples counted.
std::uint64_t samplesOfAScene(const std::vector<SceneRequest>& scenes);

// Up to this many samples a scene, lavapipe's optimisations take longer than they save (docs/benchmarks.md).
inline constexpr std::uint64_t kQuickCompilationSamples = std::uint64_t{1} << 19;

// Before the run's device is made: asks for quick compilation (gpu/device/compiler_effort.h) where that pays.
void chooseCompilerEffort(const std::vector<SceneRequest>& scenes);

} // namespace parity::job

// What a scene's run did and left undone: counters filled where the work is done, and the reason for each that stayed
// 0.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gpu/surface/material_class.h"
#include "report/pass.h"

namespace parity::job {

// Work of one scene, over all its views. What a cache gave counts as done: counts do not depend on it.
struct Work {
  std::uint64_t sunSearches = 0;      // environments searched for suns
  std::uint64_t prefilteredMaps = 0;  // each with its SH
  std::uint64_t brdfTables = 0;       // of the environment BRDF
  std::uint64_t images = 0;           // decoded, given mips and uploaded
  std::uint64_t varianceImages = 0;   // normal maps whose spread was measured
  std::uint64_t compressedImages = 0; // and uploaded
  std::uint64_t surfaceSamples = 0, blendedSamples = 0;
  std::uint64_t backdropSamples = 0;                                // behind surfaces that light passes through
  std::uint64_t fogSamples = 0;                                     // given the fog of their vertices
  std::uint64_t directionalLights = 0, localLights = 0;             // that shaders of all lights loop over
  std::uint64_t lightLists = 0;                                     // of local lights that reach a group of pixels
  std::uint64_t shadowMaps = 0, shadowCasters = 0;                  // drawn, and instances drawn into them
  std::uint64_t lightmapPages = 0, captures = 0;                    // baked, read by the paths
  std::uint64_t lightChoices = 0;                                   // objects for which local lights were chosen
  std::vector<std::pair<std::string, std::uint64_t>> shadedSamples; // by path, in the order of the paths
  std::uint64_t whatIfSamples = 0;                                  // shaded by presets that the run asks about
  std::uint64_t termSamples = 0;                                    // shaded with their terms written, over all paths
  std::uint64_t resolvedSamples = 0, integratedSamples = 0;         // by the truth
  std::uint64_t occluderMeshes = 0;                                 // built for the truth's shadows
  std::uint64_t comparedPixels = 0, comparedWithTruth = 0;
  std::uint64_t lightPictures = 0;                              // with one light less
  std::uint64_t lobePictures = 0;                               // without one lobe of the materials
  std::array<std::uint64_t, gpu::kLobeFeatures.size()> lobes{}; // materials of objects that have each
  std::uint64_t countedShaders = 0;                             // whose costs were counted
};

// Why there was no such work; each is empty where there may have been.
struct NoNeed {
  std::string environment, suns, table, texture, variance, compression, blended, backdrop, fog, directional, local,
      lightLists, shadows, baked, captures, lightChoice, lobe, terms, truth, occluders, droppedLights, droppedLobes,
      costs, whatIfs;
};

// In the order of the work. A count of 0 has a reason.
std::vector<report::PassResult> describePasses(const Work& work, const NoNeed& reasons);
// "textures: 3 images", or "textures: skipped, no material that is seen has one".
std::string lineOf(const report::PassResult& pass);

} // namespace parity::job

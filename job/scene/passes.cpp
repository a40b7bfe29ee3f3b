#include "job/scene/passes.h"

#include <fmt/format.h>

namespace parity::job {

std::vector<report::PassResult> describePasses(const Work& work, const NoNeed& why) {
  std::vector<report::PassResult> passes;
  const auto add = [&](const std::string& name, const char* unit, std::uint64_t count, const std::string& reason) {
    passes.push_back({name, unit, count, count > 0 ? "" : reason.empty() ? "no visible object needs it" : reason});
  };
  add("sun extraction", "environments", work.sunSearches, why.suns);
  add("environment prefilter and SH", "maps", work.prefilteredMaps, why.environment);
  add("environment BRDF table", "tables", work.brdfTables, why.table);
  add("surface", "samples", work.surfaceSamples, "");
  add("blended surface", "samples", work.blendedSamples, why.blended);
  add("backdrop", "samples", work.backdropSamples, why.backdrop);
  add("fog at vertices", "samples", work.fogSamples, why.fog);
  add("textures", "images", work.images, why.texture);
  add("spread of normals", "images", work.varianceImages, why.variance);
  add("texture compression", "images", work.compressedImages, why.compression);
  for (std::size_t i = 0; i < work.lobes.size(); ++i)
    add(gpu::kLobeFeatures[i].name, "materials", work.lobes[i], why.lobe);
  add("directional lights", "lights", work.directionalLights, why.directional);
  add("local lights", "lights", work.localLights, why.local);
  add("culling of local lights", "groups", work.lightLists, why.lightLists);
  add("shadow maps", "maps", work.shadowMaps, why.shadows);
  add("casters of shadows", "instances", work.shadowCasters, why.shadows);
  add("lightmap", "pages", work.lightmapPages, why.baked);
  add("environment captures", "captures", work.captures, why.captures);
  add("choice of local lights", "objects", work.lightChoices, why.lightChoice);
  for (const auto& [path, samples] : work.shadedSamples) add("shade " + path, "samples", samples, "");
  add("shade what-ifs", "samples", work.whatIfSamples, why.whatIfs);
  add("terms", "samples", work.termSamples, why.terms);
  add("truth materials", "samples", work.resolvedSamples, why.truth);
  add("truth integrals", "samples", work.integratedSamples, why.truth);
  add("truth occluders", "meshes", work.occluderMeshes, why.occluders);
  add("compare", "pixels", work.comparedPixels, "");
  add("compare with the truth", "pixels", work.comparedWithTruth, why.truth);
  add("dropped lights", "pictures", work.lightPictures, why.droppedLights);
  add("dropped lobes", "pictures", work.lobePictures, why.droppedLobes);
  add("shader costs", "shaders", work.countedShaders, why.costs);
  return passes;
}

std::string lineOf(const report::PassResult& pass) {
  return pass.count > 0 ? fmt::format("{}: {} {}", pass.name, pass.count, pass.unit)
                        : fmt::format("{}: skipped, {}", pass.name, pass.skipped);
}

} // namespace parity::job

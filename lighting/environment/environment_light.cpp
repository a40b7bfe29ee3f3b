// What both paths share of an environment: resampled, prefiltered and projected once.
#include "lighting/environment/environment_light.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "lighting/environment/bright_texels.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/cube_sampler.h"
#include "lighting/environment/equirect.h"
#include "lighting/environment/irradiance_cube.h"
#include "lighting/environment/irradiance_sh.h"
#include "lighting/environment/lamp_tree.h"
#include "lighting/environment/prefilter.h"
#include "shading/shading.h"

namespace parity::lighting {

int layersOfMip(int mip, PrefilterLevels levels) {
  if (levels == PrefilterLevels::first || mip == shading::f64::kPrefilterRoughestMip) return 1;
  return mip == 0 && levels != PrefilterLevels::fine ? 1 : shading::f64::kPrefilterLayers;
}

int layersOf(const CubeMap& cube, int mip) {
  return static_cast<int>(cube.mips[mip].size() / texelIndex(kCubeFaces, 0, 0, cube.faceSize >> mip));
}

namespace {

// A panorama's lamps, and the base texels without them.
struct SplitCube {
  Lamps lamps;
  std::vector<glm::vec4> rest;
};

// All but the irradiance cube. split: null where the brightest texels are taken instead of lamps.
EnvironmentLight filterCube(std::vector<glm::vec4> texels, const PrefilterOptions& options,
                            const SplitCube* split = nullptr) {
  const int size = options.faceSize;
  assert(size >= kMinFaceSize && size <= kMaxFaceSize && std::has_single_bit(static_cast<unsigned>(size)));
  assert(options.sampleCount >= 1 && options.sampleCount <= kMaxSampleCount &&
         std::has_single_bit(static_cast<unsigned>(options.sampleCount)));
  assert(texels.size() == texelIndex(kCubeFaces, 0, 0, size));
  for (const glm::vec4& texel : texels)
    for (int c = 0; c < 3; ++c)
      if (!(texel[c] >= 0 && std::isfinite(texel[c])))
        throw base::fileError("environment", "cube", "holds a radiance that is negative or not finite");

  EnvironmentLight light;
  CubeMap& cube = light.prefiltered;
  cube.faceSize = size;
  cube.mips.push_back(std::move(texels));
  light.irradianceSh = projectIrradiance(cube.mips[0], size);

  std::vector<glm::vec4> rest = split ? split->rest : cube.mips[0];
  FilterSource source{.bright = split ? BrightTexels() : takeBrightTexels(rest, size),
                      .lamps = split ? &split->lamps.wide : nullptr};
  const CubeSampler sampler(std::move(rest), size);
  source.cube = &sampler;
  for (int mip = 0; mip <= shading::f64::kPrefilterRoughestMip; ++mip) {
    std::vector<glm::vec4>& layers = mip == 0 ? cube.mips[0] : cube.mips.emplace_back();
    const int count = layersOfMip(mip, options.levels);
    layers.reserve(static_cast<std::size_t>(count) * texelIndex(kCubeFaces, 0, 0, size >> mip));
    for (const std::vector<glm::vec4>& level : prefilter(source, mip, mip == 0 ? 1 : 0, count, options)) {
      const std::vector<glm::vec4> fitted = fitBilinear(level, size >> mip);
      layers.insert(layers.end(), fitted.begin(), fitted.end());
    }
  }
  return light;
}

} // namespace

EnvironmentLight makeEnvironmentLight(const scenes::Environment& environment, const PrefilterOptions& options) {
  const Panorama panorama = makePanorama(environment, options.faceSize);
  std::optional<SplitCube> split;
  std::vector<glm::vec4> texels;
  if (options.levels == PrefilterLevels::fine) {
    split.emplace();
    Panorama rest = panorama;
    split->lamps = takeLamps(rest);
    std::tie(texels, split->rest) = resampleEquirect(panorama, rest, options.faceSize);
  } else {
    texels = resampleEquirect(panorama, options.faceSize);
  }
  EnvironmentLight light = filterCube(std::move(texels), options, split ? &*split : nullptr);
  if (split) light.lamps = {pruneLamps(split->lamps.wide, kMaxWideLampLeaves), std::move(split->lamps.compact)};
  if (hasIrradianceCube(options.levels)) light.irradianceCube = makeIrradianceCube(environment);
  return light;
}

EnvironmentLight makeEnvironmentLight(std::vector<glm::vec4> texels, const PrefilterOptions& options) {
  EnvironmentLight light = filterCube(std::move(texels), options);
  if (hasIrradianceCube(options.levels))
    light.irradianceCube = makeIrradianceCube(light.prefiltered.mips[0], options.faceSize);
  return light;
}

} // namespace parity::lighting

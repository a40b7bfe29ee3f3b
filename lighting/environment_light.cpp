// What both paths share of an environment: resampled, prefiltered and projected once.
#include "lighting/environment_light.h"

#include <bit>
#include <cassert>
#include <utility>

#include "lighting/cube_sampler.h"
#include "lighting/equirect.h"
#include "lighting/irradiance_sh.h"
#include "lighting/prefilter.h"
#include "shading/shading.h"

namespace parity::lighting {

EnvironmentLight makeEnvironmentLight(const scenes::Environment& environment, const PrefilterOptions& options) {
  const int size = options.faceSize;
  assert(size >= kMinFaceSize && size <= kMaxFaceSize && std::has_single_bit(static_cast<unsigned>(size)));
  assert(options.sampleCount >= 1 && options.sampleCount <= kMaxSampleCount &&
         std::has_single_bit(static_cast<unsigned>(options.sampleCount)));

  EnvironmentLight light;
  CubeMap& cube = light.prefiltered;
  cube.faceSize = size;
  cube.mips.push_back(resampleEquirect(environment, size));
  light.irradianceSh = projectIrradiance(cube.mips[0], size);

  const CubeSampler source(cube.mips[0], size);
  for (int mip = 1; mip <= shading::f64::kPrefilterRoughestMip; ++mip) {
    const double roughness = shading::f64::roughnessFromMip(mip);
    const auto samples = makeLobeSamples(roughness, samplesOfMip(mip, options.sampleCount), size);
    cube.mips.push_back(prefilterMip(source, samples, size >> mip));
  }
  return light;
}

} // namespace parity::lighting

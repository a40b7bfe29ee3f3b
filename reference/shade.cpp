#include "reference/shade.h"

#include <algorithm>
#include <cassert>
#include <mutex>
#include <numbers>

#include "base/parallel.h"

namespace parity::reference {

namespace {

using shading::Term;

// From everywhere but the lights: the environment and, where light bounces, the other surfaces.
Integral integrateSurroundings(const SurfaceSample& sample, const Lobes& lobes, const glm::dvec3& other,
                               const Inputs& inputs, const Options& options) {
  IntegralOptions ofSky = options.integral;
  if (options.bounces > 0) ofSky.relativeError /= std::numbers::sqrt2;
  Integral sum;
  if (inputs.environment)
    sum = integrateEnvironment(sample, lobes, *inputs.environment, other, ofSky, inputs.visibility);
  if (options.bounces == 0) return sum;
  const Surroundings around{*inputs.visibility, *inputs.surfaces, *inputs.emitters, inputs.environment,
                            inputs.lights,      options.model,    inputs.albedo};
  const Integral bounced = integrateInterreflection(
      sample, lobes, around, options.bounces, other + sum.diffuse + sum.specular, sum.standardError, options.integral);
  sum.diffuse += bounced.diffuse;
  sum.specular += bounced.specular;
  sum.standardError = glm::sqrt(sum.standardError * sum.standardError + bounced.standardError * bounced.standardError);
  sum.samples += bounced.samples;
  return sum;
}

ShadedSample shadeOne(const SurfaceSample& sample, const Inputs& inputs, const Options& options) {
  ShadedSample result;
  const auto term = [&](Term t) -> glm::vec3& { return result.terms[static_cast<std::size_t>(t)]; };
  if (sample.unlit != 0) {
    term(Term::emissive) = sample.baseColor;
    return result;
  }
  const DirectLight direct =
      shadeDirect(sample, inputs.lights, options.model, inputs.albedo, PointVisibility(inputs.visibility, sample));
  term(Term::sunDiffuse) = direct.sunDiffuse;
  term(Term::sunSpecular) = direct.sunSpecular;
  term(Term::localDiffuse) = direct.localDiffuse;
  term(Term::localSpecular) = direct.localSpecular;
  term(Term::emissive) = sample.emissive;
  const double occlusion = sample.occlusion;
  if (!(inputs.environment || options.bounces > 0) || !(occlusion > 0)) return result;

  const glm::dvec3 other =
      direct.sunDiffuse + direct.sunSpecular + direct.localDiffuse + direct.localSpecular + glm::dvec3(sample.emissive);
  const Lobes lobes(sample, options.model, sample.roughness, inputs.albedo);
  const Integral sky = integrateSurroundings(sample, lobes, other / occlusion, inputs, options);
  term(Term::skyDiffuse) = sky.diffuse * occlusion;
  term(Term::skySpecular) = sky.specular * occlusion;
  const glm::dvec3 color = other + (sky.diffuse + sky.specular) * occlusion, error = sky.standardError * occlusion;
  const double worst = std::max({error.x, error.y, error.z}), brightest = std::max({color.x, color.y, color.z});
  result.standardError = static_cast<float>(worst);
  result.relativeError = static_cast<float>(worst > 0 ? worst / brightest : 0);
  result.samples = static_cast<std::uint32_t>(sky.samples);
  return result;
}

} // namespace

std::vector<ShadedSample> shade(std::span<const SurfaceSample> samples, const Inputs& inputs, const Options& options,
                                const Progress& progress) {
  assert(!options.model.needsAlbedo() || inputs.albedo != nullptr);
  constexpr std::size_t kGrain = 16; // points differ in cost by a hundredfold
  std::vector<ShadedSample> shaded(samples.size());
  std::mutex mutex;
  std::size_t done = 0;
  int toldPercent = 0;
  base::parallelFor(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) shaded[i] = shadeOne(samples[i], inputs, options);
    if (!progress) return;
    const std::scoped_lock lock(mutex);
    done += end - begin;
    const int percent = static_cast<int>(100 * done / samples.size());
    if (percent > toldPercent) progress(static_cast<double>(done) / static_cast<double>(samples.size()));
    toldPercent = std::max(toldPercent, percent);
  });
  return shaded;
}

} // namespace parity::reference

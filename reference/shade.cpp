#include "reference/shade.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>

#include "base/parallel.h"
#include "reference/body_light.h"
#include "reference/layers.h"
#include "reference/replicates.h"

namespace parity::reference {

namespace {

using shading::Term;

// What a point or one of its layers sees of the surfaces.
struct Outlook {
  PointVisibility fromHere;
  const lighting::Visibility* visibility = nullptr; // where light bounces
  int bounces = 0;
  bool castsShadows = true; // else surfaces hide nothing from those that it sees
};

// What else is shown, over the layer's weight, and how its channels are shown.
struct Shown {
  glm::dvec3 other{0.0}, besides{0.0}, weight{1.0};
};

// From everywhere but the lights: the environment and, where light bounces, the other surfaces.
Integral integrateSurroundings(const SurfaceSample& sample, const Lobes& lobes, const Outlook& outlook,
                               const Shown& shown, const Inputs& inputs, const Options& options) {
  IntegralOptions ofSky = options.integral;
  if (outlook.bounces > 0) ofSky.relativeError /= std::numbers::sqrt2;
  Integral sum;
  if (inputs.environment)
    sum = integrateEnvironment(sample, lobes, *inputs.environment, shown.other, ofSky, outlook.fromHere, shown.besides,
                               shown.weight);
  if (outlook.bounces == 0) return sum;
  const Surroundings around{*outlook.visibility, *inputs.surfaces, *inputs.emitters, inputs.environment,
                            inputs.lights,       options.model,    inputs.albedo,    outlook.castsShadows};
  const Integral bounced = integrateInterreflection(sample, lobes, around, outlook.fromHere, outlook.bounces,
                                                    shown.other + shown.weight * (sum.diffuse + sum.specular),
                                                    sum.standardError, options.integral, shown.weight);
  sum.diffuse += bounced.diffuse;
  sum.specular += bounced.specular;
  sum.standardError = glm::sqrt(sum.standardError * sum.standardError + bounced.standardError * bounced.standardError);
  sum.samples += bounced.samples;
  return sum;
}

glm::dvec3 sumOf(const DirectLight& light) {
  return light.sunDiffuse + light.sunSpecular + light.localDiffuse + light.localSpecular;
}

void setError(ShadedSample& result, const glm::dvec3& color, const glm::dvec3& error) {
  const double worst = largest(error);
  result.standardError = static_cast<float>(worst);
  result.relativeError = static_cast<float>(worst > 0 ? worst / largest(color) : 0);
}

// A layer that is looked at from behind sees surfaces whether they cast shadows or not; but diffuse light, which is in
// closed form without shadows, does not.
Outlook outlookBehind(const Layer& layer, const Inputs& inputs, const Options& options) {
  const lighting::Visibility* seen = layer.kind == LayerKind::diffuseBehind ? inputs.visibility : inputs.behind;
  return {.fromHere = PointVisibility(seen, layer.sample, passedOverBy(layer)),
          .visibility = seen,
          .bounces = seen && inputs.surfaces ? std::max(options.bounces, 1) : 0,
          .castsShadows = inputs.visibility != nullptr};
}

Integral integrateThroughBody(const Layer& layer, const Lobes& lobes, const Shown& shown, const Inputs& inputs,
                              const Options& options) {
  assert(inputs.bodies);
  std::optional<Surroundings> behind;
  if (inputs.behind)
    behind.emplace(*inputs.behind, *inputs.surfaces, *inputs.emitters, inputs.environment, inputs.lights, options.model,
                   inputs.albedo, inputs.visibility != nullptr);
  const BodySurroundings around{*inputs.bodies, inputs.environment, behind ? &*behind : nullptr,
                                std::max(options.bounces, 1)};
  return integrateBody(layer.sample, lobes, around, shown.other, options.integral, shown.weight);
}

Term termOf(LayerKind kind) {
  if (kind == LayerKind::coat) return Term::coatSpecular;
  return kind == LayerKind::sheen ? Term::sheen : Term::transmission;
}

// Each layer by itself. Of n layers each gets 1/sqrt(n) of the tolerance, which is of the whole colour.
ShadedSample shadeLayers(const SurfaceSample& sample, const Inputs& inputs, const Options& options) {
  ShadedSample result;
  const auto addTo = [&](Term t, const glm::dvec3& light) {
    result.terms[static_cast<std::size_t>(t)] += glm::vec3(light);
  };
  const std::vector<Layer> layers = layersOf(sample, options.model, {inputs.albedo, inputs.sheenAlbedo});
  const PointVisibility fromHere(inputs.visibility, sample);
  glm::dvec3 color = emissionWeight(sample, options.model, inputs.albedo) * glm::dvec3(sample.emissive);
  addTo(Term::emissive, color);
  for (const Layer& layer : layers) {
    if (layer.kind == LayerKind::body) continue;
    const DirectLight direct = shadeDirect(
        layer.sample, inputs.lights, lobesOf(layer, inputs.albedo, kMinLightRoughness),
        isFromBehind(layer.kind) ? PointVisibility(inputs.visibility, layer.sample, passedOverBy(layer)) : fromHere);
    const glm::dvec3& w = layer.weight;
    color += w * sumOf(direct);
    if (layer.kind == LayerKind::base) {
      addTo(Term::sunDiffuse, w * direct.sunDiffuse);
      addTo(Term::sunSpecular, w * direct.sunSpecular);
      addTo(Term::localDiffuse, w * direct.localDiffuse);
      addTo(Term::localSpecular, w * direct.localSpecular);
    } else {
      addTo(termOf(layer.kind), w * sumOf(direct));
    }
  }
  const double occlusion = sample.occlusion;
  if (!(occlusion > 0)) return result;

  Options ofLayer = options;
  ofLayer.integral.relativeError /= std::sqrt(static_cast<double>(layers.size()));
  const Outlook outlook{.fromHere = fromHere, .visibility = inputs.visibility, .bounces = options.bounces};
  glm::dvec3 squares(0);
  for (const Layer& layer : layers) {
    const glm::dvec3 w = layer.weight * occlusion;
    const double most = largest(w);
    const Shown shown{.other = color / most, .besides = color / most, .weight = w / most};
    const Lobes lobes = lobesOf(layer, inputs.albedo);
    const Integral sky =
        layer.kind == LayerKind::body
            ? integrateThroughBody(layer, lobes, shown, inputs, ofLayer)
            : integrateSurroundings(layer.sample, lobes,
                                    isFromBehind(layer.kind) ? outlookBehind(layer, inputs, ofLayer) : outlook, shown,
                                    inputs, ofLayer);
    color += w * (sky.diffuse + sky.specular);
    squares += w * w * sky.standardError * sky.standardError;
    result.samples += static_cast<std::uint32_t>(sky.samples);
    if (layer.kind == LayerKind::base) {
      addTo(Term::skyDiffuse, w * sky.diffuse);
      addTo(Term::skySpecular, w * sky.specular);
    } else {
      addTo(termOf(layer.kind), w * (sky.diffuse + sky.specular));
    }
  }
  setError(result, color, glm::sqrt(squares));
  return result;
}

ShadedSample shadeOne(const SurfaceSample& sample, const Inputs& inputs, const Options& options) {
  ShadedSample result;
  const auto term = [&](Term t) -> glm::vec3& { return result.terms[static_cast<std::size_t>(t)]; };
  if (sample.unlit != 0) {
    term(Term::emissive) = sample.baseColor;
    return result;
  }
  if (hasLayers(sample)) return shadeLayers(sample, inputs, options);
  const PointVisibility fromHere(inputs.visibility, sample);
  const DirectLight direct = shadeDirect(sample, inputs.lights, options.model, inputs.albedo, fromHere);
  term(Term::sunDiffuse) = direct.sunDiffuse;
  term(Term::sunSpecular) = direct.sunSpecular;
  term(Term::localDiffuse) = direct.localDiffuse;
  term(Term::localSpecular) = direct.localSpecular;
  term(Term::emissive) = sample.emissive;
  const double occlusion = sample.occlusion;
  if (!(inputs.environment || options.bounces > 0) || !(occlusion > 0)) return result;

  const glm::dvec3 other = sumOf(direct) + glm::dvec3(sample.emissive);
  const Lobes lobes(sample, options.model, sample.roughness, inputs.albedo);
  const Outlook outlook{.fromHere = fromHere, .visibility = inputs.visibility, .bounces = options.bounces};
  const Integral sky = integrateSurroundings(sample, lobes, outlook, {.other = other / occlusion}, inputs, options);
  term(Term::skyDiffuse) = sky.diffuse * occlusion;
  term(Term::skySpecular) = sky.specular * occlusion;
  setError(result, other + (sky.diffuse + sky.specular) * occlusion, sky.standardError * occlusion);
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

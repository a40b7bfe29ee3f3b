#include "study/preset/function_stress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "mobile/probe.h"
#include "shading/shading.h"

namespace parity::presets {

namespace {

using mobile::ProbeCall;

struct Domain {
  const char* function = "";
  std::size_t results = 1; // components of a result that count
  bool signedResult = false;
  std::vector<ProbeCall> calls;
  std::string (*words)(const ProbeCall&) = nullptr;
};

// From 0 to 1: the ends, what is next to them, and steps between.
std::vector<float> unitSteps(int steps) {
  std::vector<float> values = {0, 1e-7f, 1e-4f, 1e-3f, 0.015625f, 0.999f};
  for (int i = 1; i <= steps; ++i) values.push_back(static_cast<float>(i) / static_cast<float>(steps));
  return values;
}

constexpr std::array<float, 6> kF0 = {0, 0.02f, 0.04f, 0.17f, 0.5f, 1};

ProbeCall callOf(std::uint32_t function) {
  return {.function = function, .F0 = 0.04f, .roughness = 0, .NoV = 1, .x = 0, .y = 0, .z = 0, .unused = 0};
}

std::string brdfWords(const ProbeCall& c) {
  return fmt::format("F0 {:.3g}, roughness {:.3g}, N.V {:.3g}", c.F0, c.roughness, c.NoV);
}

Domain environmentBrdf(std::uint32_t function, const char* name) {
  Domain domain{.function = name, .results = 3, .signedResult = true, .calls = {}, .words = brdfWords};
  for (const float F0 : kF0)
    for (const float roughness : unitSteps(64))
      for (const float NoV : unitSteps(64)) {
        ProbeCall call = callOf(function);
        call.F0 = F0, call.roughness = roughness, call.NoV = NoV;
        domain.calls.push_back(call);
      }
  return domain;
}

// Light directions by cosine and azimuth, those of the mirror among them.
Domain lobe(std::uint32_t function, const char* name) {
  Domain domain{.function = name, .results = 3, .signedResult = false, .calls = {}, .words = [](const ProbeCall& c) {
                  return fmt::format("{}, N.L {:.3g}, azimuth {:.0f} degrees", brdfWords(c), c.x,
                                     c.y * 180 / std::numbers::pi);
                }};
  for (const float F0 : {0.04f, 1.f})
    for (const float roughness : unitSteps(32))
      for (const float NoV : unitSteps(12))
        for (const float NoL : unitSteps(12))
          for (const float azimuth : {0.f, 0.5f, 1.f}) {
            ProbeCall call = callOf(function);
            call.F0 = F0, call.roughness = roughness, call.NoV = NoV, call.x = NoL;
            call.y = azimuth * std::numbers::pi_v<float>;
            domain.calls.push_back(call);
          }
  return domain;
}

Domain falloff() {
  Domain domain{.function = "distance falloff", .calls = {}, .words = [](const ProbeCall& c) {
                  return fmt::format("distance {:.3g} m, range {:.3g} m", c.x, c.y);
                }};
  for (const float range : {0.f, 0.1f, 1.f, 10.f, 1000.f})
    for (int i = 0; i < 48; ++i) { // to 2e4 m
      ProbeCall call = callOf(mobile::kProbeFalloff);
      call.x = 1e-4f * std::pow(1.5f, static_cast<float>(i)), call.y = range;
      domain.calls.push_back(call);
    }
  domain.calls.push_back(callOf(mobile::kProbeFalloff)); // at the light itself
  return domain;
}

Domain cone() {
  Domain domain{.function = "spot cone", .calls = {}, .words = [](const ProbeCall& c) {
                  return fmt::format("cosine {:.4g}, inner {:.4g}, outer {:.4g}", c.x, c.y, c.z);
                }};
  for (const auto& [inner, outer] :
       {std::pair(1.f, 0.7f), std::pair(0.9f, 0.9f), std::pair(1.f, 0.f), std::pair(0.999f, 0.998f)})
    for (int i = -256; i <= 256; ++i) {
      ProbeCall call = callOf(mobile::kProbeCone);
      call.x = static_cast<float>(i) / 256, call.y = inner, call.z = outer;
      domain.calls.push_back(call);
    }
  return domain;
}

Domain mip() {
  Domain domain{.function = "capture mip", .calls = {}, .words = [](const ProbeCall& c) {
                  return fmt::format("roughness {:.3g}", c.roughness);
                }};
  for (const float roughness : unitSteps(256)) {
    ProbeCall call = callOf(mobile::kProbeMip);
    call.roughness = roughness;
    domain.calls.push_back(call);
  }
  return domain;
}

Domain encode() {
  Domain domain{.function = "encode", .results = 3, .calls = {}, .words = [](const ProbeCall& c) {
                  return fmt::format("colour {:.3g}, {:.3g}, {:.3g}", c.x, c.y, c.z);
                }};
  for (int i = 0; i < 112; ++i) { // to 4e4
    ProbeCall call = callOf(mobile::kProbeEncode);
    call.x = 1e-8f * std::pow(1.3f, static_cast<float>(i)), call.y = call.x * 0.5f, call.z = 0;
    domain.calls.push_back(call);
  }
  for (const float value : {0.f, 1.f, 65504.f}) {
    ProbeCall call = callOf(mobile::kProbeEncode);
    call.x = call.y = call.z = value;
    domain.calls.push_back(call);
  }
  return domain;
}

FunctionStress stressOf(const gpu::Device& device, const mobile::Options& options, const Domain& domain) {
  constexpr double kBelowZero = -0.01;
  FunctionStress stress{.function = domain.function,
                        .half = options.precision == mobile::Precision::fp16,
                        .points = domain.calls.size(),
                        .least = std::numeric_limits<double>::infinity(),
                        .greatest = -std::numeric_limits<double>::infinity(),
                        .firstBad = {}};
  const std::vector<glm::vec4> results = mobile::probe(device, options, domain.calls);
  for (std::size_t i = 0; i < results.size(); ++i) {
    bool isNan = false, isInfinite = false, isNegative = false;
    for (std::size_t k = 0; k < domain.results; ++k) {
      const double value = results[i][static_cast<int>(k)];
      isNan |= std::isnan(value);
      isInfinite |= std::isinf(value);
      // Of A, B and their sum the sum alone must not be negative.
      isNegative |= value < kBelowZero && (!domain.signedResult || k == 2);
      if (std::isfinite(value))
        stress.least = std::min(stress.least, value), stress.greatest = std::max(stress.greatest, value);
    }
    stress.nan += isNan, stress.infinite += isInfinite, stress.negative += isNegative;
    if ((isNan || isInfinite) && stress.firstBad.empty()) stress.firstBad = domain.words(domain.calls[i]);
  }
  if (stress.least > stress.greatest) stress.least = stress.greatest = 0;
  return stress;
}

} // namespace

std::vector<FunctionStress> stressFunctions(const gpu::Device& device, const mobile::Options& options) {
  std::vector<FunctionStress> all;
  for (const Domain& domain :
       {environmentBrdf(mobile::kProbeEnvironmentBrdf, "environment BRDF"),
        environmentBrdf(mobile::kProbeNonmetal, "environment BRDF of nonmetals"),
        lobe(mobile::kProbeDirectLobe, "direct lobe"), lobe(mobile::kProbeLocalLobe, "lobe of local lights"), falloff(),
        cone(), mip(), encode()})
    all.push_back(stressOf(device, options, domain));
  return all;
}

std::vector<LobeError> lobeErrors(const gpu::Device& device, const mobile::Options& given,
                                  const paths::EnvBrdf& table) {
  namespace f64 = shading::f64;
  mobile::Options options = given;
  options.precision = mobile::Precision::fp32;
  constexpr std::array<float, 5> kSteps = {0.1f, 0.25f, 0.5f, 0.75f, 1.f};
  constexpr int kCosines = 64, kAzimuths = 64; // cells of equal solid angle
  std::vector<LobeError> errors;
  for (const float roughness : kSteps) {
    double error2 = 0, truth2 = 0;
    LobeError error{.roughness = roughness};
    const auto albedo = [&](double cosine) {
      const paths::EnvBrdf::AB AB = table.at(roughness, cosine);
      return AB.A + AB.B;
    };
    double average = 0;
    for (int i = 0; i < kCosines; ++i) average += 2 * (i + 0.5) / kCosines * albedo((i + 0.5) / kCosines) / kCosines;
    for (const float NoV : kSteps) {
      std::vector<ProbeCall> calls;
      for (int i = 0; i < kCosines; ++i)
        for (int k = 0; k < kAzimuths; ++k) {
          ProbeCall call = callOf(mobile::kProbeDirectLobe);
          call.F0 = 1, call.roughness = roughness, call.NoV = NoV;
          call.x = (static_cast<float>(i) + 0.5f) / kCosines;
          call.y = 2 * std::numbers::pi_v<float> * (static_cast<float>(k) + 0.5f) / kAzimuths;
          calls.push_back(call);
        }
      const std::vector<glm::vec4> results = mobile::probe(device, options, calls);
      double sum = 0, truthSum = 0;
      for (std::size_t i = 0; i < calls.size(); ++i) {
        const double NoL = calls[i].x, sinV = std::sqrt(1 - double(NoV) * NoV), sinL = std::sqrt(1 - NoL * NoL);
        const glm::dvec3 V(sinV, 0, NoV), L(sinL * std::cos(calls[i].y), sinL * std::sin(calls[i].y), NoL);
        const glm::dvec3 H = glm::normalize(V + L);
        const double alpha = double(roughness) * roughness;
        const double once = std::numbers::pi * f64::D_GGX(alpha, std::clamp(H.z, 0.0, 1.0)) *
                            f64::V_SmithGGXCorrelated(alpha, NoV, NoL);
        const double more = (1 - albedo(NoV)) * (1 - albedo(NoL)) / std::max(1 - average, 1e-9);
        const double truth = NoL * (once + more);
        const double value = results[i].x;
        sum += value, truthSum += truth;
        error2 += (value - truth) * (value - truth), truth2 += truth * truth;
      }
      error.energy += sum / truthSum / kSteps.size();
    }
    error.rms = std::sqrt(error2 / truth2);
    errors.push_back(error);
  }
  return errors;
}

} // namespace parity::presets

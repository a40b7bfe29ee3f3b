// The functions of anisotropy and thin films on the device against the same source on the CPU, at equal precision.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shading/shading.h"
#include "shading_shaders/lobes_fp16.comp.h"
#include "shading_shaders/lobes_fp32.comp.h"
#include "study/stress/device_rows.h"
#include "support/device.h"

namespace parity::tests {
namespace {

constexpr std::uint32_t kLobeRows = 16384;
constexpr int kLobeInputs = 12, kLobeValues = 8;
constexpr std::array<const char*, kLobeValues> kLobeNames = {
    "alphaT", "D_GGXAnisotropic", "V_Smith NoL", "projectedAlpha", "V_SchlickSmith NoL", "film.x", "film.y", "film.z"};
using LobeValues = std::array<float, kLobeValues>;

#define PARITY_LOBE_VALUES(space, Real)                                                                                \
  [](const float* x) {                                                                                                 \
    namespace at = shading::space;                                                                                     \
    const Real alphaB(x[0]), alphaT = at::anisotropicAlpha(alphaB, Real(x[1]));                                        \
    const Real ToV(x[2]), BoV(x[3]), NoV(x[4]), ToL(x[5]), BoL(x[6]), NoL(x[7]);                                       \
    const Real alphaV = at::projectedAlpha(alphaT, alphaB, ToV, BoV), F0(x[10]);                                       \
    const auto film = at::thinFilmFresnel(Real(x[8]), Real(x[9]), {F0, F0, F0}, Real(x[11]));                          \
    return LobeValues{float(alphaT),                                                                                   \
                      float(at::D_GGXAnisotropic(alphaT, alphaB, ToL, BoL, NoL)),                                      \
                      float(at::V_SmithGGXAnisotropic(alphaT, alphaB, ToV, BoV, NoV, ToL, BoL, NoL) * NoL),            \
                      float(alphaV),                                                                                   \
                      float(at::V_SchlickSmithAnisotropic(alphaV, alphaT, NoV, NoL) * NoL),                            \
                      float(film.x),                                                                                   \
                      float(film.y),                                                                                   \
                      float(film.z)};                                                                                  \
  }

class LobesOnDevice : public DeviceTest {
protected:
  // As halves: alpha, strength, two directions, index, nm, F0, cosine.
  static std::vector<float> makeInputs() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform;
    const auto any = [&] {
      const float u = uniform(random), kind = uniform(random);
      return kind < 0.05f ? 0 : kind < 0.1f ? 1 : kind < 0.3f ? std::exp2(-10 * u) : u;
    };
    std::vector<float> inputs;
    for (std::uint32_t row = 0; row < kLobeRows; ++row) {
      inputs.insert(inputs.end(), {std::max(any(), 1e-3f), any()});
      for (int k = 0; k < 2; ++k) {
        const float cosine = any(), sine = std::sqrt(1 - cosine * cosine), phi = 6.2832f * uniform(random);
        inputs.insert(inputs.end(), {sine * std::cos(phi), sine * std::sin(phi), cosine});
      }
      inputs.insert(inputs.end(), {1 + 1.5f * any(), 1200 * any(), any(), any()});
    }
    for (float& x : inputs) x = float(shading::Half(x));
    return inputs;
  }

  // limits: of each function, relative to max(|value|, 1e-2).
  template <typename Cpu> void compare(gpu::Spirv shader, const Cpu& cpu, const LobeValues& limits) const {
    const std::vector<float> inputs = makeInputs();
    const std::vector<float> outputs =
        stress::DeviceRows(device(), std::move(shader), 0).run(inputs, kLobeRows, kLobeValues);
    LobeValues worst{};
    for (std::uint32_t row = 0; row < kLobeRows; ++row) {
      const LobeValues expected = cpu(inputs.data() + std::size_t{kLobeInputs} * row);
      for (std::size_t k = 0; k < kLobeValues; ++k) {
        const float actual = outputs[std::size_t{kLobeValues} * row + k];
        ASSERT_TRUE(std::isfinite(actual) && actual >= 0) << kLobeNames[k] << " of row " << row << ": " << actual;
        worst[k] = std::max(worst[k], std::abs(actual - expected[k]) / std::max(std::abs(expected[k]), 1e-2f));
      }
    }
    for (std::size_t k = 0; k < kLobeValues; ++k) {
      std::printf("  %-18s %.1e of its value (limit %.0e)\n", kLobeNames[k], worst[k], limits[k]);
      EXPECT_LE(worst[k], limits[k]) << kLobeNames[k];
    }
  }
};

// All but the film are made of + - * / and sqrt alone; its cosines and powers have their own last places.
TEST_F(LobesOnDevice, AgreesWithTheCpuInFp32) {
  compare(gpu::Spirv(kLobesFp32Comp), PARITY_LOBE_VALUES(f32, float), {0, 2e-6f, 2e-6f, 1e-6f, 0, 2e-4f, 2e-4f, 2e-4f});
}

TEST_F(LobesOnDevice, AgreesWithTheCpuInFp16) {
  if (!device().report().float16) GTEST_SKIP() << device().report().name << " has no shaderFloat16";
  compare(gpu::Spirv(kLobesFp16Comp), PARITY_LOBE_VALUES(f16, shading::Half),
          {0, 5e-3f, 5e-3f, 5e-3f, 0, 0.1f, 0.1f, 0.1f});
}

} // namespace
} // namespace parity::tests

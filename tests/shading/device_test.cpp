// The shading functions on the device against the same source on the CPU, at equal precision (DESIGN 5).
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "shading/device_harness.h"
#include "shading/function_table.h"
#include "shading_shaders/base_pass_fp16.comp.h"
#include "shading_shaders/base_pass_fp32.comp.h"
#include "shading_shaders/functions_fp16.comp.h"
#include "shading_shaders/functions_fp32.comp.h"
#include "shading_shaders/unbound_buffer.comp.h"

namespace parity::tests {
namespace {

constexpr std::uint32_t kRows = 4096;

enum class Precision { fp32, fp16 };

std::span<const std::uint32_t> spirvOf(int function, bool half) {
  if (function < kFirstOfBasePass)
    return half ? std::span<const std::uint32_t>(kFunctionsFp16Comp) : kFunctionsFp32Comp;
  return half ? std::span<const std::uint32_t>(kBasePassFp16Comp) : kBasePassFp32Comp;
}

// Opens the device once for all cases; each case runs every row of one function.
class ShadingOnDevice : public testing::Test {
protected:
  static void SetUpTestSuite() { s_harness = DeviceHarness::open(); }
  static void TearDownTestSuite() { s_harness.reset(); }
  void SetUp() override {
    if (!s_harness) GTEST_SKIP() << "no Vulkan device: install mesa-vulkan-drivers";
  }

  static void compare(Precision precision) {
    const bool half = precision == Precision::fp16;
    int compared = 0;
    for (const FunctionCase& function : functionTable()) {
      Random random(static_cast<std::uint32_t>(function.id) + 1);
      std::vector<Row> rows(kRows);
      std::vector<float> inputs;
      for (Row& row : rows) {
        row = function.makeRow(random);
        if (half) row = roundToHalf(row);
        for (double value : row) inputs.push_back(static_cast<float>(value));
      }
      const std::vector<float> outputs =
          s_harness->run(spirvOf(function.id, half), function.id, inputs, kRows, kOutputs);
      ASSERT_EQ(outputs.size(), std::size_t{kRows} * kOutputs);

      double worst = 0;
      std::uint32_t worstRow = 0;
      int worstOutput = 0;
      for (std::uint32_t r = 0; r < kRows; ++r) {
        const Result expected = half ? evaluate16(function.id, rows[r]) : evaluate32(function.id, rows[r]);
        for (int k = 0; k < kOutputs; ++k) {
          const double distance = ulpDistance(outputs[r * kOutputs + k], expected[k], function.agreement.scale,
                                              half ? kMantissa16 : kMantissa32, half ? kMinExponent16 : kMinExponent32);
          if (distance > worst) {
            worst = distance;
            worstRow = r;
            worstOutput = k;
          }
        }
      }
      const double limit = half ? function.agreement.ulps16 : function.agreement.ulps32;
      const Result expected = half ? evaluate16(function.id, rows[worstRow]) : evaluate32(function.id, rows[worstRow]);
      EXPECT_LE(worst, limit) << function.name << ", " << function.agreement.reason << ": output " << worstOutput
                              << " of (" << rows[worstRow][0] << ", " << rows[worstRow][1] << ", " << rows[worstRow][2]
                              << ", ...) is " << outputs[worstRow * kOutputs + worstOutput] << " on "
                              << s_harness->deviceName() << ", " << expected[worstOutput] << " on the CPU";
      if (worst > 0)
        std::printf("  %-24s %.2f ulp (limit %.0f: %s)\n", function.name, worst, limit, function.agreement.reason);
      ++compared;
    }
    EXPECT_EQ(compared, kFunctionCount);
  }

  static std::unique_ptr<DeviceHarness> s_harness;
};

std::unique_ptr<DeviceHarness> ShadingOnDevice::s_harness;

TEST_F(ShadingOnDevice, agreesWithTheCpuInFp32) { compare(Precision::fp32); }

TEST_F(ShadingOnDevice, agreesWithTheCpuInFp16) {
  if (!s_harness->hasShaderFloat16()) GTEST_SKIP() << s_harness->deviceName() << " has no shaderFloat16";
  compare(Precision::fp16);
}

// The layer listens, and whoever uses the harness hears it: the shader reads a binding that no layout has. A device of
// its own, because a refused pipeline leaves its message behind.
TEST_F(ShadingOnDevice, aValidationMessageFailsTheRun) {
  const std::vector<float> inputs(kInputs, 0.0f);
  EXPECT_THROW(DeviceHarness::open()->run(kUnboundBufferComp, 0, inputs, 1, kOutputs), std::runtime_error);
}

} // namespace
} // namespace parity::tests

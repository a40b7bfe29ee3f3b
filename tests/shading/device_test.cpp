// The shading functions on the device against the same source on the CPU, at equal precision (docs/design.md 5b).
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "shading_shaders/unbound_buffer.comp.h"
#include "study/stress/device_rows.h"
#include "study/stress/function_table.h"
#include "support/device.h"

namespace parity::tests {
namespace {

using namespace stress;

constexpr std::uint32_t kRows = 4096;

// Each case runs every row of one function.
class ShadingOnDevice : public DeviceTest {
protected:
  void compare(Precision precision) const {
    const bool half = precision == Precision::f16;
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
          DeviceRows(device(), functionShader(function.id, half), function.id).run(inputs, kRows, kOutputs);
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
                              << device().report().name << ", " << expected[worstOutput] << " on the CPU";
      if (worst > 0)
        std::printf("  %-24s %.2f ulp (limit %.0f: %s)\n", function.name.c_str(), worst, limit,
                    function.agreement.reason);
      ++compared;
    }
    EXPECT_EQ(compared, kFunctionCount);
  }
};

TEST_F(ShadingOnDevice, AgreesWithTheCpuInFp32) { compare(Precision::f32); }

TEST_F(ShadingOnDevice, AgreesWithTheCpuInFp16) {
  if (!device().report().float16) GTEST_SKIP() << device().report().name << " has no shaderFloat16";
  compare(Precision::f16);
}

// The layer listens, and whoever runs rows hears it: the shader reads a binding that no layout has. A device of its
// own, because a refused pipeline leaves its message behind.
TEST_F(ShadingOnDevice, AValidationMessageFailsTheRun) {
  const gpu::Device other(gpu::DeviceOptions{.name = "", .validation = true});
  EXPECT_THROW(DeviceRows(other, kUnboundBufferComp, 0), base::Error);
}

} // namespace
} // namespace parity::tests

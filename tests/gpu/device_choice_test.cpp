// Which device is taken, among made-up ones.
#include <gtest/gtest.h>

#include "gpu/device/device_choice.h"

namespace parity::gpu {
namespace {

DeviceReport makeReport(const std::string& name, const std::string& kind) {
  DeviceReport report;
  report.name = name;
  report.kind = kind;
  return report;
}

const std::vector<DeviceReport> kDevices = {makeReport("Big GPU 5000", "discrete"), makeReport("SwiftShader", "cpu"),
                                            makeReport("llvmpipe (LLVM 15.0.6, 256 bits)", "cpu")};
const std::vector<std::string> kNoRefusals(3);

TEST(DeviceChoice, IsLavapipeThenAnyOtherSoftwareDeviceNeverHardwareUnasked) {
  EXPECT_EQ(chooseByName(kDevices, kNoRefusals, ""), 2);
  EXPECT_EQ(chooseByName(kDevices, {"", "", "too old"}, ""), 1);
  EXPECT_EQ(chooseByName(kDevices, {"", "too old", "too old"}, ""), -1);
}

TEST(DeviceChoice, TakesPartOfANameInAnyCase) {
  EXPECT_EQ(chooseByName(kDevices, kNoRefusals, "big gpu"), 0);
  EXPECT_EQ(chooseByName(kDevices, kNoRefusals, "SWIFT"), 1);
  EXPECT_EQ(chooseByName(kDevices, kNoRefusals, "radeon"), -1);
  EXPECT_EQ(chooseByName(kDevices, {"too old", "", ""}, "big gpu"), -1)
      << "a refused device is not taken by name either";
}

TEST(DeviceChoice, TakesDigitsAsAnIndexOnly) {
  EXPECT_EQ(chooseByName(kDevices, kNoRefusals, "1"), 1);
  EXPECT_EQ(chooseByName(kDevices, kNoRefusals, "5"), -1) << "although names hold a 5";
}

} // namespace
} // namespace parity::gpu

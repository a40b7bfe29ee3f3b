// Device choice, submission, buffers and images.
#include "support/device.h"

#include "base/expect_error.h"
#include "gpu/device/buffer.h"
#include "gpu/device/image.h"

namespace parity::gpu {
namespace {

using DeviceTest = tests::DeviceTest;

TEST_F(DeviceTest, ListNamesOneTakenDeviceAndAReasonForEach) {
  const auto reports = listDevices({});
  int taken = 0;
  for (const DeviceReport& report : reports) {
    taken += report.taken;
    EXPECT_FALSE(report.reason.empty()) << report.name;
  }
  EXPECT_EQ(taken, 1);
}

TEST_F(DeviceTest, UnknownNameIsAnErrorWithTheReasonsOfRefusal) {
  base::expectError([] { const Device device({.name = "no such device", .validation = false}); },
                    {"no such device", listDevices({}).front().name});
}

TEST_F(DeviceTest, ValidationMessageBecomesAnErrorAtSubmit) {
  // A copy beyond the end of the target is what the layer is for.
  const Buffer from(device(), 256), to(device(), 64);
  EXPECT_THROW(device().submit("bad copy",
                               [&](const vk::raii::CommandBuffer& commands) {
                                 commands.copyBuffer(from.handle(), to.handle(), vk::BufferCopy(0, 0, 256));
                               }),
               base::Error);
}

TEST_F(DeviceTest, BufferGivesBackWhatWasPutIn) {
  std::vector<std::uint32_t> values(1000);
  for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = i * i;
  const Buffer buffer(device(), std::span<const std::uint32_t>(values));
  EXPECT_EQ(buffer.downloadAs<std::uint32_t>(values.size()), values);
  EXPECT_EQ(buffer.downloadAs<std::uint32_t>(1, 40)[0], 100u);
}

TEST_F(DeviceTest, SubmitMeasuresDeviceTime) {
  base::Timings timings;
  Device timed({.name = "", .validation = true});
  timed.setTimings(&timings);
  const Buffer buffer(timed, 1 << 20);
  timed.submit("fill", [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(buffer.handle(), 0, VK_WHOLE_SIZE, 7);
  });
  ASSERT_EQ(timings.stages().size(), 1u);
  EXPECT_EQ(timings.stages()[0].first, "device: fill");
  EXPECT_GE(timings.stages()[0].second, 0);
}

} // namespace
} // namespace parity::gpu

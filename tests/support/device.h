// The Vulkan device of the GPU tests: under the validation layers, each of whose messages fails the test. The software
// device, unless the environment variable PARITY_TEST_DEVICE names another.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "base/error.h"
#include "gpu/device/device.h"
#include "gpu/device/pipeline.h"

namespace parity::tests {

// A test that needs a device derives from this; without one it is skipped, visibly.
class DeviceTest : public testing::Test {
protected:
  void SetUp() override {
    if (gpu::listDevices({}).empty()) GTEST_SKIP() << "no Vulkan device";
    const char* name = std::getenv("PARITY_TEST_DEVICE");
    m_device = std::make_unique<gpu::Device>(gpu::DeviceOptions{.name = name ? name : "", .validation = true});
  }
  void TearDown() override {
    if (m_device) {
      EXPECT_NO_THROW(m_device->checkValidation());
    }
  }
  const gpu::Device& device() const { return *m_device; }
  // For all renderers of the test: what one has compiled serves the others.
  gpu::PipelineStore& pipelines() { return m_pipelines; }

private:
  std::unique_ptr<gpu::Device> m_device;
  gpu::PipelineStore m_pipelines;
};

} // namespace parity::tests

// Device times of what a study measures, apart from the run's own.
#pragma once

#include "base/stopwatch.h"
#include "gpu/device/device.h"

namespace parity::sweep {

// While it lives, the device's times go to other timings than usual.
class DeviceTimings {
public:
  DeviceTimings(gpu::Device& device, base::Timings& timings, base::Timings& usual) : m_device(device), m_usual(usual) {
    m_device.setTimings(&timings);
  }
  ~DeviceTimings() { m_device.setTimings(&m_usual); }
  DeviceTimings(const DeviceTimings&) = delete;
  DeviceTimings& operator=(const DeviceTimings&) = delete;

private:
  gpu::Device& m_device;
  base::Timings& m_usual;
};

} // namespace parity::sweep

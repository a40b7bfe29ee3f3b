// What the scenes of a run share: device, cache, display transform, timings.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "base/cache.h"
#include "base/color.h"
#include "base/image.h"
#include "base/stopwatch.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "job/settings.h"
#include "lighting/environment_light.h"

namespace parity::job {

// Made once a run; what it holds is made on first use.
class Context {
public:
  explicit Context(const Settings& settings);

  const Settings& settings() const { return m_settings; }
  base::Timings& timings() { return m_timings; }
  const base::DisplayTransform& display() const { return m_display; }

  // Created on first use, within the stage "device". Throws Error (exit 4).
  gpu::Device& device();
  // The shaders that the run has compiled for it.
  gpu::PipelineStore& pipelines() { return m_pipelines; }
  // What that device is, without making it: for a run whose results may all be cached.
  const gpu::DeviceReport& deviceReport();

  // The environment BRDF table of the settings' geometry term and Fresnel curve, made on first use or read from the
  // cache.
  const base::Image& envBrdfLut();

  // For results that are too large, or too particular, to be held here. The build id of the running binary belongs in
  // every key: what an older build has cached is not used. It covers the module of the image files. Empty where the
  // cache is disabled.
  const base::Cache& cache() const { return m_cache; }
  const std::string& buildId() const { return m_buildId; }

  // Prefiltered cube and SH of an environment, from the cache where it holds them; the last one of the run is at hand.
  // Thread-safe.
  std::shared_ptr<const lighting::EnvironmentLight> environmentLight(const scenes::Environment& environment);

private:
  Settings m_settings;
  base::Timings m_timings;
  base::DisplayTransform m_display;
  base::Cache m_cache;
  std::string m_buildId;
  std::unique_ptr<gpu::Device> m_device;
  gpu::PipelineStore m_pipelines; // ends before the device
  std::optional<gpu::DeviceReport> m_deviceReport;
  base::Image m_lut;
  std::mutex m_lightsMutex;
  std::deque<std::pair<std::string, std::shared_ptr<const lighting::EnvironmentLight>>> m_lights; // the latest first
};

} // namespace parity::job

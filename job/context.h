// What the scenes of a run share: device, cache, display transform, timings.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/background.h"
#include "base/cache.h"
#include "base/image/color.h"
#include "base/stopwatch.h"
#include "gpu/device/device.h"
#include "gpu/device/pipeline.h"
#include "job/settings.h"
#include "lighting/environment/environment_light.h"
#include "paths/path.h"

namespace parity::job {

// Of the running binary and of its module of the image files: a hash.
std::string hashOfThisBuild();

// Made once a run; what it holds is made on first use.
class Context {
public:
  explicit Context(const Settings& settings);
  // The same run's, with a device and timings of its own: scenes may be rendered at the same time.
  struct ForAnotherThread {};
  Context(const Context& first, ForAnotherThread);
  // Adds what another thread's has timed and compiled.
  void take(const Context& other);

  // isStopped: gives the number of the signal that tells the run to stop, 0 as long as there is none. Thread-safe.
  void stopWhen(std::function<int()> isStopped) { m_isStopped = std::move(isStopped); }
  int stoppedBy() const { return m_isStopped ? m_isStopped() : 0; }
  // Between pieces of work: throws Stopped once the run is told to stop.
  void requireGoesOn() const;

  // Of scenes that say nothing else.
  const Settings& settings() const { return m_settings; }
  base::Timings& timings() { return m_timings; }
  const base::DisplayTransform& display() const { return m_display; }

  // Created on first use, within the stage "device". Throws Error (exit 4).
  gpu::Device& device();
  // The shaders that the run has compiled for it.
  gpu::PipelineStore& pipelines() { return m_pipelines; }
  // The same without the pipelines, and those of contexts that were taken in.
  std::set<gpu::PipelineStore::Key> compiledShaders() const;
  // What that device is, without making it: for a run whose results may all be cached.
  const gpu::DeviceReport& deviceReport();

  // What paths take of the run.
  paths::Services services() { return {&m_timings, m_cache, m_buildId, m_store}; }

  // For results that are too large, or too particular, to be held here. The build id of the running binary belongs in
  // every key: what an older build has cached is not used. It covers the module of the image files. Empty where the
  // cache is disabled.
  const base::Cache& cache() const { return m_cache; }
  const std::string& buildId() const { return m_buildId; }
  // How this machine rounds (job/numerics.h); made on first use. Throws Error (exit 4).
  const std::string& numerics();
  // Begins to make it in the background, by a device of its own, once `after` returns. With one thread it does nothing.
  // What `after` refers to must outlive this.
  void beginNumerics(std::function<void()> after);

  // The environment of a file as it is now, with the warnings that reading it gave; the last one that the run has read
  // is at hand, known by its content. Thread-safe. Throws Error as scenes::loadEnvironment does.
  struct LoadedEnvironment {
    std::string key; // of name and content
    float rotationDeg = 0;
    scenes::Environment environment;
    std::vector<std::string> warnings;
  };
  std::shared_ptr<const LoadedEnvironment> environment(const std::string& file, float rotationDeg,
                                                       const scenes::LoadOptions& limits = {});

  // What a path reads of an environment, from the cache where it holds it; the last ones of the run are at hand.
  // Thread-safe.
  std::shared_ptr<const lighting::EnvironmentLight> environmentLight(const scenes::Environment& environment,
                                                                     const lighting::PrefilterOptions& options);

private:
  Settings m_settings;
  std::function<int()> m_isStopped; // empty: nothing stops it
  base::Timings m_timings;
  base::DisplayTransform m_display;
  base::Cache m_cache;
  std::string m_buildId, m_numerics;
  std::unique_ptr<gpu::Device> m_device;
  gpu::PipelineStore m_pipelines; // ends before the device
  std::optional<gpu::DeviceReport> m_deviceReport;
  paths::Store m_store;
  std::set<gpu::PipelineStore::Key> m_takenShaders;
  struct Lights { // of all contexts of a run
    std::mutex loadMutex;
    std::shared_ptr<const LoadedEnvironment> loaded;
    std::mutex mutex;
    std::deque<std::pair<std::string, std::shared_ptr<const lighting::EnvironmentLight>>> latest; // the first is
    std::vector<base::Background<bool>> stores; // into the cache; the destructor waits for them
  };
  std::shared_ptr<Lights> m_lights = std::make_shared<Lights>();
  std::shared_ptr<Context> m_ofNumerics; // in the background
  // Until numerics() takes it. Ends before all else, because what it waits for uses this context.
  base::Background<std::string> m_pendingNumerics;
};

} // namespace parity::job

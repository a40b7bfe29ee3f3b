#include "job/context.h"

#include <filesystem>
#include <fstream>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/image/image_io.h"
#include "base/log.h"
#include "base/member_count.h"
#include "job/numerics.h"
#include "job/stopped.h"
#include "scenes/load.h"

namespace parity::job {

namespace {

// In pieces: glibc's allocator learns from the largest buffer that is freed. After one of 17 MB it would keep textures
// of 2048 x 2048 in its heap instead of giving their memory back.
void addFile(base::Hasher& hasher, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 20);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
    hasher.add(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(in.gcount()))));
  if (!in.eof()) throw base::fileError(file.string(), "", "cannot be read");
}

} // namespace

std::string hashOfThisBuild() {
  static const std::string kHash = [] { // tens of megabytes: once
    base::Hasher hasher;
    addFile(hasher, "/proc/self/exe");
    if (const auto module = base::imageModuleFile(); !module.empty()) addFile(hasher, module);
    return hasher.hex();
  }();
  return kHash;
}

Context::Context(const Settings& settings)
    : m_settings(settings), m_display(settings.display),
      m_cache(settings.cacheFolder ? base::Cache(*settings.cacheFolder, settings.cacheBytes) : base::Cache::disabled()),
      m_buildId(settings.cacheFolder ? base::Hasher().add(hashOfThisBuild()).add(hostNumerics()).hex()
                                     : std::string()) {
  base::logDetail(m_cache.enabled() ? fmt::format("cache: {}", m_cache.folder().string()) : "cache: off");
}

Context::Context(const Context& first, ForAnotherThread)
    : m_settings(first.m_settings), m_isStopped(first.m_isStopped), m_display(first.m_settings.display),
      m_cache(first.m_cache), m_buildId(first.m_buildId), m_numerics(first.m_numerics),
      m_deviceReport(first.m_deviceReport), m_lights(first.m_lights) {}

void Context::take(const Context& other) {
  for (const auto& [stage, timeMs] : other.m_timings.stages()) m_timings.add(stage, timeMs);
  m_takenShaders.merge(other.compiledShaders());
}

void Context::requireGoesOn() const {
  if (const int signal = stoppedBy(); signal != 0) throw Stopped{signal};
}

std::set<gpu::PipelineStore::Key> Context::compiledShaders() const {
  std::set<gpu::PipelineStore::Key> keys = m_pipelines.keys();
  keys.insert(m_takenShaders.begin(), m_takenShaders.end());
  return keys;
}

gpu::Device& Context::device() {
  if (!m_device) {
    const base::Stopwatch watch(&m_timings, "device");
    m_device = std::make_unique<gpu::Device>(m_settings.device);
    m_device->setTimings(&m_timings);
  }
  return *m_device;
}

const std::string& Context::numerics() {
  if (m_numerics.empty()) {
    const base::Stopwatch watch(&m_timings, "numerics");
    if (const auto pending = std::exchange(m_pendingNumerics, {}); pending.isValid()) {
      m_numerics = pending.get();
      take(*m_ofNumerics);
      m_ofNumerics.reset();
    } else {
      m_numerics = numericsId(*this);
    }
  }
  return m_numerics;
}

void Context::beginNumerics(std::function<void()> after) {
  if (!m_numerics.empty() || m_pendingNumerics.isValid() || base::threadCount() == 1) return;
  m_ofNumerics = std::make_shared<Context>(*this, ForAnotherThread{});
  m_pendingNumerics =
      base::Background<std::string>::begin([after = std::move(after), context = m_ofNumerics]() mutable {
        std::exchange(after, {})(); // with what it holds
        hashOfThisBuild();          // the run's record will ask for it, too
        return numericsId(*context);
      });
}

const gpu::DeviceReport& Context::deviceReport() {
  if (m_device) return m_device->report();
  if (!m_deviceReport) {
    const base::Stopwatch watch(&m_timings, "device");
    m_deviceReport = gpu::findDevice(m_settings.device);
  }
  return *m_deviceReport;
}

std::shared_ptr<const Context::LoadedEnvironment> Context::environment(const std::string& file, float rotationDeg,
                                                                       const scenes::LoadOptions& limits) {
  const base::Stopwatch watch(&m_timings, "load environment");
  const std::lock_guard lock(m_lights->loadMutex);
  base::Hasher hasher;
  hasher.add(file).addValue(limits.maxImageSide).addValue(limits.maxMemoryBytes); // within which it was accepted
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) hasher.add(base::readFile(file));
  const std::string key = hasher.hex();
  std::shared_ptr<const LoadedEnvironment>& last = m_lights->loaded;
  if (!last || last->key != key || last->rotationDeg != rotationDeg) {
    auto loaded = std::make_shared<LoadedEnvironment>(LoadedEnvironment{key, rotationDeg, {}, {}});
    loaded->environment = scenes::loadEnvironment(file, rotationDeg, loaded->warnings, limits);
    last = std::move(loaded);
  }
  return last;
}

// Not in the key: the environment's name.
static_assert(base::memberCount<lighting::PrefilterOptions>() == 4 && base::memberCount<scenes::Environment>() == 3,
              "a new member goes into the key, or is named here with the reason why not");

std::shared_ptr<const lighting::EnvironmentLight> Context::environmentLight(const scenes::Environment& environment,
                                                                            const lighting::PrefilterOptions& options) {
  const base::Stopwatch watch(&m_timings, "environment");
  // A scene has two at most, each path's; two scenes are lit at the same time.
  constexpr std::size_t kKept = 4;
  const std::string key = "environment-" + base::Hasher()
                                               .add(m_buildId)
                                               .addValue(options.faceSize)
                                               .addValue(options.sampleCount)
                                               .addValue(options.footprintLog2)
                                               .addValue(options.levels)
                                               .addValue(environment.rotationDeg)
                                               .addValue(environment.radiance.width)
                                               .addValue(environment.radiance.height)
                                               .add(std::as_bytes(std::span{environment.radiance.pixels}))
                                               .hex();
  const std::lock_guard lock(m_lights->mutex); // prefiltering takes all cores: one at a time
  for (const auto& [known, light] : m_lights->latest)
    if (known == key) return light;
  std::shared_ptr<const lighting::EnvironmentLight> light;
  if (const auto cached = m_cache.find(key)) {
    light = std::make_shared<const lighting::EnvironmentLight>(lighting::environmentLightFromBytes(*cached));
  } else {
    light = std::make_shared<const lighting::EnvironmentLight>(lighting::makeEnvironmentLight(environment, options));
    if (m_cache.enabled()) { // tens of megabytes are written while others read the light
      const auto stored = base::Background<bool>::begin([cache = m_cache, key, light]() mutable {
        return cache.store(key, lighting::toBytes(*std::exchange(light, {})));
      });
      if (stored.isIdle()) stored.wait(); // one thread: now
      std::erase_if(m_lights->stores, [](const auto& each) { return each.isIdle(); });
      m_lights->stores.push_back(stored);
    }
  }
  m_lights->latest.emplace_front(key, light);
  if (m_lights->latest.size() > kKept) m_lights->latest.pop_back();
  return light;
}

} // namespace parity::job

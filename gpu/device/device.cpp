#include "gpu/device/device.h"

#include <dlfcn.h>

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "gpu/device/buffer.h"
#include "gpu/device/device_choice.h"

namespace parity::gpu {

using base::Error;
using base::ExitCode;

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kInstallDriver =
    "install a driver: 'apt-get install mesa-vulkan-drivers' installs the software device";

Error deviceError(std::string place, std::string reason) {
  return Error(ExitCode::failed, "Vulkan", std::move(place), std::move(reason));
}

vk::raii::Context makeContext() {
  try {
    // Keeps the loader mapped from its first use on: devices of two threads would else open it anew at the same time.
    static const vk::DynamicLoader loader;
    return vk::raii::Context();
  } catch (const std::exception&) {
    throw deviceError("loader", "libvulkan.so.1 is not installed: 'apt-get install libvulkan1 mesa-vulkan-drivers'");
  }
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validation) {
  const vk::ApplicationInfo application("parity", 1, nullptr, 0, VK_API_VERSION_1_3);
  std::vector<const char*> layers, extensions;
  if (validation) {
    const auto known = context.enumerateInstanceLayerProperties();
    if (std::none_of(known.begin(), known.end(),
                     [](const auto& layer) { return std::string_view(layer.layerName.data()) == kValidationLayer; }))
      throw deviceError(kValidationLayer, "not installed: 'apt-get install vulkan-validationlayers'");
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  const vk::ValidationFeatureEnableEXT synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features(synchronization);
  vk::InstanceCreateInfo info({}, &application, layers, extensions);
  if (validation) info.setPNext(&features);
  try {
    return vk::raii::Instance(context, info);
  } catch (const vk::IncompatibleDriverError&) {
    throw deviceError("instance", fmt::format("no driver was found; {}", kInstallDriver));
  }
}

// Keeps the drivers mapped: an instance that is destroyed unloads them, and the device's own would load them again.
const vk::raii::Instance& lastingInstance(bool validation) {
  static const vk::raii::Context context = makeContext();
  if (validation) {
    static const vk::raii::Instance instance = makeInstance(context, true);
    return instance;
  }
  static const vk::raii::Instance instance = makeInstance(context, false);
  return instance;
}

// Throws Error with the reasons of every refusal.
DeviceChoice requireChoice(const std::vector<vk::raii::PhysicalDevice>& devices, const DeviceOptions& options) {
  DeviceChoice choice = chooseDevice(devices, options);
  if (choice.taken >= 0) return choice;
  std::string reasons;
  for (const DeviceReport& report : choice.reports) reasons += fmt::format("; {}: {}", report.name, report.reason);
  const std::string wanted =
      options.name.empty() ? "no software device" : fmt::format("no device named '{}'", options.name);
  throw deviceError("device", wanted + reasons + (options.name.empty() ? fmt::format("; {}", kInstallDriver) : ""));
}

// Held while a device or its instance is made or goes. The driver frees a handle before the validation layer forgets
// it. In between another thread may get the same handle, which the layer then forgets.
std::mutex& mutexOfHandles() {
  static std::mutex mutex;
  return mutex;
}

} // namespace

struct Device::Messages {
  std::mutex mutex;
  std::vector<std::string> lines;

  static VkBool32 receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto* self = static_cast<Messages*>(user);
    std::lock_guard lock(self->mutex);
    self->lines.emplace_back(data->pMessage);
    return VK_FALSE;
  }
};

std::vector<DeviceReport> listDevices(const DeviceOptions& options) {
  const vk::raii::Context context = makeContext();
  const std::uint32_t loader = context.enumerateInstanceVersion();
  base::logDetail(fmt::format("Vulkan loader {}.{}.{}", VK_API_VERSION_MAJOR(loader), VK_API_VERSION_MINOR(loader),
                              VK_API_VERSION_PATCH(loader)));
  for (const vk::LayerProperties& layer : context.enumerateInstanceLayerProperties())
    base::logDetail(fmt::format("layer {}", layer.layerName.data()));
  try {
    const vk::raii::Instance instance = makeInstance(context, false);
    return chooseDevice(instance.enumeratePhysicalDevices(), options).reports;
  } catch (const Error&) {
    return {}; // a loader without a driver: no device
  }
}

DeviceReport findDevice(const DeviceOptions& options) {
  const vk::raii::Instance& instance = lastingInstance(options.validation);
  const DeviceChoice choice = requireChoice(instance.enumeratePhysicalDevices(), options);
  for (const DeviceReport& each : choice.reports)
    base::logDetail(fmt::format("device: {}: {}", each.description(), each.reason));
  return choice.reports[static_cast<std::size_t>(choice.taken)];
}

Device::Device(const DeviceOptions& options) : m_context(makeContext()), m_messages(std::make_unique<Messages>()) {
  {
    const std::lock_guard lock(mutexOfHandles());
    m_instance = makeInstance(m_context, options.validation);
  }
  if (options.validation) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    m_messenger = vk::raii::DebugUtilsMessengerEXT(
        m_instance, vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                                         Type::eGeneral | Type::eValidation | Type::ePerformance,
                                                         &Messages::receive, m_messages.get()));
  }

  std::vector<vk::raii::PhysicalDevice> devices = m_instance.enumeratePhysicalDevices();
  const DeviceChoice choice = requireChoice(devices, options);
  m_physical = std::move(devices[choice.taken]);
  m_report = choice.reports[choice.taken];
  m_properties = m_physical.getProperties();
  m_memory = m_physical.getMemoryProperties();
  constexpr auto unified = vk::MemoryPropertyFlagBits::eDeviceLocal | vk::MemoryPropertyFlagBits::eHostVisible |
                           vk::MemoryPropertyFlagBits::eHostCoherent | vk::MemoryPropertyFlagBits::eHostCached;
  for (std::uint32_t i = 0; i < m_memory.memoryTypeCount; ++i)
    m_unifiedMemory |= (m_memory.memoryTypes[i].propertyFlags & unified) == unified;

  m_queueFamily = *graphicsQueueFamily(m_physical);
  m_timestampBits = m_physical.getQueueFamilyProperties()[m_queueFamily].timestampValidBits;
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, m_queueFamily, 1, &priority);
  vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                     vk::PhysicalDeviceVulkan13Features>
      info;
  info.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue);
  info.get<vk::PhysicalDeviceFeatures2>().features.geometryShader = true; // gl_PrimitiveID in fragment shaders
  info.get<vk::PhysicalDeviceFeatures2>().features.imageCubeArray = true; // the prefiltered environment
  m_accessesByPairs =
      m_properties.deviceType == vk::PhysicalDeviceType::eCpu && m_physical.getFeatures().shaderInt64 == VK_TRUE;
  info.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 = m_accessesByPairs;
  info.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering = true;
  info.get<vk::PhysicalDeviceVulkan13Features>().synchronization2 = true;
  info.get<vk::PhysicalDeviceVulkan13Features>().maintenance4 = true; // a vertex output that no fragment shader reads
  info.get<vk::PhysicalDeviceVulkan12Features>().shaderFloat16 = m_report.float16;
  {
    const std::lock_guard lock(mutexOfHandles());
    m_device = vk::raii::Device(m_physical, info.get<vk::DeviceCreateInfo>());
  }
  // A device's memory that is the host's goes back to the host at once.
  constexpr vk::DeviceSize kMostKept = vk::DeviceSize{1} << 30;
  m_memoryStore = std::make_unique<MemoryStore>(m_device, m_unifiedMemory ? 0 : kMostKept);
  m_queue = m_device.getQueue(m_queueFamily, 0);
  m_commandPool =
      vk::raii::CommandPool(m_device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient |
                                                                    vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                                m_queueFamily));
  m_commands = vk::raii::CommandBuffers(
      m_device, vk::CommandBufferAllocateInfo(*m_commandPool, vk::CommandBufferLevel::ePrimary, 1));
  m_fence = vk::raii::Fence(m_device, vk::FenceCreateInfo());
  if (m_timestampBits > 0)
    m_queries = vk::raii::QueryPool(m_device, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2));
  // Keeps the driver mapped for the life of the process: leak and thread checkers need its symbols after the instance
  // has gone.
  for (const char* driver : {"libvulkan_lvp.so", "libvk_swiftshader.so"})
    dlopen(driver, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
  base::logDetail(fmt::format("device: opened {}, Vulkan {}, {}{}", m_report.description(), m_report.apiVersion,
                              m_report.float16 ? "fp16" : "no fp16", options.validation ? ", with validation" : ""));
}

// What lives in the device goes first; only then the lock is needed.
Device::~Device() {
  m_staging.reset();
  m_fence = nullptr;
  m_commands.clear();
  m_queries = nullptr;
  m_commandPool = nullptr;
  m_memoryStore.reset();
  const std::lock_guard lock(mutexOfHandles());
  m_device = nullptr;
  m_messenger = nullptr;
  m_instance = nullptr;
}

std::string DeviceReport::description() const { return fmt::format("{} ({})", name, driver); }

const HostBuffer& Device::staging(vk::DeviceSize size) const {
  constexpr vk::DeviceSize kLeast = vk::DeviceSize{1} << 20;
  if (!m_staging || m_staging->size() < size) {
    m_staging.reset();
    m_staging = std::make_unique<HostBuffer>(*this, std::max(size, kLeast));
  }
  return *m_staging;
}

bool Device::filtersLinearly(vk::Format format) const {
  return static_cast<bool>(m_physical.getFormatProperties(format).optimalTilingFeatures &
                           vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
}

std::uint32_t Device::memoryType(std::uint32_t typeBits, vk::MemoryPropertyFlags wanted,
                                 vk::MemoryPropertyFlags preferred) const {
  for (const vk::MemoryPropertyFlags flags : {wanted | preferred, wanted})
    for (std::uint32_t i = 0; i < m_memory.memoryTypeCount; ++i)
      if ((typeBits >> i & 1) && (m_memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
  throw deviceError(m_report.name, "no memory type fits");
}

Memory Device::allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags wanted,
                        vk::MemoryPropertyFlags preferred, bool isMapped) const {
  return Memory(*m_memoryStore, needs.size, memoryType(needs.memoryTypeBits, wanted, preferred), isMapped);
}

void Device::submit(const std::string& stage, const std::function<void(const vk::raii::CommandBuffer&)>& record) const {
  assert(!m_isSubmitting);
  struct Submitting {
    bool& flag;
    explicit Submitting(bool& f) : flag(f) { flag = true; }
    ~Submitting() { flag = false; }
  } const submitting(m_isSubmitting);
  const vk::raii::CommandBuffer& commands = m_commands.front();
  commands.reset(); // also of one that an exception has left half recorded
  commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  if (m_timestampBits > 0) {
    commands.resetQueryPool(*m_queries, 0, 2);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *m_queries, 0);
  }
  record(commands);
  // A fence does not make the device's writes visible to the host; this does.
  const vk::MemoryBarrier2 toHost(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                  vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
  commands.pipelineBarrier2(vk::DependencyInfo({}, toHost));
  if (m_timestampBits > 0) commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *m_queries, 1);
  commands.end();
  checkValidation();

  m_device.resetFences(*m_fence);
  const vk::CommandBuffer handle = *commands;
  const base::Stopwatch wall(nullptr, stage);
  try {
    m_queue.submit(vk::SubmitInfo({}, {}, handle), *m_fence);
    if (m_device.waitForFences(*m_fence, true, UINT64_MAX) != vk::Result::eSuccess)
      throw deviceError(stage, "the device did not finish its work");
  } catch (const vk::DeviceLostError&) {
    throw deviceError(stage, fmt::format("the device '{}' was lost", m_report.name));
  }
  const double wallMs = wall.elapsedMs();
  checkValidation();
  if (!m_timings) return;
  if (m_properties.deviceType == vk::PhysicalDeviceType::eCpu) return m_timings->add("device: " + stage, wallMs);
  if (m_timestampBits == 0) return;
  const auto [result, ticks] =
      m_queries.getResults<std::uint64_t>(0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                          vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  if (result == vk::Result::eSuccess)
    m_timings->add("device: " + stage,
                   static_cast<double>(ticks[1] - ticks[0]) * m_properties.limits.timestampPeriod * 1e-6);
}

void Device::checkValidation() const {
  std::lock_guard lock(m_messages->mutex);
  if (m_messages->lines.empty()) return;
  const std::string first = m_messages->lines.front();
  m_messages->lines.clear();
  throw deviceError("validation", first);
}

void fullBarrier(const vk::raii::CommandBuffer& commands) {
  const vk::MemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                   vk::PipelineStageFlagBits2::eAllCommands,
                                   vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite);
  commands.pipelineBarrier2(vk::DependencyInfo({}, barrier));
}

} // namespace parity::gpu

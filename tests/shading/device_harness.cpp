// The smallest Vulkan compute host (see device_harness.h).
#include "shading/device_harness.h"

#include <array>
#include <cstring>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <link.h>
#include <vulkan/vulkan_raii.hpp>

namespace parity::tests {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::uint32_t kGroupSize = 64;

// What the validation layer said; it may speak from any thread.
struct Messages {
  std::mutex mutex;
  std::string text;

  void failIfAny() {
    std::lock_guard lock(mutex);
    if (!text.empty()) throw std::runtime_error("validation: " + text);
  }
};

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  Messages& messages = *static_cast<Messages*>(user);
  std::lock_guard lock(messages.mutex);
  messages.text += std::string(data->pMessage) + "\n";
  return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(Messages& messages) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                              Type::eValidation | Type::ePerformance, &collectMessage, &messages);
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, Messages& messages) {
  bool layerFound = false;
  for (const vk::LayerProperties& layer : context.enumerateInstanceLayerProperties())
    layerFound = layerFound || std::strcmp(layer.layerName, kValidationLayer) == 0;
  if (!layerFound) throw std::runtime_error("no validation layer: install vulkan-validationlayers");
  const vk::ApplicationInfo application("parity tests", 1, nullptr, 0, VK_API_VERSION_1_2);
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const vk::DebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(messages);
  return vk::raii::Instance(context,
                            vk::InstanceCreateInfo({}, &application, 1, &kValidationLayer, 1, &extension, &messenger));
}

// Keeps the driver and the layers mapped until the process ends: unloaded, what they still hold would be reported by
// the leak checker as lost, with no symbol to suppress it by.
void keepDriversLoaded() {
  std::vector<std::string> files;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* user) {
        const std::string file = info->dlpi_name;
        if (file.find("ulkan") != std::string::npos || file.find("VkLayer") != std::string::npos)
          static_cast<std::vector<std::string>*>(user)->push_back(file);
        return 0;
      },
      &files);
  for (const std::string& file : files) dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
}

// The first CPU device, else the first of any kind that has a compute queue and Vulkan 1.2; null where there is none.
vk::raii::PhysicalDevice chooseDevice(const vk::raii::Instance& instance) {
  vk::raii::PhysicalDevice chosen = nullptr;
  for (vk::raii::PhysicalDevice& candidate : vk::raii::PhysicalDevices(instance)) {
    const vk::PhysicalDeviceProperties properties = candidate.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_2) continue;
    const bool isCpu = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    if (*chosen && !isCpu) continue;
    chosen = std::move(candidate);
    if (isCpu) break;
  }
  return chosen;
}

std::uint32_t computeFamily(const vk::raii::PhysicalDevice& physical) {
  const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
  throw std::runtime_error("the device has no compute queue");
}

// A storage buffer in memory that the host sees.
class HostBuffer {
public:
  HostBuffer(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device, std::size_t floats)
      : m_floats(floats),
        m_buffer(device, vk::BufferCreateInfo({}, floats * sizeof(float), vk::BufferUsageFlagBits::eStorageBuffer)),
        m_memory(allocate(physical, device, *m_buffer)) {
    m_buffer.bindMemory(*m_memory, 0);
  }
  vk::Buffer buffer() const { return *m_buffer; }
  void write(std::span<const float> values) {
    void* mapped = m_memory.mapMemory(0, VK_WHOLE_SIZE);
    std::memcpy(mapped, values.data(), values.size_bytes());
    m_memory.unmapMemory();
  }
  std::vector<float> read() const {
    std::vector<float> values(m_floats);
    const void* mapped = m_memory.mapMemory(0, VK_WHOLE_SIZE);
    std::memcpy(values.data(), mapped, m_floats * sizeof(float));
    m_memory.unmapMemory();
    return values;
  }

private:
  static vk::raii::DeviceMemory allocate(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                                         vk::Buffer buffer) {
    const vk::MemoryRequirements needs = (*device).getBufferMemoryRequirements(buffer, *device.getDispatcher());
    const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
    const vk::MemoryPropertyFlags wanted =
        vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
      if ((needs.memoryTypeBits >> i & 1u) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
        return vk::raii::DeviceMemory(device, vk::MemoryAllocateInfo(needs.size, i));
    throw std::runtime_error("the device has no host-visible memory");
  }

  std::size_t m_floats;
  vk::raii::Buffer m_buffer;
  vk::raii::DeviceMemory m_memory;
};

class VulkanHarness final : public DeviceHarness {
public:
  VulkanHarness(std::unique_ptr<Messages> messages, vk::raii::Context context, vk::raii::Instance instance,
                vk::raii::PhysicalDevice physical)
      : m_messages(std::move(messages)), m_context(std::move(context)), m_instance(std::move(instance)),
        m_messenger(m_instance, messengerInfo(*m_messages)), m_physical(std::move(physical)),
        m_family(computeFamily(m_physical)), m_name(m_physical.getProperties().deviceName.data()) {
    const auto features =
        m_physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceShaderFloat16Int8Features>();
    m_hasFloat16 = features.get<vk::PhysicalDeviceShaderFloat16Int8Features>().shaderFloat16;
    vk::PhysicalDeviceShaderFloat16Int8Features enabled(m_hasFloat16, VK_FALSE);
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, m_family, 1, &priority);
    m_device = vk::raii::Device(m_physical, vk::DeviceCreateInfo({}, queue, {}, {}, nullptr, &enabled));
    keepDriversLoaded();
    m_messages->failIfAny();
  }

  const std::string& deviceName() const override { return m_name; }
  bool hasShaderFloat16() const override { return m_hasFloat16; }
  std::vector<float> run(std::span<const std::uint32_t> spirv, std::int32_t function, std::span<const float> inputs,
                         std::uint32_t rows, std::uint32_t outputStride) override;

private:
  std::unique_ptr<Messages> m_messages; // outlives the instance, whose layer writes to it
  vk::raii::Context m_context;
  vk::raii::Instance m_instance;
  vk::raii::DebugUtilsMessengerEXT m_messenger;
  vk::raii::PhysicalDevice m_physical;
  std::uint32_t m_family;
  std::string m_name;
  bool m_hasFloat16 = false;
  vk::raii::Device m_device = nullptr;
};

std::vector<float> VulkanHarness::run(std::span<const std::uint32_t> spirv, std::int32_t function,
                                      std::span<const float> inputs, std::uint32_t rows, std::uint32_t outputStride) {
  HostBuffer in(m_physical, m_device, inputs.size());
  HostBuffer out(m_physical, m_device, std::size_t{rows} * outputStride);
  in.write(inputs);
  out.write(std::vector<float>(std::size_t{rows} * outputStride, std::numeric_limits<float>::quiet_NaN()));

  const vk::raii::ShaderModule module(m_device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
  std::array<vk::DescriptorSetLayoutBinding, 2> bindings;
  for (std::uint32_t i = 0; i < bindings.size(); ++i)
    bindings[i] = {i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute};
  const vk::raii::DescriptorSetLayout setLayout(m_device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
  const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, sizeof rows);
  const vk::raii::PipelineLayout layout(m_device, vk::PipelineLayoutCreateInfo({}, *setLayout, push));
  const vk::SpecializationMapEntry entry(0, 0, sizeof function);
  const vk::SpecializationInfo specialization(1, &entry, sizeof function, &function);
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                &specialization);
  const vk::raii::Pipeline pipeline(m_device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout));

  m_messages->failIfAny(); // before a pipeline that the layer refused is used

  const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, 2);
  const vk::raii::DescriptorPool pool(
      m_device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size));
  const vk::raii::DescriptorSet set =
      std::move(vk::raii::DescriptorSets(m_device, vk::DescriptorSetAllocateInfo(*pool, *setLayout)).front());
  const std::array<vk::DescriptorBufferInfo, 2> infos = {vk::DescriptorBufferInfo(in.buffer(), 0, VK_WHOLE_SIZE),
                                                         vk::DescriptorBufferInfo(out.buffer(), 0, VK_WHOLE_SIZE)};
  m_device.updateDescriptorSets(vk::WriteDescriptorSet(*set, 0, 0, vk::DescriptorType::eStorageBuffer, {}, infos),
                                nullptr);

  const vk::raii::CommandPool commandPool(m_device, vk::CommandPoolCreateInfo({}, m_family));
  const vk::raii::CommandBuffer commands =
      std::move(vk::raii::CommandBuffers(
                    m_device, vk::CommandBufferAllocateInfo(*commandPool, vk::CommandBufferLevel::ePrimary, 1))
                    .front());
  commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, *set, nullptr);
  commands.pushConstants<std::uint32_t>(*layout, vk::ShaderStageFlagBits::eCompute, 0, rows);
  commands.dispatch((rows + kGroupSize - 1) / kGroupSize, 1, 1);
  const vk::MemoryBarrier visible(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
  commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {}, visible,
                           nullptr, nullptr);
  commands.end();
  const vk::raii::Queue queue(m_device, m_family, 0);
  queue.submit(vk::SubmitInfo({}, {}, *commands));
  queue.waitIdle();
  m_messages->failIfAny();
  return out.read();
}

} // namespace

std::unique_ptr<DeviceHarness> DeviceHarness::open() {
  auto messages = std::make_unique<Messages>();
  try {
    vk::raii::Context context;
    vk::raii::Instance instance = makeInstance(context, *messages);
    vk::raii::PhysicalDevice physical = chooseDevice(instance);
    if (!*physical) return nullptr;
    return std::make_unique<VulkanHarness>(std::move(messages), std::move(context), std::move(instance),
                                           std::move(physical));
  } catch (const vk::IncompatibleDriverError&) {
    return nullptr; // the loader found no driver
  } catch (const vk::InitializationFailedError&) {
    return nullptr; // no device, or a driver that cannot start
  }
}

} // namespace parity::tests

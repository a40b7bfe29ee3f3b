#include "gpu/device/device_choice.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "gpu/shaders/interface.h"

namespace parity::gpu {

namespace {

// Most that one of our pipelines binds (the paths' shaders; the resolve pass binds fewer).
constexpr std::uint32_t kStorageBuffers = 18;
constexpr std::uint32_t kSampledImages = 8 + kSlotCount; // the paths' own, the materials'

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

const char* kindName(vk::PhysicalDeviceType type) {
  switch (type) {
  case vk::PhysicalDeviceType::eCpu:
    return "cpu";
  case vk::PhysicalDeviceType::eDiscreteGpu:
    return "discrete";
  case vk::PhysicalDeviceType::eIntegratedGpu:
    return "integrated";
  case vk::PhysicalDeviceType::eVirtualGpu:
    return "virtual";
  default:
    return "other";
  }
}

// Why the device cannot be used; empty where it can.
std::string refusal(const vk::raii::PhysicalDevice& device) {
  const auto properties = device.getProperties();
  if (properties.apiVersion < VK_API_VERSION_1_3)
    return fmt::format("it has Vulkan {}.{}, 1.3 is needed", VK_API_VERSION_MAJOR(properties.apiVersion),
                       VK_API_VERSION_MINOR(properties.apiVersion));
  if (!graphicsQueueFamily(device)) return "it has no queue with graphics and compute";
  const auto features = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>();
  if (!features.get<vk::PhysicalDeviceFeatures2>().features.geometryShader)
    return "it has no primitive ids in fragment shaders (geometryShader)";
  if (!features.get<vk::PhysicalDeviceFeatures2>().features.imageCubeArray)
    return "it has no arrays of cube maps (imageCubeArray)";
  if (!features.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering) return "it has no dynamic rendering";
  if (properties.limits.maxPerStageDescriptorStorageBuffers < kStorageBuffers)
    return fmt::format("it has {} storage buffers a stage, {} are needed",
                       properties.limits.maxPerStageDescriptorStorageBuffers, kStorageBuffers);
  if (const std::uint32_t most = std::min(properties.limits.maxPerStageDescriptorSampledImages,
                                          properties.limits.maxPerStageDescriptorSamplers);
      most < kSampledImages)
    return fmt::format("it has {} textures a stage, {} are needed", most, kSampledImages);
  if (properties.limits.maxUniformBufferRange < kLargestUniform)
    return fmt::format("its uniform buffers hold {} bytes, {} are needed", properties.limits.maxUniformBufferRange,
                       kLargestUniform);
  return {};
}

DeviceReport describe(const vk::raii::PhysicalDevice& device) {
  const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
  const auto features = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
  DeviceReport report;
  report.name = properties.deviceName.data();
  report.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
  report.kind = kindName(properties.deviceType);
  report.apiVersion =
      fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(properties.apiVersion), VK_API_VERSION_MINOR(properties.apiVersion),
                  VK_API_VERSION_PATCH(properties.apiVersion));
  report.build = fmt::format("{:08x}", properties.driverVersion);
  for (const std::uint8_t byte : properties.pipelineCacheUUID) report.build += fmt::format("{:02x}", byte);
  report.float16 = features.get<vk::PhysicalDeviceVulkan12Features>().shaderFloat16;
  return report;
}

} // namespace

std::optional<std::uint32_t> graphicsQueueFamily(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  constexpr auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if ((families[i].queueFlags & wanted) == wanted) return i;
  return std::nullopt;
}

int chooseByName(const std::vector<DeviceReport>& reports, const std::vector<std::string>& refusals,
                 const std::string& name) {
  const bool isNumber =
      !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
  int best = -1, bestRank = 0;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (!refusals[i].empty()) continue;
    int rank = 0;
    if (isNumber)
      rank = name == std::to_string(i) ? 3 : 0;
    else if (!name.empty())
      rank = lowered(reports[i].name).find(lowered(name)) != std::string::npos ? 3 : 0;
    else if (reports[i].kind == "cpu")
      rank = lowered(reports[i].name).find("llvmpipe") != std::string::npos ? 2 : 1;
    if (rank > bestRank) best = static_cast<int>(i), bestRank = rank;
  }
  return best;
}

DeviceChoice chooseDevice(const std::vector<vk::raii::PhysicalDevice>& devices, const DeviceOptions& options) {
  DeviceChoice choice;
  std::vector<std::string> refusals;
  for (const auto& device : devices) {
    choice.reports.push_back(describe(device));
    refusals.push_back(refusal(device));
  }
  choice.taken = chooseByName(choice.reports, refusals, options.name);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    DeviceReport& report = choice.reports[i];
    report.taken = static_cast<int>(i) == choice.taken;
    if (!refusals[i].empty())
      report.reason = "cannot be used: " + refusals[i];
    else if (report.taken)
      report.reason = options.name.empty()
                          ? "used: the software device is the default, because its pictures are reproducible"
                          : fmt::format("used: --device '{}' selects it", options.name);
    else if (!options.name.empty())
      report.reason = fmt::format("not used: --device '{}' does not select it", options.name);
    else
      report.reason = report.kind == "cpu" ? "not used: lavapipe has priority" : "not used: hardware needs --device";
  }
  return choice;
}

} // namespace parity::gpu

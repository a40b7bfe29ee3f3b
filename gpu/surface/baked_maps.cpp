#include "gpu/surface/baked_maps.h"

#include <cassert>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::gpu {

namespace {

DeviceImage makePages(const Device& device, const BakedPages& pages, const char* what) {
  const auto refuse = [&](const std::string& reason) {
    return base::Error(base::ExitCode::failed, device.report().name, what, reason);
  };
  if (!device.filtersLinearly(pages.format))
    throw refuse(fmt::format("the device cannot filter textures of {}", vk::to_string(pages.format)));
  if (const std::uint32_t limit = device.properties().limits.maxImageArrayLayers; pages.count > limit)
    throw refuse(fmt::format("{} pages; the device allows at most {}", pages.count, limit));
  return DeviceImage(device,
                     {.format = pages.format,
                      .width = pages.width,
                      .height = pages.height,
                      .mips = 1,
                      .array = true,
                      .arraySize = pages.count},
                     std::span{&pages.texels, 1});
}

} // namespace

BakedMaps makeBakedMaps(const Device& device, const BakedContent& content) {
  BakedMaps maps;
  if (content.lightmap.count > 0) {
    assert(content.lightmap.height % 2 == 0);
    maps.lightmap = makePages(device, content.lightmap, "lightmap");
    maps.parts |= kBakedLightmap;
  }
  if (content.sunShadow.count > 0) {
    maps.sunShadow = makePages(device, content.sunShadow, "baked shadow");
    maps.parts |= kBakedSunShadow;
  }
  if (!content.captures.empty()) maps.parts |= kBakedCaptures;
  const uvec4 head(content.captures.size(), 0, 0, 0);
  maps.captures = Buffer(device, sizeof(head) + content.captures.size_bytes());
  maps.captures.upload(std::as_bytes(std::span{&head, 1}));
  maps.captures.upload(std::as_bytes(content.captures), sizeof(head));
  maps.scales = Buffer(device, content.scales);
  maps.scaleCount = content.scales.size();
  maps.transitionScale = content.transitionScale;
  return maps;
}

} // namespace parity::gpu

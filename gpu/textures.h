// The scene's textures on the device: mips made on the CPU, alike on every device.
#pragma once

#include <map>
#include <vector>

#include "gpu/image.h"
#include "scenes/scene.h"

namespace parity::gpu {

// One texture set is the images and samplers of a material's seven slots; materials with equal sets share a descriptor
// set.
class Textures {
public:
  // normalVariance: normal maps get the spread of their normals as alpha (gpu/normal_variance.h). An image that another
  // slot reads, too, keeps its alpha there.
  Textures(const Device& device, const scenes::Scene& scene, bool normalVariance);

  // Index of each material's texture set.
  const std::vector<std::uint32_t>& setOfMaterial() const { return m_setOfMaterial; }
  std::size_t setCount() const { return m_sets.size(); }
  // The seven bindings of a set, in slot order; a slot without a texture is white.
  std::vector<vk::DescriptorImageInfo> bindings(std::uint32_t set) const;

private:
  struct Binding {
    int image = -1; // into m_images; -1: white
    int sampler = 0;
    auto operator<=>(const Binding&) const = default;
  };
  std::vector<DeviceImage> m_images;
  std::vector<vk::raii::Sampler> m_samplers;
  std::vector<std::vector<Binding>> m_sets;
  std::vector<std::uint32_t> m_setOfMaterial;
  DeviceImage m_white;
};

// How many pairs of an image and a sampler a material's shader reads: a pair that several slots share counts once, an
// image that is read as colour and as data is two.
std::size_t countSamplers(const scenes::Material& material, bool normalVariance);

// All mips of an RGBA8 image down to 1x1, base level first: area-weighted averages (exact for odd sizes too), in linear
// light where srgb says that RGB is sRGB-encoded.
std::vector<base::Image8> makeMips(const base::Image8& image, bool srgb);

} // namespace parity::gpu

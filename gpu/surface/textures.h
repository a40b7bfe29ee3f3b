// The scene's textures on the device, those that something seen reads: mips made on the CPU, alike on every device.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "gpu/device/image.h"
#include "gpu/shaders/interface.h"
#include "scenes/scene.h"

namespace parity::gpu {

// Told the index of an image of the scene.
using ImageDone = std::function<void(int)>;
// What is left of a mip, RGBA8, by the way that a path stores its textures; isColor: RGB is sRGB-encoded.
using TextureCodec = std::function<base::Image8(const base::Image8& mip, bool isColor)>;

// One texture set is the images and samplers of a material's slots; materials with equal sets share a descriptor
// set. An image is uploaded when it is first required. Not thread-safe.
class Textures {
public:
  // normalVariance: normal maps get the spread of their normals as alpha (gpu/surface/normal_variance.h). An image that
  // another slot reads, too, keeps its alpha there. The scene must outlive it. onLastRead: what is placed in the scene
  // reads the image's pixels no more; may free them. codec: what each mip goes through; the mips are those of the image
  // as it is. None: nothing.
  Textures(const Device& device, const scenes::Scene& scene, bool normalVariance, ImageDone onLastRead = {},
           TextureCodec codec = {});

  // Index of each material's texture set.
  const std::vector<std::uint32_t>& setOfMaterial() const { return m_setOfMaterial; }
  std::size_t setCount() const { return m_sets.size(); }

  // Some slots of a set, as bits.
  struct Need {
    std::uint32_t set = 0, slots = 0;
  };
  // Uploads what these need and is not there yet.
  void require(std::span<const Need> needs) const;
  // The bindings of a set, in slot order: white for a slot without a texture or one that was not needed. Uploads.
  std::vector<vk::DescriptorImageInfo> bindings(const Need& need) const;

  // Whether some material has a texture.
  bool any() const { return !m_sources.empty(); }
  // How many images have been uploaded so far, and how many of them with the spread of their normals.
  std::size_t uploadedCount() const;
  std::size_t varianceCount() const;

private:
  // What an image is uploaded as: its encoding, and what its mips hold.
  enum class Use { color, data, normalVariance };
  friend std::size_t countSamplers(const scenes::Material& material, bool normalVariance, std::uint32_t slots);
  static Use useOf(int slot, bool normalVariance);
  struct Binding {
    int image = -1; // into m_images; -1: white
    int sampler = 0;
    auto operator<=>(const Binding&) const = default;
  };
  struct Source {
    int image = 0; // of the scene
    Use use = Use::color;
    auto operator<=>(const Source&) const = default;
  };
  void makeWhites();
  void countReads();
  void countAsRead(int image) const;

  const Device& m_device;
  const scenes::Scene& m_scene;
  ImageDone m_onLastRead;
  TextureCodec m_codec;
  std::vector<Source> m_sources;
  mutable std::vector<std::optional<DeviceImage>> m_images; // of each source; none: not required yet
  mutable std::vector<int> m_unreadSources;                 // of each image of the scene: not uploaded yet
  std::vector<vk::raii::Sampler> m_samplers;
  std::vector<std::vector<Binding>> m_sets;
  std::vector<std::uint32_t> m_setOfMaterial;
  // A white image for each slot without a texture, of the kind of another material's texture there, so that lavapipe
  // needs no further shader (standInSide).
  std::vector<DeviceImage> m_whites;
  std::array<Binding, kSlotCount> m_whiteOfSlot; // image: into m_whites
};

// How many pairs of an image and a sampler a material's shader reads, of these slots (bits): a pair that several slots
// share counts once, an image that is read as colour and as data is two.
std::size_t countSamplers(const scenes::Material& material, bool normalVariance, std::uint32_t slots = ~0u);

} // namespace parity::gpu

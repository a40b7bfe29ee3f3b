// Pipelines and descriptor sets in their plainest form.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "gpu/device/image.h"

namespace parity::gpu {

using Spirv = std::span<const std::uint32_t>;

// A binding of a set, in order of binding numbers from 0.
struct BufferBinding {
  vk::DescriptorBufferInfo info;
  bool uniform = false;
};
using Binding = std::variant<BufferBinding, vk::DescriptorImageInfo>; // image: combined with its sampler

inline Binding storage(const Buffer& buffer) { return BufferBinding{buffer.info(), false}; }
inline Binding uniform(const Buffer& buffer) { return BufferBinding{buffer.info(), true}; }

// A layout with these bindings, visible in all of `stages`.
vk::raii::DescriptorSetLayout makeSetLayout(const Device& device, std::span<const Binding> bindings,
                                            vk::ShaderStageFlags stages);

// Descriptor sets that live and die together.
class DescriptorSets {
public:
  // One set per entry of `contents`, all of this layout. Every binding is filled: an unwritten one crashes some
  // drivers.
  DescriptorSets(const Device& device, const vk::raii::DescriptorSetLayout& layout,
                 std::span<const std::vector<Binding>> contents);
  vk::DescriptorSet operator[](std::size_t i) const { return m_sets[i]; }

private:
  vk::raii::DescriptorPool m_pool{nullptr};
  std::vector<vk::DescriptorSet> m_sets; // owned by the pool
};

vk::raii::PipelineLayout makePipelineLayout(const Device& device, std::span<const vk::DescriptorSetLayout> sets,
                                            std::uint32_t pushBytes, vk::ShaderStageFlags stages);

// constants: values of the specialization constants 0, 1, 2, ...
vk::raii::Pipeline makeComputePipeline(const Device& device, const vk::raii::PipelineLayout& layout, Spirv spirv,
                                       std::span<const std::uint32_t> constants);

// Compute pipelines by what they are made of, kept for the next pass that needs one: those of a run. Must end before
// the device does.
class PipelineStore {
public:
  // Null where there is none. `spirv` is told apart by its address: a shader stays where it is until the process ends.
  vk::Pipeline find(Spirv spirv, std::span<const std::uint32_t> constants) const;
  vk::Pipeline add(Spirv spirv, std::span<const std::uint32_t> constants, vk::raii::Pipeline pipeline);
  // What each is made of.
  struct Shader {
    Spirv words;
    bool operator<(const Shader& other) const { return words.data() < other.words.data(); }
  };
  using Key = std::pair<Shader, std::vector<std::uint32_t>>;
  std::set<Key> keys() const;

private:
  struct Entry {
    Spirv spirv;
    std::vector<std::uint32_t> constants;
    vk::raii::Pipeline pipeline;
  };
  std::vector<Entry> m_entries;
};

} // namespace parity::gpu

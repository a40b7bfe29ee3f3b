// The numbers of specialize.comp.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <spirv-tools/libspirv.hpp>

namespace parity::gpu {

// In the shader's order.
struct Numbers {
  std::uint32_t piece = 0, first = 0, second = 0;
  bool switched = false;
  float scale = 1.25f;
};

// Its specialization constants, where the numbers are known.
inline std::vector<std::uint32_t> constantsOf(const Numbers& numbers) {
  return {
      1, numbers.piece, numbers.first, numbers.second, numbers.switched, std::bit_cast<std::uint32_t>(numbers.scale)};
}

// What the validator of SPIRV-Tools says against a module; nothing: it is valid.
inline std::string refusalOf(std::span<const std::uint32_t> words) {
  std::string message;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
  tools.SetMessageConsumer(
      [&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { message = text; });
  return tools.Validate(words.data(), words.size()) ? "" : message;
}

} // namespace parity::gpu

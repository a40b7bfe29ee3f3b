// A glTF file taken apart into JSON and bytes, and put together again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace parity::tests {

struct GltfParts {
  nlohmann::json json;
  std::vector<std::uint8_t> binary; // of a .glb
  bool isGlb = false;
};

// Nothing where the container is damaged, the JSON is none, or either is too large to be worth it.
std::optional<GltfParts> takeApart(std::span<const std::uint8_t> bytes);

// A .glb with the right lengths, or the JSON as text.
std::vector<std::uint8_t> putTogether(const GltfParts& parts);

// Makes the checksums of a PNG's chunks right, as far as it has any.
void repairPng(std::span<std::uint8_t> bytes);

std::string toBase64(std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> fromBase64(std::string_view text); // skips what is no such character

} // namespace parity::tests

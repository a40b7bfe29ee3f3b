// A glTF file taken apart into JSON and bytes, and put together again.
#include "fuzz/gltf_parts.h"

#include <algorithm>
#include <cstring>

#include <zlib.h>

#include "base/error.h"
#include "scenes/gltf/file/container.h"
#include "scenes/gltf/file/json.h"

namespace parity::tests {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

void addU32(std::vector<std::uint8_t>& bytes, std::size_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xff));
}

} // namespace

std::optional<GltfParts> takeApart(std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || bytes.size() > kMaxBytes) return std::nullopt;
  const std::span<const std::byte> all(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
  GltfParts parts;
  try {
    scenes::GlbChunks chunks;
    parts.isGlb = scenes::isGlb(all);
    if (parts.isGlb)
      chunks = scenes::splitGlb(all, "");
    else
      chunks.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    parts.json = scenes::parseGltfJson(chunks.json, "");
    const auto* binary = reinterpret_cast<const std::uint8_t*>(chunks.binary.data());
    parts.binary.assign(binary, binary + chunks.binary.size());
  } catch (const base::Error&) {
    return std::nullopt;
  }
  if (!parts.json.is_object()) return std::nullopt;
  return parts;
}

std::vector<std::uint8_t> putTogether(const GltfParts& parts) {
  std::string text = parts.json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!parts.isGlb) return {text.begin(), text.end()};
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t binaryBytes = (parts.binary.size() + 3) / 4 * 4;
  std::vector<std::uint8_t> glb;
  addU32(glb, 0x46546C67);
  addU32(glb, 2);
  addU32(glb, 12 + 8 + text.size() + 8 + binaryBytes);
  addU32(glb, text.size());
  addU32(glb, 0x4E4F534A);
  glb.insert(glb.end(), text.begin(), text.end());
  addU32(glb, binaryBytes);
  addU32(glb, 0x004E4942);
  glb.insert(glb.end(), parts.binary.begin(), parts.binary.end());
  glb.resize((glb.size() + 3) / 4 * 4);
  return glb;
}

void repairPng(std::span<std::uint8_t> bytes) {
  if (bytes.size() < 8 || std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8) != 0) return;
  const auto readBig = [&](std::size_t at) {
    return std::size_t{bytes[at]} << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
  };
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = readBig(at);
    if (length > bytes.size() - at - 12) return;
    const auto checksum = static_cast<std::uint32_t>(crc32_z(0, bytes.data() + at + 4, length + 4));
    for (int i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
    at += 12 + length;
  }
}

std::string toBase64(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kAlphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::vector<std::uint8_t> fromBase64(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t value = kAlphabet.find(c);
    if (value == std::string_view::npos) continue;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count & 0xff));
  }
  return bytes;
}

} // namespace parity::tests

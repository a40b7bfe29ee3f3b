// The byte image of an environment light: a header, the irradiance (SH, cube), the lamps, then the mips as they lie in
// memory.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "base/error.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/environment_light.h"
#include "lighting/environment/irradiance_cube.h"
#include "lighting/environment/lamp_tree.h"
#include "shading/shading.h"

namespace parity::lighting {

namespace {

constexpr std::uint32_t kMagic = 0x35564e45; // "ENV5"; another byte order reads as another number
constexpr std::uint32_t kEarlierMagics[] = {0x32564e45, 0x33564e45,
                                            0x34564e45}; // without irradiance cube, lamps; more lamps
constexpr std::size_t kIrradianceTexels = std::size_t{kCubeFaces} * kIrradianceFaceSize * kIrradianceFaceSize;
constexpr std::uint32_t kMipCount = shading::f64::kPrefilterRoughestMip + 1;

struct Header {
  std::uint32_t magic = kMagic;
  std::uint32_t faceSize = 0;
  std::uint32_t mipCount = kMipCount;
  std::uint32_t levels = 0;                      // PrefilterLevels
  std::uint32_t wideLamps = 0, compactLamps = 0; // nodes
};

static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16 && sizeof(LampNode) == 32);

[[noreturn]] void fail(const std::string& reason) { throw base::fileError("environment light", "", reason); }

PrefilterLevels levelsOf(const CubeMap& cube) {
  if (layersOf(cube, 1) == 1) return PrefilterLevels::first;
  return layersOf(cube, 0) == 1 ? PrefilterLevels::captures : PrefilterLevels::fine;
}

void requireFinite(const float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) fail("holds a value that is not finite");
}

// The shader follows `next`: it must lead on, and to the end.
void checkLamps(const LampTree& tree) {
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const LampNode& node = tree.nodes[i];
    requireFinite(&node.direction.x, 7);
    if (!(node.spread > 0)) fail("holds a lamp of size 0");
    if (node.next <= i || node.next > tree.nodes.size()) fail("holds lamps that do not form a tree");
  }
}

} // namespace

std::vector<std::byte> toBytes(const EnvironmentLight& light) {
  Header header;
  header.faceSize = static_cast<std::uint32_t>(light.prefiltered.faceSize);
  header.levels = static_cast<std::uint32_t>(levelsOf(light.prefiltered));
  header.wideLamps = static_cast<std::uint32_t>(light.lamps.wide.nodes.size());
  header.compactLamps = static_cast<std::uint32_t>(light.lamps.compact.nodes.size());
  std::size_t size = sizeof header + sizeof light.irradianceSh + light.irradianceCube.size() * sizeof(glm::vec4) +
                     (header.wideLamps + header.compactLamps) * sizeof(LampNode);
  for (const auto& mip : light.prefiltered.mips) size += mip.size() * sizeof(glm::vec4);

  std::vector<std::byte> bytes(size);
  std::byte* to = bytes.data();
  const auto append = [&to](const void* from, std::size_t count) {
    if (count == 0) return; // of an empty list there may be no address
    std::memcpy(to, from, count);
    to += count;
  };
  append(&header, sizeof header);
  append(light.irradianceSh.data(), sizeof light.irradianceSh);
  append(light.irradianceCube.data(), light.irradianceCube.size() * sizeof(glm::vec4));
  for (const LampTree* tree : {&light.lamps.wide, &light.lamps.compact})
    append(tree->nodes.data(), tree->nodes.size() * sizeof(LampNode));
  for (const auto& mip : light.prefiltered.mips) append(mip.data(), mip.size() * sizeof(glm::vec4));
  return bytes;
}

EnvironmentLight environmentLightFromBytes(std::span<const std::byte> bytes) {
  Header header;
  if (bytes.size() < sizeof header) fail("is shorter than its header");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::ranges::find(kEarlierMagics, header.magic) != std::end(kEarlierMagics))
    fail("was made by an earlier version; bake again");
  if (header.magic != kMagic) fail("is not an environment light");
  if (header.mipCount != kMipCount) fail("has " + std::to_string(header.mipCount) + " mips");
  if (header.faceSize < kMinFaceSize || header.faceSize > kMaxFaceSize || !std::has_single_bit(header.faceSize))
    fail("has faces of " + std::to_string(header.faceSize) + " texels");
  if (header.levels > static_cast<std::uint32_t>(PrefilterLevels::fine)) fail("has levels of an unknown kind");
  const auto levels = static_cast<PrefilterLevels>(header.levels);
  for (const auto& [count, leaves] :
       {std::pair(header.wideLamps, kMaxWideLampLeaves), std::pair(header.compactLamps, kMaxCompactLamps)})
    if (count >= 2 * leaves) fail("has " + std::to_string(count) + " lamps");

  EnvironmentLight light;
  light.prefiltered.faceSize = static_cast<int>(header.faceSize);
  const std::size_t irradianceTexels = hasIrradianceCube(levels) ? kIrradianceTexels : 0;
  std::size_t expected = sizeof header + sizeof light.irradianceSh + irradianceTexels * sizeof(glm::vec4) +
                         (header.wideLamps + header.compactLamps) * sizeof(LampNode);
  for (std::uint32_t m = 0; m < kMipCount; ++m)
    expected +=
        texelIndex(kCubeFaces * layersOfMip(static_cast<int>(m), levels), 0, 0, light.prefiltered.faceSize >> m) *
        sizeof(glm::vec4);
  if (bytes.size() != expected)
    fail("has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(expected));

  const std::byte* from = bytes.data() + sizeof header;
  std::memcpy(light.irradianceSh.data(), from, sizeof light.irradianceSh);
  from += sizeof light.irradianceSh;
  requireFinite(&light.irradianceSh[0].x, 3 * light.irradianceSh.size());
  if (irradianceTexels > 0) {
    light.irradianceCube.resize(irradianceTexels);
    std::memcpy(light.irradianceCube.data(), from, irradianceTexels * sizeof(glm::vec4));
    from += irradianceTexels * sizeof(glm::vec4);
    requireFinite(&light.irradianceCube[0].x, 4 * irradianceTexels);
  }
  const auto readLamps = [&from](LampTree& tree, std::size_t count) {
    tree.nodes.resize(count);
    if (count > 0) std::memcpy(tree.nodes.data(), from, count * sizeof(LampNode));
    from += count * sizeof(LampNode);
    checkLamps(tree);
  };
  readLamps(light.lamps.wide, header.wideLamps);
  readLamps(light.lamps.compact, header.compactLamps);
  for (std::uint32_t m = 0; m < kMipCount; ++m) {
    std::vector<glm::vec4>& mip = light.prefiltered.mips.emplace_back(
        texelIndex(kCubeFaces * layersOfMip(static_cast<int>(m), levels), 0, 0, light.prefiltered.faceSize >> m));
    std::memcpy(mip.data(), from, mip.size() * sizeof(glm::vec4));
    from += mip.size() * sizeof(glm::vec4);
    requireFinite(&mip[0].x, 4 * mip.size());
  }
  return light;
}

} // namespace parity::lighting

// EXT_meshopt_compression: checks what meshoptimizer asserts or trusts, then lets it decode.
#include "scenes/gltf/file/meshopt.h"

#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scenes/names.h"

namespace parity::scenes {
namespace {

constexpr std::array<std::string_view, 3> kModeNames = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 4> kFilters = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};

std::invalid_argument refusal(const std::string& reason) { return std::invalid_argument(reason); }

template <typename Enum, std::size_t kCount>
Enum valueOf(std::string_view name, const std::array<std::string_view, kCount>& names, const char* what) {
  for (std::size_t i = 0; i < kCount; ++i)
    if (names[i] == name) return static_cast<Enum>(i);
  throw refusal(fmt::format("'{}' is not a {} of EXT_meshopt_compression", cleanName(std::string(name)), what));
}

void checkFilter(const MeshoptLayout& layout) {
  const std::string_view name = kFilters[static_cast<std::size_t>(layout.filter)];
  if (layout.filter != MeshoptFilter::none && layout.mode != MeshoptMode::attributes)
    throw refusal(fmt::format("the filter {} works only with the mode ATTRIBUTES", name));
  const bool fits = layout.filter == MeshoptFilter::octahedral   ? layout.byteStride == 4 || layout.byteStride == 8
                    : layout.filter == MeshoptFilter::quaternion ? layout.byteStride == 8
                                                                 : true; // a multiple of 4, as all are
  if (!fits) throw refusal(fmt::format("the filter {} cannot have a byteStride of {}", name, layout.byteStride));
}

} // namespace

MeshoptMode meshoptModeOf(std::string_view name) { return valueOf<MeshoptMode>(name, kModeNames, "mode"); }
MeshoptFilter meshoptFilterOf(std::string_view name) { return valueOf<MeshoptFilter>(name, kFilters, "filter"); }

void checkMeshoptLayout(const MeshoptLayout& layout, std::size_t compressedBytes) {
  const std::size_t count = layout.count, stride = layout.byteStride;
  const std::string_view mode = kModeNames[static_cast<std::size_t>(layout.mode)];
  if (count == 0) throw refusal("its count is 0");
  std::size_t least = 0; // bytes of the densest stream
  if (layout.mode == MeshoptMode::attributes) {
    if (stride < 4 || stride > 256 || stride % 4)
      throw refusal(fmt::format("its byteStride {} is not a multiple of 4 from 4 to 256", stride));
    least = count * stride / 64; // two bits for sixteen equal bytes
  } else {
    if (stride != 2 && stride != 4)
      throw refusal(fmt::format("its byteStride is {}, but {} have 2 or 4", stride, mode));
    if (layout.mode == MeshoptMode::triangles && count % 3)
      throw refusal(fmt::format("{} indices do not form whole triangles", count));
    least = layout.mode == MeshoptMode::triangles ? count / 3 : count; // a byte each
  }
  checkFilter(layout);
  if (compressedBytes < least)
    throw refusal(fmt::format("{} bytes cannot hold {} elements of {} bytes", compressedBytes, count, stride));
}

std::vector<std::byte> decodeMeshopt(std::span<const std::byte> compressed, const MeshoptLayout& layout) {
  checkMeshoptLayout(layout, compressed.size());
  const std::size_t count = layout.count, stride = layout.byteStride;
  std::vector<std::byte> out(count * stride);
  const auto* bytes = reinterpret_cast<const unsigned char*>(compressed.data());
  int failure = 0;
  switch (layout.mode) {
  case MeshoptMode::attributes:
    failure = meshopt_decodeVertexBuffer(out.data(), count, stride, bytes, compressed.size());
    break;
  case MeshoptMode::triangles:
    failure = meshopt_decodeIndexBuffer(out.data(), count, stride, bytes, compressed.size());
    break;
  case MeshoptMode::indices:
    failure = meshopt_decodeIndexSequence(out.data(), count, stride, bytes, compressed.size());
    break;
  }
  if (failure)
    throw refusal(fmt::format("the stream is damaged, or does not hold {} of {} elements of {} bytes",
                              kModeNames[static_cast<std::size_t>(layout.mode)], count, stride));
  switch (layout.filter) {
  case MeshoptFilter::none:
    break;
  case MeshoptFilter::octahedral:
    meshopt_decodeFilterOct(out.data(), count, stride);
    break;
  case MeshoptFilter::quaternion:
    meshopt_decodeFilterQuat(out.data(), count, stride);
    break;
  case MeshoptFilter::exponential:
    meshopt_decodeFilterExp(out.data(), count, stride);
    break;
  }
  return out;
}

} // namespace parity::scenes

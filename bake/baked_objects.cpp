#include "bake/baked_objects.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "base/error.h"
#include "base/file.h"

namespace parity::bake {

namespace {

template <typename T> void append(std::vector<std::byte>& bytes, const std::vector<T>& list) {
  const std::uint64_t count = list.size();
  const auto number = std::as_bytes(std::span(&count, 1)), content = std::as_bytes(std::span(list));
  bytes.insert(bytes.end(), number.begin(), number.end());
  bytes.insert(bytes.end(), content.begin(), content.end());
}

template <typename T> void take(std::span<const std::byte>& bytes, std::vector<T>& list, const std::string& file) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) throw base::fileError(file, "", "is truncated");
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes = bytes.subspan(sizeof count);
  if (count > bytes.size() / sizeof(T)) throw base::fileError(file, "", "is truncated");
  list.resize(count);
  if (count > 0) std::memcpy(list.data(), bytes.data(), count * sizeof(T));
  bytes = bytes.subspan(count * sizeof(T));
}

static_assert(sizeof(scenes::LightmapUvs::Place) == 20, "no padding: written as it is");

} // namespace

std::vector<std::byte> objectBytes(const BakedLight& baked) {
  std::vector<std::byte> bytes;
  append(bytes, baked.uvs.corners);
  append(bytes, baked.uvs.places);
  append(bytes, baked.lqScales);
  return bytes;
}

void readObjects(const std::filesystem::path& file, std::size_t captures, BakedLight& baked) {
  const std::vector<std::byte> all = base::readFile(file);
  std::span<const std::byte> bytes(all);
  take(bytes, baked.uvs.corners, file.string());
  take(bytes, baked.uvs.places, file.string());
  take(bytes, baked.lqScales, file.string());
  // Shaders trust all of it.
  const scenes::LightmapUvs& uvs = baked.uvs;
  const auto isFinite = [](const auto& v) { return !glm::any(glm::isnan(v)) && !glm::any(glm::isinf(v)); };
  const auto fits = [&](const scenes::LightmapUvs::Place& place) {
    return place.page >= -1 && place.page < static_cast<std::int64_t>(baked.halfPages.size()) &&
           isFinite(place.offset) && (place.page < 0 || place.firstCorner < uvs.corners.size()) &&
           (captures == 0 || place.capture < captures); // of none, none is read
  };
  if (!bytes.empty() || !std::ranges::all_of(uvs.places, fits) || !std::ranges::all_of(uvs.corners, isFinite) ||
      !std::ranges::all_of(baked.lqScales, isFinite) || baked.lqScales.size() != 4 * uvs.places.size())
    throw base::fileError(file.string(), "", "does not match the pages of this bake");
}

} // namespace parity::bake

// What of a file is loaded, and how much of it at most.
#pragma once

#include <cstddef>
#include <string>

namespace parity::scenes {

inline constexpr double kMaxPoseSeconds = 1e9;

// LoadOptions::animation that plays none: the rest pose. An animation of that name goes before.
inline constexpr const char* kNoAnimation = "none";

struct LoadOptions {
  double timeSeconds = 0;    // the pose: of all animations, each clamped to its keys
  std::string animation{};   // a name or an index, or kNoAnimation; empty: all that do not contradict an earlier one
  std::string scene{};       // a name or an index; empty: the file's own default, else its first
  std::string variant{};     // of KHR_materials_variants, a name or an index; empty: the materials as they are
  bool allMaterials = false; // decode the images of materials, too, that no mesh shows

  // Limits; what is beyond them is refused before memory is taken.
  std::size_t maxImageSide = 16384;                    // texels
  std::size_t maxImageTexels = std::size_t{512} << 20; // of all images together
  std::size_t maxMemoryBytes = std::size_t{4} << 30;   // of files, meshes and decoded images together
  bool operator==(const LoadOptions&) const = default;
};

} // namespace parity::scenes

// Bytes through the loaders, as the fuzz targets and the test of their corpus do it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace parity::tests {

// A private folder in memory where there is one (the loaders read files), removed in the end.
class InputFolder {
public:
  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  // Writes the bytes over those of the last input and returns the path.
  std::string write(const std::string& name, std::span<const std::byte> bytes) const;

private:
  std::filesystem::path m_path;
};

struct InputResult {
  bool isRefused = false;
  std::string reason{}; // of the refusal
  std::string fault{};  // what is wrong with the scene or with the refusal itself; empty: nothing
};

// Loads the bytes as a .gltf or .glb with small limits (256 MiB, images of 256 texels a side); pose and choice of
// materials follow from their number. Whatever is thrown besides base::Error passes through.
InputResult loadGltfBytes(const InputFolder& folder, std::span<const std::byte> bytes);

// As .exr, .pfm or .hdr, by their first bytes.
InputResult loadEnvironmentBytes(const InputFolder& folder, std::span<const std::byte> bytes);

// As a picture for flip, a texture and a mask, with small limits (64 MiB, 1024 pixels a side).
InputResult loadImageBytes(const InputFolder& folder, std::span<const std::byte> bytes);

} // namespace parity::tests

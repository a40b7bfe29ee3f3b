// Small glTF files made by the tests themselves, and what tests of errors share.
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/expect_error.h"
#include "scenes/scene.h"

namespace parity::tests {

using base::expectError;

// A folder of its own for each test, removed with it.
class TempFolder {
public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return m_path / name; }
  const std::filesystem::path& path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

void writeFile(const std::filesystem::path& file, const std::string& text);
void writeFile(const std::filesystem::path& file, const std::vector<std::byte>& bytes);

// A document and its one buffer; tests edit `json` at will.
struct GltfFile {
  nlohmann::json json;
  std::vector<std::byte> bin;

  // Adds a buffer view (4-byte aligned) and an accessor; type: "VEC3"; returns the accessor's index.
  template <typename T> int add(const std::vector<T>& values, const char* type, bool normalized = false) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return addAccessor(bytes, componentTypeOf(T{}), values.size() / componentCount(type), type, normalized);
  }
  int addAccessor(const std::vector<std::byte>& bytes, int componentType, std::size_t count, const char* type,
                  bool normalized = false);
  int addBufferView(const std::vector<std::byte>& bytes);

  nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
  nlohmann::json& material() { return json["materials"][0]; }

  static std::size_t componentCount(const std::string& type);
  static int componentTypeOf(std::int8_t) { return 5120; }
  static int componentTypeOf(std::uint8_t) { return 5121; }
  static int componentTypeOf(std::int16_t) { return 5122; }
  static int componentTypeOf(std::uint16_t) { return 5123; }
  static int componentTypeOf(std::uint32_t) { return 5125; }
  static int componentTypeOf(float) { return 5126; }
};

// One quad of two triangles in z = 0, facing +Z: (0,0) to (1,1), indexed by 16 bits, with normals, uv (v down) and one
// material named "paint"; one node, one scene.
GltfFile makeQuad();

// Write the document into a folder; the path comes back. External: .gltf + .bin; embedded: a data uri.
std::string writeExternal(const TempFolder& folder, GltfFile file, const std::string& name = "scene");
std::string writeEmbedded(const TempFolder& folder, GltfFile file, const std::string& name = "scene");
std::vector<std::byte> makeGlb(const GltfFile& file);
std::string writeGlb(const TempFolder& folder, const GltfFile& file, const std::string& name = "scene");

std::string encodeBase64(const std::vector<std::byte>& bytes);

// A PNG of one colour.
std::vector<std::byte> makePng(int width, int height);

// Loads through every container (external, embedded, glb) and expects the same scene; returns it.
scenes::Scene loadQuadlike(const GltfFile& file);

// True where some warning holds `part`.
bool hasWarning(const std::vector<std::string>& warnings, const std::string& part);

} // namespace parity::tests

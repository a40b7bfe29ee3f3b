// Small glTF files made by the tests themselves.
#include "scenes/gltf/gltf_writer.h"

#include <fstream>
#include <stdexcept>

#include "base/file.h"
#include "base/image/image_io.h"
#include "scenes/load.h"

namespace parity::tests {

TempFolder::TempFolder() {
  // Not named by the process: a killed one's folder would be found full when its number comes round again.
  std::string name = (std::filesystem::temp_directory_path() / "parity-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
  m_path = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored; // a destructor cannot report it
  std::filesystem::remove_all(m_path, ignored);
}

void writeFile(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

void writeFile(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

std::size_t GltfFile::componentCount(const std::string& type) {
  return type == "SCALAR"
             ? 1
             : static_cast<std::size_t>(type.back() - '0') * (type.starts_with("MAT") ? type.back() - '0' : 1);
}

int GltfFile::addBufferView(const std::vector<std::byte>& bytes) {
  while (bin.size() % 4) bin.push_back(std::byte{0});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}});
  bin.insert(bin.end(), bytes.begin(), bytes.end());
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfFile::addAccessor(const std::vector<std::byte>& bytes, int componentType, std::size_t count, const char* type,
                          bool normalized) {
  nlohmann::json accessor = {
      {"bufferView", addBufferView(bytes)}, {"componentType", componentType}, {"count", count}, {"type", type}};
  if (normalized) accessor["normalized"] = true;
  json["accessors"].push_back(accessor);
  return static_cast<int>(json["accessors"].size()) - 1;
}

GltfFile makeQuad() {
  GltfFile file;
  file.json = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}, {"name", "quad"}}}},
               {"materials", {{{"name", "paint"}}}}};
  const int positions = file.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  const int normals = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int uv = file.add<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
  const int indices = file.add<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  file.json["meshes"] = {{{"name", "quad"},
                          {"primitives",
                           {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}},
                             {"indices", indices},
                             {"material", 0}}}}}};
  return file;
}

std::string writeExternal(const TempFolder& folder, GltfFile file, const std::string& name) {
  if (!file.json.contains("buffers"))
    file.json["buffers"] = {{{"uri", name + ".bin"}, {"byteLength", file.bin.size()}}};
  writeFile(folder / (name + ".bin"), file.bin);
  writeFile(folder / (name + ".gltf"), file.json.dump(1));
  return (folder / (name + ".gltf")).string();
}

std::string writeEmbedded(const TempFolder& folder, GltfFile file, const std::string& name) {
  file.json["buffers"] = {
      {{"uri", "data:application/octet-stream;base64," + encodeBase64(file.bin)}, {"byteLength", file.bin.size()}}};
  writeFile(folder / (name + "-embedded.gltf"), file.json.dump(1));
  return (folder / (name + "-embedded.gltf")).string();
}

std::vector<std::byte> makeGlb(const GltfFile& file) {
  nlohmann::json document = file.json;
  document["buffers"] = {{{"byteLength", file.bin.size()}}};
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> binary = file.bin;
  binary.resize((binary.size() + 3) / 4 * 4);
  std::vector<std::byte> glb;
  const auto addU32 = [&](std::size_t value) {
    for (int i = 0; i < 4; ++i) glb.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
  };
  addU32(0x46546C67);
  addU32(2);
  addU32(12 + 8 + text.size() + 8 + binary.size());
  addU32(text.size());
  addU32(0x4E4F534A);
  for (const char c : text) glb.push_back(static_cast<std::byte>(c));
  addU32(binary.size());
  addU32(0x004E4942);
  glb.insert(glb.end(), binary.begin(), binary.end());
  return glb;
}

std::string writeGlb(const TempFolder& folder, const GltfFile& file, const std::string& name) {
  writeFile(folder / (name + ".glb"), makeGlb(file));
  return (folder / (name + ".glb")).string();
}

std::string encodeBase64(const std::vector<std::byte>& bytes) {
  constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kAlphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::vector<std::byte> makePng(int width, int height) {
  const TempFolder folder;
  base::writeImage8(folder / "image.png", base::Image8(width, height, 4, 128));
  return base::readFile(folder / "image.png");
}

scenes::Scene loadQuadlike(const GltfFile& file) {
  const TempFolder folder;
  scenes::Scene external = scenes::loadScene(writeExternal(folder, file));
  for (const std::string& other : {writeEmbedded(folder, file), writeGlb(folder, file)}) {
    const scenes::Scene scene = scenes::loadScene(other);
    EXPECT_EQ(scene.meshes.size(), external.meshes.size()) << other;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
      EXPECT_EQ(scene.meshes[i].positions, external.meshes[i].positions) << other;
      EXPECT_EQ(scene.meshes[i].indices, external.meshes[i].indices) << other;
    }
    EXPECT_EQ(scene.warnings, external.warnings) << other;
  }
  return external;
}

bool hasWarning(const std::vector<std::string>& warnings, const std::string& part) {
  for (const std::string& warning : warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

} // namespace parity::tests

#include "study/sweep/scaling_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/image/image_io.h"

namespace parity::sweep {

namespace {

using Json = nlohmann::json;

// The bytes of scene.bin with the views and accessors that name them.
struct Buffer {
  std::vector<std::byte> bytes;
  Json views = Json::array(), accessors = Json::array();

  template <typename T>
  int add(const std::vector<T>& values, std::size_t count, int componentType, const char* type, int target) {
    const std::size_t size = values.size() * sizeof(T), offset = bytes.size();
    bytes.resize(offset + size);
    std::memcpy(bytes.data() + offset, values.data(), size);
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
    return static_cast<int>(accessors.size()) - 1;
  }
};

constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertices = 34962, kIndices = 34963;

// A square of side^2 quads from (x, z), `width` wide, with small waves, so that normals differ.
Json addField(Buffer& buffer, double x, double z, double width, int side, int material) {
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint32_t> indices;
  constexpr double kWave = 40, kWaveHeight = 0.004;
  float least = 1e9f, most = -1e9f;
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) {
      const double u = static_cast<double>(i) / side, v = static_cast<double>(j) / side;
      const double px = x + width * u, pz = z + width * v;
      const auto py = static_cast<float>(kWaveHeight * std::sin(kWave * px) * std::sin(kWave * pz));
      const double dx = kWaveHeight * kWave * std::cos(kWave * px) * std::sin(kWave * pz);
      const double dz = kWaveHeight * kWave * std::sin(kWave * px) * std::cos(kWave * pz);
      const double length = std::sqrt(dx * dx + dz * dz + 1);
      positions.insert(positions.end(), {static_cast<float>(px), py, static_cast<float>(pz)});
      normals.insert(normals.end(), {static_cast<float>(-dx / length), static_cast<float>(1 / length),
                                     static_cast<float>(-dz / length)});
      uvs.insert(uvs.end(), {static_cast<float>(u), static_cast<float>(v)});
      least = std::min(least, py);
      most = std::max(most, py);
      if (i == side || j == side) continue;
      const auto at = static_cast<std::uint32_t>(j * (side + 1) + i), below = at + static_cast<std::uint32_t>(side) + 1;
      indices.insert(indices.end(), {at, below, at + 1, at + 1, below, below + 1});
    }
  const std::size_t count = uvs.size() / 2;
  const int position = buffer.add(positions, count, kFloat, "VEC3", kVertices);
  buffer.accessors[static_cast<std::size_t>(position)]["min"] = {positions[0], least, positions[2]};
  buffer.accessors[static_cast<std::size_t>(position)]["max"] = {positions[positions.size() - 3], most,
                                                                 positions[positions.size() - 1]};
  const int normal = buffer.add(normals, count, kFloat, "VEC3", kVertices);
  const int uv = buffer.add(uvs, count, kFloat, "VEC2", kVertices);
  const int index = buffer.add(indices, indices.size(), kUnsignedInt, "SCALAR", kIndices);
  return {{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
          {"indices", index},
          {"material", material}};
}

// Colours without a pattern that a compressor would know.
void writeTexture(const std::filesystem::path& file, int side, int number) {
  base::Image8 image(side, side, 3);
  std::uint32_t state = 12345u + 977u * static_cast<std::uint32_t>(number);
  for (std::uint8_t& value : image.pixels) {
    state = state * 1664525u + 1013904223u;
    value = static_cast<std::uint8_t>(96 + (state >> 26));
  }
  base::writeImage8(file, image);
}

Json lightsOf(int count) {
  Json lights = Json::array();
  for (int i = 0; i < count; ++i)
    lights.push_back({{"type", "point"}, {"intensity", 2.0 / count}, {"color", {1, 1, 1}}});
  return lights;
}

} // namespace

std::filesystem::path writeScalingScene(const std::filesystem::path& folder, const SceneSize& size) {
  const int grid = static_cast<int>(std::ceil(std::sqrt(size.materials)));
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * size.triangles / size.materials))));
  const double width = 1.0 / grid;
  Buffer buffer;
  Json meshes = Json::array(), nodes = Json::array(), materials = Json::array(), images = Json::array(),
       textures = Json::array(), roots = Json::array();
  for (int m = 0; m < size.materials; ++m) {
    const int column = m % grid, row = m / grid;
    meshes.push_back({{"primitives", {addField(buffer, column * width, row * width, width, side, m)}}});
    roots.push_back(nodes.size());
    nodes.push_back({{"mesh", m}});
    Json pbr = {{"metallicFactor", m % 2 ? 1.0 : 0.0}, {"roughnessFactor", 0.2 + 0.6 * (m % 7) / 6.0}};
    if (m < size.textures) {
      const std::string name = "texture" + std::to_string(m) + ".png";
      writeTexture(folder / name, size.textureSide, m);
      images.push_back({{"uri", name}});
      textures.push_back({{"source", m}});
      pbr["baseColorTexture"] = {{"index", m}};
    }
    materials.push_back({{"name", "field " + std::to_string(m)}, {"pbrMetallicRoughness", pbr}});
  }
  for (int i = 0; i < size.lights; ++i) {
    // Points of a golden spiral over the plane.
    const double radius = 0.6 * std::sqrt((i + 0.5) / size.lights), angle = 2.399963 * i;
    roots.push_back(nodes.size());
    nodes.push_back({{"translation", {0.5 + radius * std::cos(angle), 0.5, 0.5 + radius * std::sin(angle)}},
                     {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  Json gltf = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", roots}}}},
               {"nodes", nodes},
               {"meshes", meshes},
               {"materials", materials},
               {"accessors", buffer.accessors},
               {"bufferViews", buffer.views},
               {"buffers", {{{"uri", "scene.bin"}, {"byteLength", buffer.bytes.size()}}}}};
  if (size.textures > 0) {
    gltf["images"] = images;
    gltf["textures"] = textures;
  }
  if (size.lights > 0) {
    gltf["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf["extensions"] = {{"KHR_lights_punctual", {{"lights", lightsOf(size.lights)}}}};
  }
  base::writeBytes(folder / "scene.bin", buffer.bytes);
  base::writeText(folder / "scene.gltf", gltf.dump());
  return folder / "scene.gltf";
}

} // namespace parity::sweep

// A binary glTF file while it is put together: its views, its JSON, its container.
#include "scenes/gltf/glb_draft.h"

#include <cstdint>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

namespace parity::scenes {

namespace {

// The length fields of a .glb have 32 bits.
constexpr std::size_t kMaxGlbBytes = std::numeric_limits<std::uint32_t>::max();

// The JSON text of the file. tinygltf writes "zfar": 0 for an infinite camera, which glTF forbids (5.26.3), and would
// copy the buffer twice.
std::string writeJson(GlbDraft& draft) {
  draft.model.extensionsUsed.assign(draft.extensions.begin(), draft.extensions.end());
  std::ostringstream stream;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&draft.model, stream, false, false))
    throw draft.error("", "the glTF library cannot write it");
  nlohmann::json json = nlohmann::json::parse(stream.str());
  if (!draft.binary.empty()) json["buffers"] = {{{"byteLength", draft.binary.size()}}};
  if (const auto cameras = json.find("cameras"); cameras != json.end())
    for (nlohmann::json& camera : *cameras)
      if (const auto perspective = camera.find("perspective");
          perspective != camera.end() && (*perspective)["zfar"] == 0)
        perspective->erase("zfar");
  return json.dump();
}

void appendU32(std::vector<std::byte>& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(value >> shift & 0xff));
}

} // namespace

int GlbDraft::addView(std::span<const std::byte> bytes, int target) {
  binary.resize((binary.size() + 3) / 4 * 4);
  if (bytes.size() > kMaxGlbBytes - binary.size()) throw error("", "needs more than the 4 GiB that a .glb file has");
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = binary.size();
  view.byteLength = bytes.size();
  view.target = target;
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  model.bufferViews.push_back(std::move(view));
  return static_cast<int>(model.bufferViews.size() - 1);
}

void GlbDraft::addNode(tinygltf::Node node) {
  model.scenes.front().nodes.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(std::move(node));
}

tinygltf::Value gltfArray(std::span<const double> numbers) {
  tinygltf::Value::Array values;
  for (const double number : numbers) values.emplace_back(number);
  return tinygltf::Value(std::move(values));
}

std::vector<double> gltfMatrix(const glm::dmat4& matrix) {
  std::vector<double> numbers;
  if (matrix == glm::dmat4(1.0)) return numbers;
  for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
  return numbers;
}

// The container (glTF 2.0, 4.4): a header of 12 bytes, then chunks with headers of 8, padded to multiples of 4.
std::vector<std::byte> packGlb(GlbDraft& draft) {
  std::string json = writeJson(draft);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t binary = (draft.binary.size() + 3) / 4 * 4;
  const std::size_t length = 12 + 8 + json.size() + (binary > 0 ? 8 + binary : 0);
  if (length > kMaxGlbBytes) throw draft.error("", "needs more than the 4 GiB that a .glb file has");
  std::vector<std::byte> bytes;
  bytes.reserve(length);
  for (const std::size_t field :
       {std::size_t{0x46546C67}, std::size_t{2}, length, json.size(), std::size_t{0x4E4F534A}})
    appendU32(bytes, field); // "glTF", version, ..., "JSON"
  const auto text = std::as_bytes(std::span(json));
  bytes.insert(bytes.end(), text.begin(), text.end());
  if (binary == 0) return bytes;
  appendU32(bytes, binary);
  appendU32(bytes, 0x004E4942); // "BIN"
  bytes.insert(bytes.end(), draft.binary.begin(), draft.binary.end());
  bytes.resize(length);
  return bytes;
}

} // namespace parity::scenes

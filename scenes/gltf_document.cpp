// Reads a glTF file: container, JSON, buffers, extensions.
#include "scenes/gltf_document.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "scenes/gltf_container.h"
#include "scenes/gltf_json.h"
#include "scenes/gltf_uri.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

using Json = nlohmann::json;

// The length field of a glb has 32 bits; JSON text is bounded further, it is held three times while it is parsed.
constexpr std::size_t kMaxJsonBytes = std::size_t{512} << 20;

constexpr std::array kSupportedExtensions = {
    "KHR_texture_transform",           "KHR_lights_punctual", "KHR_materials_specular", "KHR_materials_ior",
    "KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_mesh_quantization"};

// A file that a uri names; errors speak of the uri's place, not of a path that the user never wrote.
std::filesystem::path resolve(const GltfDocument& document, const std::filesystem::path& folder, const std::string& uri,
                              const std::string& place) {
  try {
    return resolveUri(folder, uri);
  } catch (const std::invalid_argument& reason) {
    throw document.error(place, reason.what());
  }
}

std::vector<std::byte> decodeData(const GltfDocument& document, const std::string& uri, const std::string& place) {
  try {
    return decodeDataUri(uri);
  } catch (const std::invalid_argument& reason) {
    throw document.error(place, reason.what());
  }
}

void readBuffers(GltfDocument& document, const Json& json, const std::filesystem::path& folder,
                 std::span<const std::byte> binary, bool hasBinary) {
  const auto list = json.find("buffers");
  if (list == json.end()) return;
  std::size_t total = binary.size();
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& buffer = (*list)[i];
    const std::string place = fmt::format("buffers[{}]", i);
    const std::size_t length = buffer["byteLength"].get<std::size_t>();
    std::span<const std::byte> bytes;
    if (const auto found = buffer.find("uri"); found != buffer.end()) {
      const std::string& uri = found->get_ref<const std::string&>();
      if (isDataUri(uri))
        document.storage.push_back(decodeData(document, uri, place + ".uri"));
      else {
        const std::filesystem::path path = resolve(document, folder, uri, place + ".uri");
        try {
          document.storage.push_back(base::readFile(path, base::kMaxFileBytes - std::min(total, base::kMaxFileBytes)));
          const std::filesystem::path asset = std::filesystem::path(document.label).parent_path();
          document.sources.push_back(sourceFile(nameOfUri(asset, uri), document.storage.back()));
        } catch (const base::Error& error) {
          throw document.error(place + ".uri", fmt::format("'{}': {}", cleanName(uri), error.reason()));
        }
      }
      bytes = document.storage.back();
      total += bytes.size();
    } else if (i == 0 && hasBinary)
      bytes = binary;
    else
      throw document.error(place, "has neither a uri nor the container's binary chunk");
    if (bytes.size() < length)
      throw document.error(place, fmt::format("holds {} bytes where byteLength says {}", bytes.size(), length));
    document.buffers.push_back(bytes.first(length));
  }
}

void checkBufferViews(const GltfDocument& document, const Json& json) {
  const auto list = json.find("bufferViews");
  if (list == json.end()) return;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& view = (*list)[i];
    const auto fail = [&](const std::string& reason) {
      return document.error(fmt::format("bufferViews[{}]", i), reason);
    };
    const std::size_t offset = view.value("byteOffset", std::size_t{0});
    const std::size_t length = view["byteLength"].get<std::size_t>();
    const std::size_t size = document.buffers[view["buffer"].get<std::size_t>()].size();
    if (length == 0) throw fail("a byteLength of 0");
    if (offset > size || length > size - offset)
      throw fail(fmt::format("bytes {} to {} leave its buffer of {} bytes", offset, offset + length, size));
    if (const auto stride = view.find("byteStride"); stride != view.end()) {
      const std::size_t value = stride->get<std::size_t>();
      if (value < 4 || value > 252 || value % 4)
        throw fail(fmt::format("a byteStride of {} is not a multiple of 4 from 4 to 252", value));
    }
  }
}

void listImages(GltfDocument& document, const Json& json, const std::filesystem::path& folder) {
  const auto list = json.find("images");
  if (list == json.end()) return;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& image = (*list)[i];
    const std::string place = fmt::format("images[{}]", i);
    GltfImageSource source;
    source.name = cleanName(image.value("name", std::string{}));
    const auto uri = image.find("uri");
    source.bufferView = image.value("bufferView", -1);
    if ((uri == image.end()) == (source.bufferView < 0))
      throw document.error(place, "needs either a uri or a bufferView");
    if (uri != image.end()) {
      const std::string& text = uri->get_ref<const std::string&>();
      if (isDataUri(text))
        source.embedded = decodeData(document, text, place + ".uri");
      else {
        source.file = resolve(document, folder, text, place + ".uri");
        source.named = nameOfUri(std::filesystem::path(document.label).parent_path(), text);
        if (source.name.empty()) source.name = cleanName(text);
      }
    }
    if (source.name.empty()) source.name = fmt::format("image {}", i);
    document.images.push_back(std::move(source));
  }
}

void checkExtensions(GltfDocument& document, const Json& json) {
  const auto listUnsupported = [&](const char* key) {
    std::vector<std::string> names;
    if (const auto list = json.find(key); list != json.end())
      for (const Json& entry : *list) {
        const std::string name = cleanName(entry.get<std::string>());
        if (std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), name) == kSupportedExtensions.end() &&
            std::find(names.begin(), names.end(), name) == names.end() && names.size() < 32)
          names.push_back(name);
      }
    return names;
  };
  if (const auto names = listUnsupported("extensionsRequired"); !names.empty())
    throw document.error("extensionsRequired", fmt::format("not supported: {}", fmt::join(names, ", ")));
  if (const auto names = listUnsupported("extensionsUsed"); !names.empty())
    document.warnings.push_back(fmt::format("extensions not supported, ignored: {}", fmt::join(names, ", ")));
}

void parseModel(GltfDocument& document, Json& json) {
  for (const char* key : {"skins", "animations"})
    if (const auto list = json.find(key); list != json.end() && !list->empty())
      document.warnings.push_back(
          fmt::format("{} are not supported, ignored: {}", key,
                      key == std::string_view("skins") ? "meshes are shown as they are stored" : "nothing moves"));
  for (const char* key : {"buffers", "images", "skins", "animations", "extras"}) json.erase(key);
  const std::string text = json.dump();
  json = nullptr;
  tinygltf::TinyGLTF parser;
  std::string error, warning;
  const bool parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(),
                                                 static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
  if (!parsed || !error.empty()) throw document.error("", error.empty() ? "not understood by the glTF parser" : error);
}

} // namespace

std::span<const std::byte> GltfDocument::bufferView(int index) const {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
  return buffers[static_cast<std::size_t>(view.buffer)].subspan(view.byteOffset, view.byteLength);
}

GltfDocument readGltfDocument(const std::string& file) {
  GltfDocument document;
  document.label = file;
  std::vector<std::byte> bytes;
  std::error_code failed;
  const std::filesystem::path path(file);
  const std::filesystem::path folder =
      std::filesystem::canonical(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."), failed);
  try {
    bytes = base::readFile(path);
  } catch (const base::Error& error) {
    throw document.error("", error.reason());
  }
  document.sources.push_back(sourceFile(path, bytes));
  if (failed) throw document.error("", "its folder cannot be resolved: " + failed.message());
  if (bytes.empty()) throw document.error("", "the file is empty");

  GlbChunks chunks;
  if (isGlb(bytes))
    chunks = splitGlb(bytes, file);
  else
    chunks.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  if (chunks.json.size() > kMaxJsonBytes)
    throw document.error("JSON", fmt::format("larger than {} MiB", kMaxJsonBytes >> 20));

  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1); // padding that some exporters write
  Json json = parseGltfJson(chunks.json, file);
  checkGltfSchema(json, file);
  checkExtensions(document, json);
  if (chunks.hasBinary) document.storage.push_back(std::move(bytes)); // the vector's memory, and so the span, stays
  readBuffers(document, json, folder, chunks.binary, chunks.hasBinary);
  checkBufferViews(document, json);
  listImages(document, json, folder);
  try {
    parseModel(document, json);
  } catch (const base::Error&) {
    throw;
  } catch (const std::exception& error) { // whatever the parser lets through
    throw document.error("", error.what());
  }
  return document;
}

} // namespace parity::scenes

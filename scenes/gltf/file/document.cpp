// Reads a glTF file: container, JSON, checks, model.
#include "scenes/gltf/file/document.h"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/text/error_words.h"
#include "scenes/gltf/file/container.h"
#include "scenes/gltf/file/extensions.h"
#include "scenes/gltf/file/json.h"
#include "scenes/gltf/file/structure.h"
#include "scenes/gltf/file/uri.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

using Json = nlohmann::json;

// The length field of a glb has 32 bits; JSON text is bounded further, it is held three times while it is parsed.
constexpr std::size_t kMaxJsonBytes = std::size_t{512} << 20;

void readBytes(GltfDocument& document) {
  const std::filesystem::path path(document.label);
  try {
    const std::size_t bytes = base::regularFileSize(path);
    document.memory.take(bytes, "");
    document.bytes = base::readFile(path, bytes);
  } catch (const base::Error& error) {
    throw document.error("", error.reason());
  }
  document.source = sourceFile(path, document.bytes);
  if (document.bytes.empty()) throw document.error("", "the file is empty");
}

// Whether the file is called a glb and is no JSON text either, which some exporters give that name.
bool isNamedGlb(const GltfDocument& document) {
  std::string extension = std::filesystem::path(document.label).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto first = std::ranges::find_if_not(document.bytes, [](std::byte b) {
    return b == std::byte{' '} || b == std::byte{'\t'} || b == std::byte{'\r'} || b == std::byte{'\n'};
  });
  return extension == ".glb" && (first == document.bytes.end() || *first != std::byte{'{'});
}

std::filesystem::path folderOf(const GltfDocument& document) {
  const std::filesystem::path path(document.label);
  std::error_code failed;
  std::filesystem::path folder =
      std::filesystem::canonical(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."), failed);
  if (failed) throw document.error("", "its folder cannot be found: " + failed.message());
  return folder;
}

// Images are named and their uris judged; none is opened.
void listImages(GltfDocument& document, const Json& json, const GltfPlace& where, Problems& problems) {
  const auto list = json.find("images");
  if (list == json.end()) return;
  std::map<std::string, int> known; // by file or buffer view
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& image = (*list)[i];
    const std::string place = fmt::format("/images/{}/uri", i);
    GltfImageSource source;
    source.name = cleanName(image.value("name", std::string{}));
    source.bufferView = image.value("bufferView", -1);
    if (const auto uri = image.find("uri"); uri != image.end())
      problems.attempt([&] {
        const std::string& text = uri->get_ref<const std::string&>();
        if (isDataUri(text)) {
          document.memory.take(text.size() / 4 * 3, place);
          source.embedded = decodeDataUriAt(where, text, place);
        } else {
          const GltfFileUri file = resolveFileUri(where, text, place);
          source.file = file.file;
          source.named = file.named;
          if (source.name.empty()) source.name = cleanName(text);
        }
      });
    if (source.name.empty()) source.name = fmt::format("image {}", i);
    const std::string key = !source.file.empty()     ? "file " + source.file.string()
                            : source.bufferView >= 0 ? fmt::format("view {}", source.bufferView)
                                                     : fmt::format("image {}", i);
    document.firstOfImage.push_back(known.try_emplace(key, static_cast<int>(i)).first->second);
    document.images.push_back(std::move(source));
  }
}

std::vector<std::string> namesOf(const Json& json, const char* key) {
  std::vector<std::string> names;
  if (const auto list = json.find(key); list != json.end())
    for (const Json& entry : *list)
      names.push_back(cleanName(entry.is_string() ? entry.get<std::string>() : entry.value("name", std::string{})));
  return names;
}

// What `parity info` says of the file beyond the scene.
SourceFacts readFacts(const Json& json) {
  SourceFacts facts;
  facts.version = cleanName(json["asset"]["version"].get<std::string>());
  facts.generator = cleanName(json["asset"].value("generator", std::string{}));
  facts.copyright = cleanName(json["asset"].value("copyright", std::string{}));
  facts.extensionsUsed = namesOf(json, "extensionsUsed");
  facts.extensionsRequired = namesOf(json, "extensionsRequired");
  facts.scenes = namesOf(json, "scenes");
  facts.animations = namesOf(json, "animations");
  for (const char* key : {"nodes", "meshes", "skins", "textures", "images", "accessors", "bufferViews", "buffers"})
    if (const auto list = json.find(key); list != json.end()) facts.counts.emplace_back(key, list->size());
  if (const auto extensions = json.find("extensions"); extensions != json.end())
    if (const auto variants = extensions->find("KHR_materials_variants"); variants != extensions->end())
      facts.variants = namesOf(*variants, "variants");
  return facts;
}

// What the parser and we make of each entry, roughly, before it is made.
void chargeEntries(GltfDocument& document, const Json& json) {
  struct Size {
    const char* key;
    std::size_t bytes;
  };
  for (const Size& size : {Size{"materials", 4096},
                           {"nodes", 1024},
                           {"meshes", 1024},
                           {"accessors", 512},
                           {"bufferViews", 512},
                           {"textures", 512},
                           {"images", 512},
                           {"samplers", 256},
                           {"cameras", 512},
                           {"skins", 512},
                           {"animations", 512},
                           {"scenes", 256}})
    if (const auto list = json.find(size.key); list != json.end())
      document.memory.take(list->size() * size.bytes, fmt::format("/{}", size.key));
}

void parseModel(GltfDocument& document, Json& json) {
  for (const char* key : {"buffers", "images", "extras"}) json.erase(key);
  // What glTF lets out and the parser asks for.
  std::vector<std::size_t> withoutView;
  if (const auto accessors = json.find("accessors"); accessors != json.end() && json.contains("bufferViews"))
    for (std::size_t i = 0; i < accessors->size(); ++i)
      if ((*accessors)[i].emplace("bufferView", 0).second) withoutView.push_back(i);
  if (const auto skins = json.find("skins"); skins != json.end())
    for (Json& skin : *skins) skin.emplace("inverseBindMatrices", -1);
  if (const auto animations = json.find("animations"); animations != json.end())
    for (Json& animation : *animations)
      for (Json& channel : animation["channels"]) channel["target"].emplace("node", -1);
  const std::string text = json.dump();
  json = nullptr;
  tinygltf::TinyGLTF parser;
  std::string error, warning;
  const bool parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(),
                                                 static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
  if (!parsed || !error.empty()) throw document.error("", error.empty() ? "the glTF parser cannot read it" : error);
  for (const std::size_t i : withoutView) document.model.accessors[i].bufferView = -1;
}

} // namespace

std::unique_ptr<GltfDocument> readGltfDocument(const std::string& file, const LoadOptions& options) {
  auto document = std::make_unique<GltfDocument>(file, options);
  readBytes(*document);
  const GltfPlace where{file, folderOf(*document)};

  GlbChunks chunks;
  if (isGlb(document->bytes) || isNamedGlb(*document))
    chunks = splitGlb(document->bytes, file);
  else
    chunks.json = {reinterpret_cast<const char*>(document->bytes.data()), document->bytes.size()};
  if (chunks.json.size() > kMaxJsonBytes)
    throw document->error("JSON", fmt::format("is larger than {} MiB", kMaxJsonBytes >> 20));

  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1); // padding that some exporters write
  Json json = parseGltfJson(chunks.json, file);
  if (!chunks.hasBinary) std::vector<std::byte>().swap(document->bytes);
  Problems problems(file);
  checkGltfSchema(json, problems);
  problems.throwIfAny(); // what follows takes the types for granted
  checkGltfExtensions(json, problems, document->warnings);
  checkGltfStructure(json, problems);
  problems.attempt([&] {
    document->buffers = std::make_unique<GltfBuffers>(json, where, chunks.binary, chunks.hasBinary, document->memory);
  });
  listImages(*document, json, where, problems);
  problems.throwIfAny();
  chargeEntries(*document, json);
  document->facts = readFacts(json);
  try {
    parseModel(*document, json);
  } catch (const base::Error&) {
    throw;
  } catch (const std::exception& error) { // whatever the parser lets through
    throw document->error("", base::wordsOf(error));
  }
  return document;
}

} // namespace parity::scenes

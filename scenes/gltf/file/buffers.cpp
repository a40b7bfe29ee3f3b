// The buffers of a glTF file, read on first use.
#include "scenes/gltf/file/buffers.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "scenes/gltf/file/meshopt.h"
#include "scenes/gltf/file/structure.h"
#include "scenes/gltf/file/uri.h"
#include "scenes/names.h"

namespace parity::scenes {

struct GltfBuffers::Buffer {
  std::string uri;
  bool hasUri = false;
  GltfFileUri file; // empty for data uris and the container's chunk
  std::size_t byteLength = 0;
  std::once_flag isRead;
  std::optional<base::Error> failure; // told to whoever asks
  std::vector<std::byte> storage;
  std::span<const std::byte> bytes; // of exactly byteLength
  SourceFile source;
};

struct GltfBuffers::View {
  std::size_t buffer = 0, byteOffset = 0, byteLength = 0; // of the compressed bytes where there are such
  std::optional<MeshoptLayout> packed;
  std::once_flag isDecoded;
  std::optional<base::Error> failure;
  std::vector<std::byte> decoded;
};

namespace {

// Does the work once, whoever asks first; its failure is kept and told to all.
template <typename Work> void once(std::once_flag& flag, std::optional<base::Error>& failure, const Work& work) {
  std::call_once(flag, [&] {
    try {
      work();
    } catch (const base::Error& error) {
      failure = error;
    }
  });
  if (failure) throw base::Error(*failure);
}

const nlohmann::json* findMeshopt(const nlohmann::json& view) {
  const auto extensions = view.find("extensions");
  if (extensions == view.end()) return nullptr;
  const auto found = extensions->find("EXT_meshopt_compression");
  return found == extensions->end() ? nullptr : &*found;
}

} // namespace

GltfFileUri resolveFileUri(const GltfPlace& where, const std::string& uri, const std::string& place) {
  try {
    return {resolveUri(where.folder, uri), nameOfUri(std::filesystem::path(where.label).parent_path(), uri)};
  } catch (const std::invalid_argument& reason) {
    throw base::fileError(where.label, place, reason.what());
  }
}

std::vector<std::byte> decodeDataUriAt(const GltfPlace& where, const std::string& uri, const std::string& place) {
  try {
    return decodeDataUri(uri);
  } catch (const std::invalid_argument& reason) {
    throw base::fileError(where.label, place, reason.what());
  }
}

GltfBuffers::GltfBuffers(const nlohmann::json& document, const GltfPlace& where, std::span<const std::byte> binary,
                         bool hasBinary, MemoryBudget& budget)
    : m_where(where), m_binary(binary), m_hasBinary(hasBinary), m_budget(budget) {
  if (const auto list = document.find("buffers"); list != document.end())
    for (std::size_t i = 0; i < list->size(); ++i) {
      const nlohmann::json& source = (*list)[i];
      auto buffer = std::make_unique<Buffer>();
      buffer->byteLength = source["byteLength"].get<std::size_t>();
      buffer->hasUri = source.contains("uri");
      if (buffer->hasUri) {
        buffer->uri = source["uri"].get<std::string>();
        if (!isDataUri(buffer->uri))
          buffer->file = resolveFileUri(where, buffer->uri, fmt::format("/buffers/{}/uri", i));
      }
      m_buffers.push_back(std::move(buffer));
    }
  if (const auto list = document.find("bufferViews"); list != document.end())
    for (const nlohmann::json& source : *list) {
      const nlohmann::json* packed = findMeshopt(source);
      const nlohmann::json& bytes = packed ? *packed : source;
      auto view = std::make_unique<View>();
      view->buffer = bytes["buffer"].get<std::size_t>();
      view->byteOffset = bytes.value("byteOffset", std::size_t{0});
      view->byteLength = bytes["byteLength"].get<std::size_t>();
      if (packed) view->packed = meshoptLayoutOf(*packed);
      m_views.push_back(std::move(view));
    }
}

GltfBuffers::~GltfBuffers() = default;

std::span<const std::byte> GltfBuffers::view(int index) const {
  View& view = *m_views[static_cast<std::size_t>(index)];
  if (!view.packed) return buffer(view.buffer).subspan(view.byteOffset, view.byteLength);
  once(view.isDecoded, view.failure, [&] { decode(static_cast<std::size_t>(index)); });
  return view.decoded;
}

void GltfBuffers::decode(std::size_t index) const {
  View& view = *m_views[index];
  const std::string place = fmt::format("/bufferViews/{}/extensions/EXT_meshopt_compression", index);
  const std::span<const std::byte> packed = buffer(view.buffer).subspan(view.byteOffset, view.byteLength);
  m_budget.take(view.packed->count * view.packed->byteStride, place);
  try {
    view.decoded = decodeMeshopt(packed, *view.packed);
  } catch (const std::invalid_argument& reason) {
    m_budget.release(view.packed->count * view.packed->byteStride);
    throw base::fileError(m_where.label, place, reason.what());
  }
}

std::span<const std::byte> GltfBuffers::buffer(std::size_t index) const {
  Buffer& buffer = *m_buffers[index];
  once(buffer.isRead, buffer.failure, [&] {
    const std::string place = fmt::format("/buffers/{}", index);
    if (buffer.hasUri)
      read(buffer, place + "/uri");
    else if (index == 0 && m_hasBinary)
      buffer.bytes = m_binary;
    else
      throw base::fileError(m_where.label, place, "has no uri, and the file has no binary chunk");
    if (const std::size_t held = buffer.bytes.size(); held < buffer.byteLength) {
      m_budget.release(buffer.storage.size());
      std::vector<std::byte>().swap(buffer.storage);
      throw base::fileError(m_where.label, place,
                            fmt::format("holds {} bytes, expected {}, its byteLength", held, buffer.byteLength));
    }
    buffer.bytes = buffer.bytes.first(buffer.byteLength);
  });
  return buffer.bytes;
}

void GltfBuffers::read(Buffer& buffer, const std::string& place) const {
  if (buffer.file.file.empty()) {
    buffer.storage = decodeDataUriAt(m_where, buffer.uri, place);
    m_budget.take(buffer.storage.size(), place);
  } else {
    try {
      const std::size_t bytes = base::regularFileSize(buffer.file.file);
      m_budget.take(bytes, place);
      buffer.storage = base::readFile(buffer.file.file, bytes);
    } catch (const base::Error& error) {
      if (error.subject() == m_where.label) throw; // the budget's
      throw base::fileError(m_where.label, place, fmt::format("'{}': {}", cleanName(buffer.uri), error.reason()));
    }
    buffer.source = sourceFile(buffer.file.named, buffer.storage);
  }
  buffer.bytes = buffer.storage;
}

std::vector<SourceFile> GltfBuffers::sources() const {
  std::vector<SourceFile> sources;
  for (const auto& buffer : m_buffers)
    if (!buffer->source.file.empty()) sources.push_back(buffer->source);
  return sources;
}

} // namespace parity::scenes

// Typed, checked reading of accessors.
#include "scenes/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace parity::scenes {
namespace {

template <typename T> T load(const std::byte* bytes) { // buffers are little-endian, as the machines we run on
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

std::size_t bytesOf(int componentType) {
  switch (componentType) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return 1;
  case TINYGLTF_COMPONENT_TYPE_SHORT:
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return 2;
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
  case TINYGLTF_COMPONENT_TYPE_FLOAT:
    return 4;
  default:
    return 0;
  }
}

int componentsOf(int type) {
  switch (type) {
  case TINYGLTF_TYPE_SCALAR:
    return 1;
  case TINYGLTF_TYPE_VEC2:
    return 2;
  case TINYGLTF_TYPE_VEC3:
    return 3;
  case TINYGLTF_TYPE_VEC4:
    return 4;
  default:
    return 0; // matrices are neither attributes nor indices
  }
}

} // namespace

AccessorView::AccessorView(const GltfDocument& document, int accessor, std::string place)
    : m_document(&document), m_place(fmt::format("{}: accessors[{}]", place, accessor)) {
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  if (source.sparse.isSparse) throw document.error(m_place, "sparse accessors are not supported");
  if (source.bufferView < 0) throw document.error(m_place, "has no bufferView");
  m_componentType = source.componentType;
  m_componentBytes = bytesOf(m_componentType);
  if (!m_componentBytes) throw document.error(m_place, fmt::format("componentType {} is not valid", m_componentType));
  m_componentCount = componentsOf(source.type);
  if (!m_componentCount) throw document.error(m_place, "a matrix where a scalar or vector is needed");
  m_count = source.count;
  m_normalized = source.normalized;
  if (m_count == 0) throw document.error(m_place, "a count of 0");

  const tinygltf::BufferView& view = document.model.bufferViews[static_cast<std::size_t>(source.bufferView)];
  m_bytes = document.bufferView(source.bufferView);
  const std::size_t elementBytes = m_componentBytes * static_cast<std::size_t>(m_componentCount);
  m_stride = view.byteStride ? view.byteStride : elementBytes;
  if (m_stride < elementBytes || m_stride % m_componentBytes)
    throw document.error(m_place,
                         fmt::format("a byteStride of {} does not fit elements of {} bytes", m_stride, elementBytes));
  if (source.byteOffset % m_componentBytes || (view.byteOffset + source.byteOffset) % m_componentBytes)
    throw document.error(m_place,
                         fmt::format("byteOffset {} is not aligned to {} bytes", source.byteOffset, m_componentBytes));
  // count, stride and offsets are below 2^31 each: no overflow in 64 bits.
  const std::size_t end = source.byteOffset + m_stride * (m_count - 1) + elementBytes;
  if (end > m_bytes.size())
    throw document.error(m_place, fmt::format("{} elements end at byte {} of bufferViews[{}], which has {}", m_count,
                                              end, source.bufferView, m_bytes.size()));
  m_bytes = m_bytes.subspan(source.byteOffset);
}

bool AccessorView::isFloat() const { return m_componentType == TINYGLTF_COMPONENT_TYPE_FLOAT; }

float AccessorView::at(std::size_t element, int component) const {
  const std::byte* bytes = m_bytes.data() + element * m_stride + static_cast<std::size_t>(component) * m_componentBytes;
  const auto decode = [&](auto value, float maximum) {
    const float number = static_cast<float>(value);
    return m_normalized ? std::max(number / maximum, -1.f) : number;
  };
  switch (m_componentType) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return decode(load<std::int8_t>(bytes), 127.f);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return decode(load<std::uint8_t>(bytes), 255.f);
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return decode(load<std::int16_t>(bytes), 32767.f);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return decode(load<std::uint16_t>(bytes), 65535.f);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return static_cast<float>(load<std::uint32_t>(bytes));
  default:
    return load<float>(bytes);
  }
}

template <typename Vec> std::vector<Vec> AccessorView::readVectors(float fill, bool finite) const {
  std::vector<Vec> out(m_count, Vec(fill));
  const int components = std::min<int>(m_componentCount, Vec::length());
  for (std::size_t i = 0; i < m_count; ++i)
    for (int c = 0; c < components; ++c) {
      const float value = at(i, c);
      if (finite && !std::isfinite(value)) throw m_document->error(m_place, fmt::format("element {} is not finite", i));
      out[i][c] = value;
    }
  return out;
}

std::vector<glm::vec2> AccessorView::readVec2() const { return readVectors<glm::vec2>(0.f, true); }
std::vector<glm::vec3> AccessorView::readVec3() const { return readVectors<glm::vec3>(0.f, true); }
std::vector<glm::vec4> AccessorView::readVec4(float fill) const { return readVectors<glm::vec4>(fill, true); }
std::vector<glm::vec3> AccessorView::readVec3Unchecked() const { return readVectors<glm::vec3>(0.f, false); }
std::vector<glm::vec4> AccessorView::readVec4Unchecked() const { return readVectors<glm::vec4>(0.f, false); }

std::vector<std::uint32_t> AccessorView::readIndices(std::size_t limit) const {
  const bool isUnsigned = m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (m_componentCount != 1 || !isUnsigned || m_normalized)
    throw m_document->error(m_place, "indices are not scalars of an unsigned integer type");
  std::vector<std::uint32_t> out(m_count);
  for (std::size_t i = 0; i < m_count; ++i) {
    const std::byte* bytes = m_bytes.data() + i * m_stride;
    out[i] = m_componentBytes == 1   ? load<std::uint8_t>(bytes)
             : m_componentBytes == 2 ? load<std::uint16_t>(bytes)
                                     : load<std::uint32_t>(bytes);
    if (out[i] >= limit)
      throw m_document->error(
          m_place, fmt::format("index {} at element {} is out of range: there are {} vertices", out[i], i, limit));
  }
  return out;
}

} // namespace parity::scenes

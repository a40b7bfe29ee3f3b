// Typed, checked reading of accessors.
#include "scenes/gltf/file/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "scenes/gltf/file/structure.h"

namespace parity::scenes {
namespace {

template <typename T> T load(const std::byte* bytes) { // buffers are little-endian, as the machines we run on
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

// Calls body(T{}) for the C++ type of a component type.
template <typename Body> void withType(int componentType, const Body& body) {
  switch (componentType) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return body(std::int8_t{});
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return body(std::uint8_t{});
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return body(std::int16_t{});
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return body(std::uint16_t{});
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return body(std::uint32_t{});
  default:
    return body(float{});
  }
}

// `components` numbers of type T every `stride` bytes, as floats `width` apart.
template <typename T> void decode(const std::byte* bytes, std::size_t stride, std::size_t count, std::size_t components,
                                  bool normalized, float* out, std::size_t width) {
  constexpr float kMaximum = static_cast<float>(std::numeric_limits<T>::max());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < components; ++c) {
      const float value = static_cast<float>(load<T>(bytes + i * stride + c * sizeof(T)));
      if constexpr (std::is_integral_v<T>)
        out[i * width + c] = normalized ? std::max(value / kMaximum, -1.f) : value;
      else
        out[i * width + c] = value;
    }
}

// Each column of a matrix begins at a multiple of 4 bytes (glTF 2.0, 3.6.2.4).
std::size_t bytesOfElement(int type, int componentType) {
  const std::size_t component = bytesOfComponent(componentType);
  const auto columnsOf = [&](std::size_t columns) { return (columns * component + 3) / 4 * 4 * columns; };
  switch (type) {
  case TINYGLTF_TYPE_MAT2:
    return columnsOf(2);
  case TINYGLTF_TYPE_MAT3:
    return columnsOf(3);
  case TINYGLTF_TYPE_MAT4:
    return columnsOf(4);
  default:
    return component * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  }
}

bool areFinite(const float* values, std::size_t count) {
  float sum = 0; // 0 * x is NaN where x is not finite
  for (std::size_t i = 0; i < count; ++i) sum += 0.f * values[i];
  return sum == 0;
}

} // namespace

struct AccessorView::Owned {
  Owned(MemoryBudget& budget, std::size_t size, const std::string& place) : charge(budget, size, place), bytes(size) {}
  Owned(MemoryBudget& budget, std::vector<std::byte> given, const std::string& place)
      : charge(budget, given.size(), place), bytes(std::move(given)) {}
  MemoryCharge charge;
  std::vector<std::byte> bytes;
};

AccessorView::AccessorView(const GltfDocument& document, int accessor, std::string place)
    : m_document(&document), m_place(fmt::format("{} (/accessors/{})", place, accessor)) {
  describe(accessor);
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  if (source.bufferView >= 0) {
    const std::size_t stride = document.model.bufferViews[static_cast<std::size_t>(source.bufferView)].byteStride;
    m_bytes = document.bufferView(source.bufferView).subspan(source.byteOffset);
    if (stride) m_stride = stride;
  }
  if (source.bufferView < 0 || source.sparse.isSparse) assemble(accessor);
}

AccessorView::AccessorView(const GltfDocument& document, int accessor, std::string place, std::vector<std::byte> packed)
    : m_document(&document), m_place(fmt::format("{} (/accessors/{})", place, accessor)) {
  describe(accessor);
  own(std::make_shared<Owned>(document.memory, std::move(packed), m_place));
}

void AccessorView::describe(int accessor) {
  const tinygltf::Accessor& source = m_document->model.accessors[static_cast<std::size_t>(accessor)];
  m_componentType = source.componentType;
  m_isMatrix =
      source.type == TINYGLTF_TYPE_MAT2 || source.type == TINYGLTF_TYPE_MAT3 || source.type == TINYGLTF_TYPE_MAT4;
  m_componentCount = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source.type));
  m_count = source.count;
  m_normalized = source.normalized;
  m_elementBytes = bytesOfElement(source.type, source.componentType);
  m_stride = m_elementBytes;
  m_document->memory.work(m_count * m_elementBytes, m_place);
}

void AccessorView::own(std::shared_ptr<const Owned> owned) {
  m_owned = std::move(owned);
  m_bytes = m_owned->bytes;
  m_stride = m_elementBytes;
}

// Zeros or the buffer view's elements, packed, with those of the sparse part over them.
void AccessorView::assemble(int accessor) {
  const tinygltf::Accessor& source = m_document->model.accessors[static_cast<std::size_t>(accessor)];
  auto owned = std::make_shared<Owned>(m_document->memory, m_count * m_elementBytes, m_place);
  if (!m_bytes.empty())
    for (std::size_t i = 0; i < m_count; ++i)
      std::memcpy(&owned->bytes[i * m_elementBytes], &m_bytes[i * m_stride], m_elementBytes);
  if (source.sparse.isSparse) applySparse(source, owned->bytes);
  own(std::move(owned));
}

void AccessorView::applySparse(const tinygltf::Accessor& source, std::vector<std::byte>& packed) const {
  const auto& sparse = source.sparse;
  const auto bytesAt = [&](int view, int offset) {
    return m_document->bufferView(view).subspan(static_cast<std::size_t>(offset));
  };
  const std::span<const std::byte> indices = bytesAt(sparse.indices.bufferView, sparse.indices.byteOffset);
  const std::span<const std::byte> values = bytesAt(sparse.values.bufferView, sparse.values.byteOffset);
  std::size_t next = 0; // the least that an index may be
  withType(sparse.indices.componentType, [&]<typename T>(T) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
      const auto index = static_cast<std::size_t>(load<T>(&indices[i * sizeof(T)]));
      if (index < next || index >= m_count)
        throw error(fmt::format("sparse index {} at {} is {}, expected increasing indices below {}", index, i,
                                index < next ? "not above the previous one" : "out of range", m_count));
      std::memcpy(&packed[index * m_elementBytes], &values[i * m_elementBytes], m_elementBytes);
      next = index + 1;
    }
  });
}

template <typename Vec> std::vector<Vec> AccessorView::readVectors(float fill, bool finite) const {
  if (m_isMatrix) throw error("holds matrices, expected scalars or vectors");
  constexpr std::size_t kWidth = sizeof(Vec) / sizeof(float); // NOLINT(bugprone-sizeof-expression): 1 for a scalar
  const std::size_t components = std::min(static_cast<std::size_t>(m_componentCount), kWidth);
  std::vector<Vec> out(m_count, Vec(fill));
  float* numbers = reinterpret_cast<float*>(out.data());
  if (isFloat() && components == kWidth && m_stride == sizeof(Vec))
    std::memcpy(numbers, m_bytes.data(), m_count * sizeof(Vec));
  else
    withType(m_componentType, [&]<typename T>(T) {
      decode<T>(m_bytes.data(), m_stride, m_count, components, m_normalized, numbers, kWidth);
    });
  if (finite && isFloat() && !areFinite(numbers, m_count * kWidth)) {
    const auto bad = std::find_if(numbers, numbers + m_count * kWidth, [](float v) { return !std::isfinite(v); });
    throw error(fmt::format("element {} is not finite", static_cast<std::size_t>(bad - numbers) / kWidth));
  }
  return out;
}

std::vector<glm::vec2> AccessorView::readVec2() const { return readVectors<glm::vec2>(0.f, true); }
std::vector<glm::vec3> AccessorView::readVec3() const { return readVectors<glm::vec3>(0.f, true); }
std::vector<glm::vec4> AccessorView::readVec4(float fill) const { return readVectors<glm::vec4>(fill, true); }
std::vector<glm::vec3> AccessorView::readVec3Unchecked() const { return readVectors<glm::vec3>(0.f, false); }
std::vector<glm::vec4> AccessorView::readVec4Unchecked() const { return readVectors<glm::vec4>(0.f, false); }

std::vector<float> AccessorView::readScalars() const {
  if (m_componentCount != 1) throw error(fmt::format("has {} components, expected scalars", m_componentCount));
  return readVectors<float>(0.f, true);
}

std::vector<glm::mat4> AccessorView::readMat4() const {
  if (m_componentCount != 16 || !isFloat()) throw error("expected matrices MAT4 of FLOAT");
  std::vector<glm::mat4> out(m_count);
  for (std::size_t i = 0; i < m_count; ++i) {
    out[i] = load<glm::mat4>(&m_bytes[i * m_stride]);
    if (!areFinite(&out[i][0][0], 16)) throw error(fmt::format("element {} is not finite", i));
  }
  return out;
}

std::vector<glm::u16vec4> AccessorView::readJoints() const {
  if (m_isMatrix || m_componentCount != 4 || m_normalized ||
      (m_componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
       m_componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT))
    throw error("expected VEC4 of UNSIGNED_BYTE or UNSIGNED_SHORT, not normalized");
  std::vector<glm::u16vec4> out(m_count);
  const bool isByte = m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  for (std::size_t i = 0; i < m_count; ++i)
    out[i] =
        isByte ? glm::u16vec4(load<glm::u8vec4>(&m_bytes[i * m_stride])) : load<glm::u16vec4>(&m_bytes[i * m_stride]);
  return out;
}

std::vector<std::uint32_t> AccessorView::readIndices(std::size_t limit) const {
  const bool isUnsigned = m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          m_componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (m_componentCount != 1 || !isUnsigned || m_normalized)
    throw error("indices are not scalars of an unsigned integer type");
  std::vector<std::uint32_t> out(m_count);
  std::uint32_t largest = 0, restart = 0;
  withType(m_componentType, [&]<typename T>(T) {
    if constexpr (std::is_unsigned_v<T>) {
      restart = std::numeric_limits<T>::max();
      for (std::size_t i = 0; i < m_count; ++i) {
        out[i] = load<T>(m_bytes.data() + i * m_stride);
        largest = std::max(largest, out[i]);
      }
    }
  });
  if (largest < std::min<std::size_t>(limit, restart)) return out;
  const auto bad = std::find_if(out.begin(), out.end(), [&](std::uint32_t v) { return v >= limit || v == restart; });
  throw error(*bad < limit || *bad == restart
                  ? fmt::format("index {} at element {} is the primitive restart value, which glTF forbids", *bad,
                                bad - out.begin())
                  : fmt::format("index {} at element {} is out of range: there are {} vertices", *bad,
                                bad - out.begin(), limit));
}

} // namespace parity::scenes

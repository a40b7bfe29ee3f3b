// KHR_draco_mesh_compression: the stream's counts are compared with the accessors' before libdraco takes memory for
// them, since it takes as much as a stream says.
#include "scenes/gltf/file/draco.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

namespace parity::scenes {
namespace {

std::invalid_argument refusal(const std::string& reason) { return std::invalid_argument(reason); }

// Reads the head of a stream, as libdraco is about to.
class Head {
public:
  explicit Head(std::span<const std::byte> compressed) {
    m_buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
  }

  // Refuses counts that are not the expected ones.
  void check(const DracoExpectation& expected) {
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&m_buffer, &header).ok()) throw refusal("is not a Draco stream");
    if (header.encoder_type != draco::TRIANGULAR_MESH) throw refusal("is not a Draco stream of a triangle mesh");
    if (header.version_major != 2 || header.version_minor != 2)
      throw refusal(
          fmt::format("is a Draco bitstream {}.{}, expected 2.2", header.version_major, header.version_minor));
    m_buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    if (header.flags & METADATA_FLAG_MASK) {
      draco::GeometryMetadata metadata;
      if (!draco::MetadataDecoder().DecodeGeometryMetadata(&m_buffer, &metadata)) throw damaged();
    }
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
      checkFaces(number(), expected);
      if (const std::size_t points = number(); points != expected.vertices)
        throw refusal(fmt::format("the stream has {} vertices, but the accessors have {}", points, expected.vertices));
    } else if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
      byte(); // how it is traversed
      const std::size_t vertices = number(), faces = number();
      checkFaces(faces, expected);
      byte(); // the number of attributes with seams
      const std::size_t symbols = number(), splits = number();
      // Points are these vertices, split where attributes have seams; never fewer, and no more than corners.
      if (vertices > expected.vertices || symbols > faces || splits > faces) throw damaged();
    } else
      throw damaged();
  }

private:
  static std::invalid_argument damaged() { return refusal("the Draco stream is damaged"); }
  std::size_t number() {
    std::uint32_t value = 0;
    if (!draco::DecodeVarint(&value, &m_buffer)) throw damaged();
    return value;
  }
  void byte() {
    std::uint8_t value = 0;
    if (!m_buffer.Decode(&value)) throw damaged();
  }
  static void checkFaces(std::size_t faces, const DracoExpectation& expected) {
    const bool fits = expected.indices == 0   ? faces < expected.maxBytes / 12
                      : expected.exactIndices ? 3 * faces == expected.indices
                                              : faces <= expected.indices;
    if (!fits)
      throw refusal(
          fmt::format("the stream has {} triangles, but the accessor has {} indices", faces, expected.indices));
  }

  draco::DecoderBuffer m_buffer;
};

// libdraco announces every attribute here before it takes memory for its values.
class BoundedMesh : public draco::Mesh {
public:
  explicit BoundedMesh(std::size_t maxBytes) : m_left(maxBytes) {}

  void SetAttribute(int id, std::unique_ptr<draco::PointAttribute> attribute) override {
    const std::size_t size = static_cast<std::size_t>(draco::DataTypeLength(attribute->data_type()));
    const std::size_t perPoint = dracoBytesOfVertex(attribute->num_components(), size);
    if (perPoint > m_left / std::max<std::size_t>(num_points(), 1))
      throw refusal("the attributes of the stream need more memory than the limit allows");
    m_left -= perPoint * num_points();
    draco::Mesh::SetAttribute(id, std::move(attribute));
  }

private:
  std::size_t m_left;
};

// The values of all points, converted number by number: a stream may hold shorter or longer types than the accessor.
template <typename T> std::vector<std::byte> readAs(const draco::PointAttribute& attribute, std::size_t points) {
  const std::size_t components = attribute.num_components();
  const auto type = attribute.data_type();
  std::vector<std::byte> out(points * components * sizeof(T));
  const auto convert = [&]<typename Source>(Source) {
    std::vector<Source> value(components);
    for (std::size_t p = 0; p < points; ++p) {
      attribute.GetMappedValue(draco::PointIndex(static_cast<std::uint32_t>(p)), value.data());
      for (std::size_t c = 0; c < components; ++c) {
        T number;
        if constexpr (std::is_floating_point_v<T>)
          number = static_cast<T>(value[c]);
        else {
          const double exact = static_cast<double>(value[c]);
          if (!(exact >= static_cast<double>(std::numeric_limits<T>::min()) &&
                exact <= static_cast<double>(std::numeric_limits<T>::max())))
            throw refusal(fmt::format("vertex {}: {} does not fit the accessor's componentType", p, exact));
          number = static_cast<T>(exact);
        }
        std::memcpy(&out[(p * components + c) * sizeof(T)], &number, sizeof(T));
      }
    }
  };
  switch (type) {
  case draco::DT_INT8:
    convert(std::int8_t{});
    break;
  case draco::DT_UINT8:
  case draco::DT_BOOL:
    convert(std::uint8_t{});
    break;
  case draco::DT_INT16:
    convert(std::int16_t{});
    break;
  case draco::DT_UINT16:
    convert(std::uint16_t{});
    break;
  case draco::DT_INT32:
    convert(std::int32_t{});
    break;
  case draco::DT_UINT32:
    convert(std::uint32_t{});
    break;
  case draco::DT_FLOAT32:
    convert(float{});
    break;
  default:
    throw refusal(fmt::format("an attribute has the Draco type {}, which glTF does not have", static_cast<int>(type)));
  }
  return out;
}

std::vector<std::byte> readAttribute(const draco::Mesh& mesh, const DracoAttribute& wanted) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
  if (!attribute) throw refusal(fmt::format("the stream has no attribute {}", wanted.id));
  if (attribute->num_components() != wanted.componentCount)
    throw refusal(fmt::format("attribute {} has {} components, but the accessor has {}", wanted.id,
                              static_cast<int>(attribute->num_components()), wanted.componentCount));
  const std::size_t points = mesh.num_points();
  for (std::size_t p = 0; p < points; ++p)
    if (attribute->mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p))).value() >= attribute->size())
      throw refusal(fmt::format("attribute {} has no value for vertex {}", wanted.id, p));
  switch (wanted.componentType) {
  case 5120:
    return readAs<std::int8_t>(*attribute, points);
  case 5121:
    return readAs<std::uint8_t>(*attribute, points);
  case 5122:
    return readAs<std::int16_t>(*attribute, points);
  case 5123:
    return readAs<std::uint16_t>(*attribute, points);
  case 5125:
    return readAs<std::uint32_t>(*attribute, points);
  case 5126:
    return readAs<float>(*attribute, points);
  default:
    throw refusal(fmt::format("componentType {} is not valid", wanted.componentType));
  }
}

} // namespace

DracoMesh decodeDraco(std::span<const std::byte> compressed, const DracoExpectation& expected) {
  Head(compressed).check(expected);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
  BoundedMesh mesh(expected.maxBytes);
  if (const draco::Status status = draco::Decoder().DecodeBufferToGeometry(&buffer, &mesh); !status.ok())
    throw refusal(status.error_msg_string().empty() ? "the Draco stream is damaged"
                                                    : "the Draco stream is damaged: " + status.error_msg_string());
  if (mesh.num_points() != expected.vertices)
    throw refusal(
        fmt::format("the stream has {} vertices, but the accessors have {}", mesh.num_points(), expected.vertices));
  DracoMesh out;
  out.indices.reserve(3 * std::size_t{mesh.num_faces()});
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& point : mesh.face(f)) {
      if (point.value() >= mesh.num_points()) throw refusal("a triangle of the stream has a vertex index out of range");
      out.indices.push_back(point.value());
    }
  for (const DracoAttribute& wanted : expected.attributes) out.attributes.push_back(readAttribute(mesh, wanted));
  return out;
}

} // namespace parity::scenes

// Draco streams made by the tests, by libdraco's encoder.
#include "scenes/gltf/draco_writer.h"

#include <stdexcept>

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

namespace parity::tests {
namespace {

template <typename T> void addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type,
                                        draco::DataType dataType, int components, const std::vector<T>& values,
                                        std::size_t points) {
  if (values.empty()) return;
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::int8_t>(components), dataType, false, sizeof(T), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(points));
  for (std::uint32_t p = 0; p < points; ++p)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(p), &values[p]);
}

} // namespace

std::vector<std::byte> encodeDraco(const DracoSource& source, bool edgebreaker, int positionBits) {
  draco::Mesh mesh;
  const std::size_t points = source.positions.size();
  mesh.set_num_points(static_cast<std::uint32_t>(points));
  addAttribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, source.positions, points);
  addAttribute(mesh, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, source.normals, points);
  addAttribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, 2, source.uv, points);
  addAttribute(mesh, draco::GeometryAttribute::GENERIC, draco::DT_UINT8, 4, source.joints, points);
  for (std::size_t i = 0; i < source.indices.size(); i += 3)
    mesh.AddFace({draco::PointIndex(source.indices[i]), draco::PointIndex(source.indices[i + 1]),
                  draco::PointIndex(source.indices[i + 2])});
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  if (positionBits) encoder.SetAttributeQuantization(0, positionBits);
  draco::EncoderBuffer buffer;
  if (const draco::Status status = encoder.EncodeToBuffer(&buffer); !status.ok())
    throw std::runtime_error(status.error_msg());
  const auto* bytes = reinterpret_cast<const std::byte*>(buffer.data());
  return {bytes, bytes + buffer.size()};
}

} // namespace parity::tests

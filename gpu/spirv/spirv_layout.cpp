#include "gpu/spirv/spirv_layout.h"

#include <algorithm>

#include <glslang/SPIRV/spirv.hpp>

namespace parity::gpu {

namespace {

bool isArray(const SpirvInstruction& type) {
  return type.opcode == spv::OpTypeArray || type.opcode == spv::OpTypeRuntimeArray;
}

} // namespace

SpirvLayout::SpirvLayout(const SpirvModule& module) : m_module(module) {
  for (const SpirvInstruction& each : module.instructions()) {
    const auto& operands = each.operands;
    if (each.opcode == spv::OpMemberDecorate && operands[2] == spv::DecorationOffset)
      m_offsets[{operands[0], operands[1]}] = operands[3];
    if (each.opcode == spv::OpDecorate && operands[1] == spv::DecorationArrayStride)
      m_strides[operands[0]] = operands[2];
  }
}

bool SpirvLayout::isVector(std::uint32_t type) const {
  using enum SpirvShape::Kind;
  const SpirvShape shape = m_module.shapeOfType(type);
  return (shape.kind == real || shape.kind == integer) && shape.bits == 32 && shape.rows == 4 && shape.cols == 1;
}

bool SpirvLayout::hasVectorsOnly(std::uint32_t type) const {
  if (isVector(type)) return true;
  const SpirvInstruction* found = m_module.find(type);
  if (!found) return false;
  if (isArray(*found)) {
    const auto stride = m_strides.find(type);
    return stride != m_strides.end() && stride->second % kSpirvVectorBytes == 0 && hasVectorsOnly(found->operands[0]);
  }
  if (found->opcode != spv::OpTypeStruct) return false;
  for (std::uint32_t k = 0; k < found->operands.size(); ++k) {
    const auto offset = m_offsets.find({type, k});
    if (offset == m_offsets.end() || offset->second % kSpirvVectorBytes != 0) return false;
    if (!hasVectorsOnly(found->operands[k])) return false;
  }
  return true;
}

std::optional<std::uint32_t> SpirvLayout::vectorsIn(std::uint32_t type) const {
  if (isVector(type)) return 1;
  const SpirvInstruction& found = *m_module.find(type);
  if (isArray(found)) {
    if (found.opcode == spv::OpTypeRuntimeArray) return std::nullopt;
    const auto length = m_module.integerConstant(found.operands[1]);
    if (!length) return std::nullopt;
    return static_cast<std::uint32_t>(*length) * (m_strides.at(type) / kSpirvVectorBytes);
  }
  std::uint32_t end = 0;
  for (const Part& part : partsOf(type)) {
    const auto length = vectorsIn(part.type);
    if (!length) return std::nullopt;
    end = std::max(end, part.vectors + *length);
  }
  return end;
}

std::vector<SpirvLayout::Part> SpirvLayout::partsOf(std::uint32_t type) const {
  std::vector<Part> parts;
  const SpirvInstruction& found = *m_module.find(type);
  if (found.opcode == spv::OpTypeStruct) {
    for (std::uint32_t k = 0; k < found.operands.size(); ++k)
      parts.push_back({found.operands[k], m_offsets.at({type, k}) / kSpirvVectorBytes});
  } else if (const auto length = isArray(found) ? vectorsIn(type) : std::nullopt) {
    const std::uint32_t stride = m_strides.at(type) / kSpirvVectorBytes;
    for (std::uint32_t at = 0; at < *length; at += stride) parts.push_back({found.operands[0], at});
  }
  return parts;
}

std::optional<SpirvPlace> SpirvLayout::placeOf(const SpirvInstruction& chain, std::uint32_t typeOfBuffer) const {
  SpirvPlace place;
  place.type = typeOfBuffer;
  for (const std::uint32_t index : chain.operands.subspan(1)) {
    if (m_module.shapeOf(index).bits != 32) return std::nullopt;
    const SpirvInstruction& type = *m_module.find(place.type);
    const auto constant = m_module.integerConstant(index);
    const auto known = static_cast<std::uint32_t>(constant.value_or(0));
    std::uint32_t element = 0; // its place among the type's operands
    if (type.opcode == spv::OpTypeStruct) {
      place.vectors += m_offsets.at({place.type, known}) / kSpirvVectorBytes;
      element = known;
    } else if (type.opcode == spv::OpTypeVector) {
      if (!constant) return std::nullopt;
      place.component = known;
    } else {
      const std::uint32_t stride = m_strides.at(place.type) / kSpirvVectorBytes;
      if (constant)
        place.vectors += known * stride;
      else
        place.dynamic.emplace_back(index, stride);
    }
    place.type = type.operands[element];
  }
  return place;
}

} // namespace parity::gpu

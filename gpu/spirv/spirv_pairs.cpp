#include "gpu/spirv/spirv_pairs.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <glslang/SPIRV/spirv.hpp>

#include "gpu/spirv/spirv_layout.h"
#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_rewriter.h"

namespace parity::gpu {

namespace {

class PairAccess {
public:
  explicit PairAccess(const SpirvModule& module) : m_module(module), m_layout(module), m_rewriter(module) {}

  std::vector<std::uint32_t> write() {
    findBuffers();
    if (m_buffers.empty()) return m_module.words();
    declare();
    return m_rewriter.write([&](const SpirvInstruction& each) {
      if (each.opcode == spv::OpLoad || each.opcode == spv::OpStore) return replace(each);
      return isAccessChain(each) && m_places.contains(each.result); // its loads and stores have chains of their own
    });
  }

private:
  using Operands = SpirvRewriter::Words;

  std::uint32_t typeOf(std::uint32_t buffer) const { return m_module.find(m_module.find(buffer)->type)->operands[1]; }
  std::uint32_t classOf(std::uint32_t buffer) const { return m_module.find(buffer)->operands[0]; }

  // Members of a block that have the decoration.
  std::size_t countDecorated(std::uint32_t block, std::uint32_t decoration) const {
    const auto isIt = [&](const SpirvInstruction& each) {
      return each.opcode == spv::OpMemberDecorate && each.operands[0] == block && each.operands[2] == decoration;
    };
    return static_cast<std::size_t>(std::ranges::count_if(m_module.instructions(), isIt));
  }
  bool isBlock(std::uint32_t type) const {
    return std::ranges::any_of(m_module.instructions(), [&](const SpirvInstruction& each) {
      return each.opcode == spv::OpDecorate && each.operands[0] == type && each.operands[1] == spv::DecorationBlock;
    });
  }

  // A variable, which may turn out to be used in other ways.
  bool mayBeBuffer(const SpirvInstruction& each) const {
    const bool isUniform = each.opcode == spv::OpVariable && each.operands[0] == spv::StorageClassUniform;
    const bool isStorage = each.opcode == spv::OpVariable && each.operands[0] == spv::StorageClassStorageBuffer;
    if (!isUniform && !isStorage) return false;
    const std::uint32_t type = typeOf(each.result);
    if (!isBlock(type) || !m_layout.hasVectorsOnly(type)) return false;
    if (countDecorated(type, spv::DecorationCoherent) + countDecorated(type, spv::DecorationVolatile) != 0)
      return false;
    return isStorage || m_layout.vectorsIn(type).has_value();
  }

  void findBuffers() {
    const auto all = m_module.instructions();
    const auto functions = std::ranges::find(all, spv::OpFunction, &SpirvInstruction::opcode);
    for (const SpirvInstruction& each : std::span(all.begin(), functions))
      if (mayBeBuffer(each)) m_buffers.insert(each.result);
    for (const SpirvInstruction& each : std::span(functions, all.end()))
      if (isAccessChain(each) && m_buffers.contains(each.operands[0])) {
        if (auto place = m_layout.placeOf(each, typeOf(each.operands[0])))
          m_places.emplace(each.result, std::move(*place));
        else
          m_buffers.erase(each.operands[0]);
      }
    for (const SpirvInstruction& each : std::span(functions, all.end()))
      for (std::size_t k = 0; k < each.operands.size(); ++k)
        if (!mayUse(each, k)) m_buffers.erase(bufferOf(each.operands[k]));
    for (const SpirvInstruction& each : std::span(all.begin(), functions)) // names and decorations of chains
      if ((each.opcode == spv::OpName || each.opcode == spv::OpDecorate) && m_places.contains(each.operands[0]))
        m_buffers.erase(bufferOf(each.operands[0]));
    // Uniform buffers that constants index alone are read once for all lanes: as they are, in fewer instructions.
    std::set<std::uint32_t> indexed;
    for (const auto& [chain, place] : m_places)
      if (!place.dynamic.empty()) indexed.insert(bufferOf(chain));
    std::erase_if(m_buffers, [&](std::uint32_t buffer) {
      return classOf(buffer) == spv::StorageClassUniform && !indexed.contains(buffer);
    });
    std::erase_if(m_places, [&](const auto& entry) { return !m_buffers.contains(bufferOf(entry.first)); });
  }

  // The variable that the id is, or that its chain begins at; else 0.
  std::uint32_t bufferOf(std::uint32_t id) const {
    return m_places.contains(id) ? m_module.find(id)->operands[0] : m_buffers.contains(id) ? id : 0;
  }

  // Whether this operand is no buffer and no place in one, or is one that can be rewritten. A literal counts as an id:
  // a buffer stays as it was at worst.
  bool mayUse(const SpirvInstruction& each, std::size_t operand) const {
    const std::uint32_t id = each.operands[operand];
    if (m_buffers.contains(id)) return operand == 0 && isAccessChain(each);
    const auto found = m_places.find(id);
    if (found == m_places.end()) return true;
    const SpirvPlace& place = found->second;
    if (operand != 0) return false;
    if (each.opcode == spv::OpStore) return !place.component && m_layout.isVector(place.type);
    return each.opcode == spv::OpLoad && (place.component || m_layout.vectorsIn(place.type));
  }

  void declare() {
    m_rewriter.addCapability(spv::CapabilityInt64);
    m_uint = m_rewriter.typeOf(spv::OpTypeInt, {32, 0});
    m_number = m_rewriter.typeOf(spv::OpTypeInt, {64, 0});
    m_pair = m_rewriter.typeOf(spv::OpTypeVector, {m_number, 2});
    for (const std::uint32_t buffer : m_buffers) {
      const bool isUniform = classOf(buffer) == spv::StorageClassUniform;
      const std::uint32_t array =
          isUniform ? m_rewriter.newType(spv::OpTypeArray, {m_pair, constant(*m_layout.vectorsIn(typeOf(buffer)))})
                    : m_rewriter.newType(spv::OpTypeRuntimeArray, {m_pair});
      m_rewriter.decorate(spv::OpDecorate, {array, spv::DecorationArrayStride, kSpirvVectorBytes});
      const std::uint32_t block = m_rewriter.newType(spv::OpTypeStruct, {array});
      m_rewriter.decorate(spv::OpDecorate, {block, spv::DecorationBlock});
      m_rewriter.decorate(spv::OpMemberDecorate, {block, 0, spv::DecorationOffset, 0});
      const std::size_t members = m_module.find(typeOf(buffer))->operands.size();
      for (const std::uint32_t access : {spv::DecorationNonWritable, spv::DecorationNonReadable})
        if (countDecorated(typeOf(buffer), access) == members)
          m_rewriter.decorate(spv::OpMemberDecorate, {block, 0, access});
      m_rewriter.redeclare(buffer, m_rewriter.typeOf(spv::OpTypePointer, {classOf(buffer), block}));
    }
  }

  std::uint32_t constant(std::uint32_t value) {
    const auto [found, isNew] = m_constants.try_emplace(value, 0);
    if (isNew) found->second = m_rewriter.constantOf(m_uint, value);
    return found->second;
  }

  std::uint32_t sum(std::uint32_t a, std::uint32_t b) { return m_rewriter.compute(spv::OpIAdd, m_uint, {a, b}); }

  // Of a place's first vector.
  std::uint32_t indexOf(const SpirvPlace& place) {
    if (place.dynamic.empty()) return constant(place.vectors);
    std::uint32_t index = 0;
    for (const auto& [id, stride] : place.dynamic) {
      const std::uint32_t step = stride == 1 ? id : m_rewriter.compute(spv::OpIMul, m_uint, {id, constant(stride)});
      index = index == 0 ? step : sum(index, step);
    }
    return place.vectors == 0 ? index : sum(index, constant(place.vectors));
  }

  // A pointer to the pair at an index of a buffer, or to one of its integers.
  std::uint32_t pointer(std::uint32_t buffer, std::uint32_t index, std::optional<std::uint32_t> integer = {}) {
    const std::uint32_t type = m_rewriter.typeOf(spv::OpTypePointer, {classOf(buffer), integer ? m_number : m_pair});
    if (integer) return m_rewriter.compute(spv::OpAccessChain, type, {buffer, constant(0), index, constant(*integer)});
    return m_rewriter.compute(spv::OpAccessChain, type, {buffer, constant(0), index});
  }

  bool replace(const SpirvInstruction& each) {
    const auto found = m_places.find(each.operands[0]);
    if (found == m_places.end()) return false;
    const SpirvPlace& place = found->second;
    const std::uint32_t buffer = bufferOf(found->first), index = indexOf(place);
    const bool isStore = each.opcode == spv::OpStore;
    const auto how = each.operands.subspan(isStore ? 2 : 1); // memory operands
    if (isStore) {
      Operands operands = {pointer(buffer, index), m_rewriter.compute(spv::OpBitcast, m_pair, {each.operands[1]})};
      operands.insert(operands.end(), how.begin(), how.end());
      m_rewriter.emit(spv::OpStore, operands);
    } else if (place.component) {
      const std::uint32_t bits = load(m_number, pointer(buffer, index, *place.component / 2), how);
      const std::uint32_t two = m_rewriter.typeOf(spv::OpTypeVector, {place.type, 2});
      m_rewriter.emit(spv::OpCompositeExtract,
                      {each.type, each.result, m_rewriter.compute(spv::OpBitcast, two, {bits}), *place.component % 2});
    } else {
      loadAll(place.type, buffer, index, each.result, how);
    }
    return true;
  }

  std::uint32_t load(std::uint32_t type, std::uint32_t from, std::span<const std::uint32_t> how) {
    Operands operands = {type, m_rewriter.newId(), from};
    operands.insert(operands.end(), how.begin(), how.end());
    m_rewriter.emit(spv::OpLoad, operands);
    return operands[1];
  }

  // Defines the result as what is there: a vector, or a struct or an array of such.
  void loadAll(std::uint32_t type, std::uint32_t buffer, std::uint32_t index, std::uint32_t result,
               std::span<const std::uint32_t> how) {
    if (m_layout.isVector(type))
      return m_rewriter.emit(spv::OpBitcast, {type, result, load(m_pair, pointer(buffer, index), how)});
    Operands operands = {type, result};
    for (const SpirvLayout::Part& part : m_layout.partsOf(type)) {
      const std::uint32_t at = part.vectors == 0 ? index : sum(index, constant(part.vectors));
      operands.push_back(m_rewriter.newId());
      loadAll(part.type, buffer, at, operands.back(), how);
    }
    m_rewriter.emit(spv::OpCompositeConstruct, operands);
  }

  const SpirvModule& m_module;
  SpirvLayout m_layout;
  SpirvRewriter m_rewriter;
  std::set<std::uint32_t> m_buffers;                  // variables
  std::map<std::uint32_t, SpirvPlace> m_places;       // by access chain
  std::map<std::uint32_t, std::uint32_t> m_constants; // ids, by value
  std::uint32_t m_uint = 0, m_number = 0, m_pair = 0; // types: of 32 bits, of 64 bits, of two of those
};

} // namespace

std::vector<std::uint32_t> accessBuffersByPairs(std::vector<std::uint32_t> words) {
  const SpirvModule module(std::move(words));
  return PairAccess(module).write();
}

} // namespace parity::gpu

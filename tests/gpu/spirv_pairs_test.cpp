// What is left of accesses to vectors in buffers. What they read and write: spirv_pairs_device_test.cpp.
#include "gpu/spirv/spirv_pairs.h"

#include <algorithm>
#include <map>

#include <glslang/SPIRV/spirv.hpp>
#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "gpu/specialize_numbers.h"
#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_specialize.h"
#include "gpu_shaders/pairs.comp.h"
#include "gpu_shaders/specialize.comp.h"

namespace parity::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

// By binding: whether the buffer is an array of pairs.
std::map<std::uint32_t, bool> pairsOf(const Words& words) {
  const SpirvModule module(words);
  std::map<std::uint32_t, bool> pairs;
  for (const SpirvInstruction& each : module.instructions()) {
    if (each.opcode != spv::OpDecorate || each.operands[1] != spv::DecorationBinding) continue;
    const SpirvInstruction &variable = *module.find(each.operands[0]), &pointer = *module.find(variable.type);
    const SpirvInstruction &block = *module.find(pointer.operands[1]), &array = *module.find(block.operands.back());
    const SpirvShape shape = module.shapeOfType(array.operands[0]);
    pairs[each.operands[2]] = shape.kind == SpirvShape::Kind::integer && shape.bits == 64 && shape.rows == 2;
  }
  return pairs;
}

// By binding. 2: of single numbers. 5: uniform, and indexed by constants alone. 7: coherent.
const std::map<std::uint32_t, bool> kPairs = {{0, true},  {1, true}, {2, false}, {3, true}, {4, true},
                                              {5, false}, {6, true}, {7, false}, {8, true}};

TEST(SpirvPairs, BuffersOfVectorsBecomeArraysOfPairs) {
  for (const Spirv spirv : {Spirv(kPairsComp), Spirv(kPairsCompWritten)}) {
    const Words before = specializeSpirv(spirv, Words{0}), after = accessBuffersByPairs(before);
    EXPECT_EQ(refusalOf(before), "");
    EXPECT_EQ(refusalOf(after), "");
    EXPECT_EQ(pairsOf(after), kPairs);
    EXPECT_EQ(accessBuffersByPairs(after), after) << "there is nothing left to rewrite";
    EXPECT_EQ(accessBuffersByPairs(before), after) << "each time the same";
  }
}

TEST(SpirvPairs, ABufferStaysWhereItIsUsedInAnotherWay) {
  // A component is stored; an index chooses a component; the length is asked for; a whole struct is stored.
  const std::uint32_t left[] = {3, 0, 0, 8};
  for (std::uint32_t use = 1; use <= 4; ++use)
    for (const Spirv spirv : {Spirv(kPairsComp), Spirv(kPairsCompWritten)}) {
      SCOPED_TRACE(use);
      const Words after = accessBuffersByPairs(specializeSpirv(spirv, Words{use}));
      EXPECT_EQ(refusalOf(after), "");
      auto wanted = kPairs;
      wanted[left[use - 1]] = false;
      EXPECT_EQ(pairsOf(after), wanted);
    }
}

// readonly and writeonly of the shader's text: drivers reorder what nothing writes.
TEST(SpirvPairs, BlocksKeepTheirAccess) {
  const auto hasAccess = [](const Words& words, std::uint32_t binding, std::uint32_t access) {
    const SpirvModule module(words);
    std::uint32_t block = 0;
    for (const SpirvInstruction& each : module.instructions())
      if (each.opcode == spv::OpDecorate && each.operands[1] == spv::DecorationBinding && each.operands[2] == binding)
        block = module.find(module.find(each.operands[0])->type)->operands[1];
    return std::ranges::any_of(module.instructions(), [&](const SpirvInstruction& each) {
      return each.opcode == spv::OpMemberDecorate && each.operands[0] == block && each.operands[2] == access;
    });
  };
  const Words after = accessBuffersByPairs(specializeSpirv(kPairsComp, Words{0}));
  for (const std::uint32_t binding : {0u, 1u, 3u, 6u}) {
    EXPECT_EQ(hasAccess(after, binding, spv::DecorationNonWritable), binding < 2) << binding;
    EXPECT_EQ(hasAccess(after, binding, spv::DecorationNonReadable), binding == 6) << binding;
  }
}

TEST(SpirvPairs, LeavesModulesWithoutSuchBuffers) {
  const Words words(std::begin(kSpecializeComp), std::end(kSpecializeComp));
  EXPECT_EQ(accessBuffersByPairs(words), words);
}

TEST(SpirvPairs, RefusesWhatIsNoSpirv) {
  base::expectError([] { accessBuffersByPairs({1, 2, 3, 4, 5}); }, "SPIR-V", "word 0");
}

} // namespace
} // namespace parity::gpu

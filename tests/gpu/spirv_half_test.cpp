// What is left of conversions to half, and of comparisons of halves, in modules. What they compute:
// spirv_half_device_test.cpp.
#include "gpu/spirv/spirv_half.h"

#include <algorithm>

#include <glslang/SPIRV/GLSL.std.450.h>
#include <glslang/SPIRV/spirv.hpp>
#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "gpu/specialize_numbers.h"
#include "gpu/spirv/spirv_half_compare.h"
#include "gpu/spirv/spirv_module.h"
#include "gpu/spirv/spirv_specialize.h"
#include "gpu_shaders/half.comp.h"
#include "gpu_shaders/half_compare.comp.h"
#include "gpu_shaders/specialize.comp.h"

namespace parity::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

std::size_t countConversions(const Words& words) {
  const SpirvModule module(words);
  return static_cast<std::size_t>(
      std::ranges::count(module.instructions(), spv::OpFConvert, &SpirvInstruction::opcode));
}

TEST(SpirvHalf, ReplacesConversionsOfScalarsAndVectors) {
  for (const std::span<const std::uint32_t> spirv :
       {std::span<const std::uint32_t>(kHalfComp), std::span<const std::uint32_t>(kHalfCompWritten)}) {
    const Words before = specializeSpirv(spirv, Words{0}), after = convertHalvesByBits(before);
    EXPECT_EQ(countConversions(before), 4u);
    EXPECT_EQ(countConversions(after), 0u);
    EXPECT_EQ(refusalOf(before), "");
    EXPECT_EQ(refusalOf(after), "");
    EXPECT_EQ(convertHalvesByBits(after), after) << "there is nothing left to replace";
  }
}

TEST(SpirvHalf, LeavesConversionsOfWhatAnImageHolds) {
  for (const std::span<const std::uint32_t> spirv :
       {std::span<const std::uint32_t>(kHalfComp), std::span<const std::uint32_t>(kHalfCompWritten)}) {
    const Words words = specializeSpirv(spirv, Words{1});
    EXPECT_EQ(countConversions(words), 2u);
    EXPECT_EQ(convertHalvesByBits(words), words);
  }
}

TEST(SpirvHalf, LeavesModulesWithoutHalves) {
  const Words words(std::begin(kSpecializeComp), std::end(kSpecializeComp));
  EXPECT_EQ(convertHalvesByBits(words), words);
}

// A module of a shader with an empty interface. globals: behind the types void (2) and void() (3); code: of its
// function.
Words makeModule(const Words& imports, const Words& globals, const Words& code) {
  // clang-format off
  Words words = {spv::MagicNumber, 0x10300, 0, 12, 0,
                 2 << 16 | spv::OpCapability, spv::CapabilityShader,
                 2 << 16 | spv::OpCapability, spv::CapabilityFloat16};
  const Words types = {3 << 16 | spv::OpMemoryModel, spv::AddressingModelLogical, spv::MemoryModelGLSL450,
                       4 << 16 | spv::OpEntryPoint, spv::ExecutionModelGLCompute, 1, 'a',
                       6 << 16 | spv::OpExecutionMode, 1, spv::ExecutionModeLocalSize, 1, 1, 1,
                       2 << 16 | spv::OpTypeVoid, 2,
                       3 << 16 | spv::OpTypeFunction, 3, 2};
  const Words begin = {5 << 16 | spv::OpFunction, 2, 1, 0, 3, 2 << 16 | spv::OpLabel, 7},
              end = {1 << 16 | spv::OpReturn, 1 << 16 | spv::OpFunctionEnd};
  // clang-format on
  for (const Words* part : {&imports, &types, &globals, &begin, &code, &end})
    words.insert(words.end(), part->begin(), part->end());
  EXPECT_EQ(refusalOf(words), "");
  return words;
}

// Each is in the module, or is not: the validator says whether one is there twice or none.
TEST(SpirvHalf, MakesTheTypesAndTheLibraryThatAModuleLacks) {
  const Words after =
      convertHalvesByBits(makeModule({},
                                     {3 << 16 | spv::OpTypeFloat, 4, 32, 3 << 16 | spv::OpTypeFloat, 5, 16, //
                                      4 << 16 | spv::OpConstant, 4, 6, 0x3f8ccccd},
                                     {4 << 16 | spv::OpFConvert, 5, 8, 6}));
  EXPECT_EQ(refusalOf(after), "");
  EXPECT_EQ(countConversions(after), 0u);
}

// Comparisons of halves, and FMin and FMax of them.
std::size_t countOfHalves(const Words& words) {
  const SpirvModule module(words);
  const auto isOfHalves = [&](const SpirvInstruction& each) {
    if (each.opcode >= spv::OpFOrdEqual && each.opcode <= spv::OpFUnordGreaterThanEqual)
      return module.shapeOf(each.operands[0]).bits == 16;
    return each.opcode == spv::OpExtInst && module.shapeOf(each.result).bits == 16;
  };
  return static_cast<std::size_t>(std::ranges::count_if(module.instructions(), isOfHalves));
}

TEST(SpirvHalf, WidensComparisonsOfHalves) {
  for (const std::span<const std::uint32_t> spirv :
       {std::span<const std::uint32_t>(kHalfCompareComp), std::span<const std::uint32_t>(kHalfCompareCompWritten)}) {
    const Words before(spirv.begin(), spirv.end()), after = compareHalvesWidened(before);
    EXPECT_GE(countOfHalves(before), 12u); // six comparisons, six of min and max
    EXPECT_EQ(countOfHalves(after), 0u);
    EXPECT_EQ(refusalOf(before), "");
    EXPECT_EQ(refusalOf(after), "");
    EXPECT_EQ(countConversions(convertHalvesByBits(after)), countConversions(after) - 3)
        << "only the shader's own conversions, of its three numbers, become bits";
  }
}

// Of the inlined shader: the six comparisons with .1, which no half is, and that of two numbers.
TEST(SpirvHalf, WidensComparisonsWithConstantsThatAHalfCanHold) {
  const SpirvModule module(compareHalvesWidened({std::begin(kHalfCompareComp), std::end(kHalfCompareComp)}));
  int doubled = 0, plain = 0;
  for (const SpirvInstruction& each : module.instructions()) {
    if (each.opcode < spv::OpFOrdEqual || each.opcode > spv::OpFUnordGreaterThanEqual) continue;
    const SpirvInstruction* operand = module.find(each.operands[0]);
    ++(operand && operand->opcode == spv::OpFMul ? doubled : plain);
  }
  EXPECT_EQ(plain, 7);
  EXPECT_GE(doubled, 6 * 5 + 6 * 3);
}

TEST(SpirvHalf, AddsATypeOfNumbersOnce) {
  const Words after = compareHalvesWidened(
      makeModule({6 << 16 | spv::OpExtInstImport, 11, 0x4c534c47, 0x6474732e, 0x3035342e, 0}, // GLSL.std.450
                 {3 << 16 | spv::OpTypeFloat, 4, 16, 4 << 16 | spv::OpConstant, 4, 5, 0x3c00, //
                  3 << 16 | spv::OpConstantNull, 4, 6},
                 {7 << 16 | spv::OpExtInst, 4, 8, 11, GLSLstd450FMin, 5, 6}));
  EXPECT_EQ(refusalOf(after), "");
  EXPECT_EQ(countOfHalves(after), 0u);
}

TEST(SpirvHalf, LeavesComparisonsWithoutHalves) {
  const Words words(std::begin(kSpecializeComp), std::end(kSpecializeComp));
  EXPECT_EQ(compareHalvesWidened(words), words);
  const Words conversions = specializeSpirv(kHalfComp, Words{0});
  EXPECT_EQ(compareHalvesWidened(conversions), conversions);
}

TEST(SpirvHalf, RefusesWhatIsNoModule) {
  base::expectError([] { convertHalvesByBits({1, 2, 3, 4, 5}); }, "SPIR-V", "word 0");
  base::expectError([] { compareHalvesWidened({1, 2, 3, 4, 5}); }, "SPIR-V", "word 0");
}

} // namespace
} // namespace parity::gpu

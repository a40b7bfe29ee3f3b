// What is left of shaders whose constants are known. What they compute: spirv_specialize_device_test.cpp; the shaders
// of both paths, as they are used, pass the validation layer in every test on a device.
#include "gpu/spirv/spirv_specialize.h"

#include <algorithm>
#include <random>

#include <glslang/SPIRV/spirv.hpp>
#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "gpu/specialize_numbers.h"
#include "gpu/spirv/spirv_module.h"
#include "gpu_shaders/specialize.comp.h"

namespace parity::gpu {
namespace {

using Spirv = std::span<const std::uint32_t>;

std::size_t countOf(Spirv words, const std::vector<std::uint32_t>& opcodes) {
  const SpirvModule module({words.begin(), words.end()});
  return static_cast<std::size_t>(std::ranges::count_if(module.instructions(), [&](const SpirvInstruction& each) {
    return std::ranges::find(opcodes, each.opcode) != opcodes.end();
  }));
}

// What is left of a module whose piece is known: that piece.
TEST(SpirvSpecialize, LeavesOutWhatCannotRun) {
  const Spirv all = kSpecializeComp;
  for (const std::uint32_t piece : {1u, 2u, 3u, 4u}) {
    const std::vector<std::uint32_t> left =
        specializeSpirv(all, constantsOf({.piece = piece, .first = 2, .second = 4}));
    EXPECT_LT(left.size() * 2, all.size()) << "piece " << piece;
    EXPECT_EQ(left, specializeSpirv(all, constantsOf({.piece = piece, .first = 2, .second = 4})));
    EXPECT_TRUE(piece != 4 || countOf(left, {spv::OpBranchConditional}) == 0) << "all are decided";
  }
  const std::vector<std::uint32_t> nothing = specializeSpirv(all, constantsOf({.piece = 9}));
  EXPECT_EQ(countOf(nothing, {spv::OpStore, spv::OpLoad}), 0u) << "a piece that is not there";
}

TEST(SpirvSpecialize, WithoutConstantsDefaultsHold) {
  const std::vector<std::uint32_t> defaults = {0, 0, 0, 0, 0, std::bit_cast<std::uint32_t>(1.f)};
  for (const Spirv spirv : {Spirv(kSpecializeComp), Spirv(kSpecializeCompWritten)}) {
    const std::vector<std::uint32_t> left = specializeSpirv(spirv, {});
    EXPECT_EQ(refusalOf(left), "");
    EXPECT_EQ(left, specializeSpirv(spirv, defaults));
    EXPECT_EQ(countOf(left, {spv::OpSpecConstant, spv::OpSpecConstantTrue, spv::OpSpecConstantFalse}), 0u);
  }
}

TEST(SpirvSpecialize, LeavesOutFunctionsThatNothingCalls) {
  const std::size_t all = countOf(kSpecializeCompWritten, {spv::OpFunction}),
                    called = countOf(specializeSpirv(Spirv(kSpecializeCompWritten), {}), {spv::OpFunction}),
                    left = countOf(specializeSpirv(Spirv(kSpecializeCompWritten), constantsOf({})), {spv::OpFunction});
  EXPECT_EQ(called, all);
  EXPECT_EQ(left, all - 1) << "slowly() is called where the numbers come from memory";
}

// What instructions of a set do is known of GLSL.std.450 alone: printf() has no result that is read, either.
TEST(SpirvSpecialize, KeepsInstructionsOfOtherSets) {
  const std::vector<std::uint32_t> constants = constantsOf({.piece = 4, .first = 1, .second = 1});
  std::vector<std::uint32_t> words(std::begin(kSpecializeCompWritten), std::end(kSpecializeCompWritten));
  const std::size_t known = countOf(specializeSpirv(words, constants), {spv::OpExtInst});
  const SpirvModule module(words);
  for (const SpirvInstruction& each : module.instructions())
    if (each.opcode == spv::OpExtInstImport) ++words[each.word + 2]; // "HLSL.std.450"
  EXPECT_EQ(countOf(specializeSpirv(words, constants), {spv::OpExtInst}), known + 1) << "a root that nothing reads";
}

// Never a crash: an error, or words that the validator will refuse.
TEST(SpirvSpecialize, DamagedModulesAreReadOrRefused) {
  const Spirv whole = kSpecializeCompWritten;
  const auto expectEnd = [&](const std::vector<std::uint32_t>& words) {
    try {
      specializeSpirv(words, constantsOf({.piece = 2, .first = 1}));
      return true;
    } catch (const base::Error&) {
      return false;
    }
  };
  const SpirvModule module({whole.begin(), whole.end()});
  std::size_t refused = 0;
  for (const SpirvInstruction& each : module.instructions())
    refused += expectEnd({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(each.word)}) ? 0 : 1;
  EXPECT_GT(refused, module.blocks().size()) << "blocks that are cut";
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::uint32_t> words(whole.begin(), whole.end());
    words[5 + random() % (words.size() - 5)] = random() % 3 == 0 ? random() : random() % words[3];
    expectEnd(words);
  }
}

TEST(SpirvSpecialize, RefusesAValueForAConstantOfAnotherWidth) {
  std::vector<std::uint32_t> words(std::begin(kSpecializeComp), std::end(kSpecializeComp));
  const SpirvModule module(words);
  for (const SpirvInstruction& each : module.instructions())
    if (each.opcode == spv::OpTypeFloat) words[each.word + 2] = 16; // kScale is of that type
  base::expectError([&] { specializeSpirv(words, constantsOf({})); }, "specialization constant 5", "is not of 32 bits");
}

TEST(SpirvSpecialize, RefusesWhatIsNoModule) {
  const std::vector<std::uint32_t> words = {1, 2, 3, 4, 5, 6};
  base::expectError([&] { specializeSpirv(words, {}); }, "SPIR-V", "word 0");
}

} // namespace
} // namespace parity::gpu

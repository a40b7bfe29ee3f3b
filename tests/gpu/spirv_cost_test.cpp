// Costs of shaders that are small enough to count by hand (gpu/spirv/spirv_cost.h says what counts).
#include <gtest/gtest.h>

#include "base/error.h"
#include "gpu/spirv/spirv_cost.h"
#include "gpu_shaders/spirv_cost.comp.h"

namespace parity::gpu {
namespace {

ShaderCost costOfPiece(std::uint32_t piece, std::uint32_t turns = 1, std::uint32_t useSecond = 0) {
  const std::uint32_t constants[] = {piece, turns, useSecond};
  return costOf(kSpirvCostComp, constants);
}

TEST(SpirvCost, CountsScalarsOfEachOperation) {
  struct Known {
    std::uint32_t piece;
    std::uint64_t operations;
    const char* what;
  };
  const Known known[] = {{0, 3, "vec3 + vec3"},
                         {1, 5, "dot: 3 multiplications, 2 additions"},
                         {2, 9, "normalize: dot, root, 3 multiplications"},
                         {3, 6, "length: dot, root"},
                         {4, 9, "mix of vec3"},
                         {5, 6, "clamp of vec3: 3 max, 3 min"},
                         {6, 3, "pow: log2, multiplication, exp2"},
                         {7, 15, "mat3 vec3: 3 dots"},
                         {8, 9, "cross: 6 multiplications, 3 subtractions"},
                         {9, 12, "reflect: dot, doubled, 3 multiplications, 3 subtractions"},
                         {11, 2, "comparison and selection"},
                         {16, 0, "nothing reads it"},
                         {18, 5, "two sums and their product"},
                         {19, 6, "fma of vec3"},
                         {20, 11, "smoothstep, addition, exp2"}};
  for (const Known& each : known) {
    const ShaderCost cost = costOfPiece(each.piece);
    EXPECT_EQ(cost.fp32, each.operations) << each.what;
    EXPECT_EQ(cost.fp16 + cost.integer + cost.conversions + cost.branches + cost.openLoops, 0u) << each.what;
    EXPECT_EQ(cost.fetches() + cost.samplers(), 0u) << each.what;
    EXPECT_GT(cost.memory, 0u) << each.what;
  }
}

TEST(SpirvCost, TellsHalfFromFloatAndConversionsFromBoth) {
  const ShaderCost cost = costOfPiece(10);
  EXPECT_EQ(cost.fp16, 3u);
  EXPECT_EQ(cost.fp32, 0u);
  EXPECT_EQ(cost.conversions, 9u) << "two vec3 to half, one back";
  EXPECT_EQ(cost.operations(), 3u);
}

TEST(SpirvCost, UnrollsShortLoopsAndMultipliesLongOnes) {
  const ShaderCost unrolled = costOfPiece(12, 16);
  EXPECT_EQ(unrolled.fp32, 64u);
  EXPECT_EQ(unrolled.integer + unrolled.branches, 0u) << "no counter is left";
  const ShaderCost multiplied = costOfPiece(12, 100);
  EXPECT_EQ(multiplied.fp32, 400u);
  EXPECT_EQ(multiplied.integer, 200u) << "a comparison and an addition a turn";
  EXPECT_EQ(multiplied.branches, 100u);
  EXPECT_EQ(costOfPiece(12, 0).fp32, 0u) << "no turn at all";
}

TEST(SpirvCost, MultipliesNestedLoopsDownwardsToo) {
  EXPECT_EQ(costOfPiece(17).fp32, 20u * 30 * 4);
  EXPECT_EQ(costOfPiece(17).openLoops, 0u);
}

TEST(SpirvCost, CountsALoopWithABreakAsOftenAsItRunsAtMost) {
  const ShaderCost cost = costOfPiece(13);
  EXPECT_EQ(cost.fp32, 4u * (1 + 4));
  EXPECT_EQ(cost.openLoops, 0u);
}

TEST(SpirvCost, SaysWhereALoopsTurnsAreNotKnown) {
  const ShaderCost cost = costOfPiece(14);
  EXPECT_EQ(cost.openLoops, 1u);
  EXPECT_EQ(cost.fp32, 4u) << "once";
}

TEST(SpirvCost, ABranchThatSpecializationRemovesCostsNeitherOperationsNorItsSampler) {
  const ShaderCost without = costOfPiece(15), with = costOfPiece(15, 1, 1);
  EXPECT_EQ(without.fp32, 4u);
  EXPECT_EQ(without.fetches(), 2u);
  ASSERT_EQ(without.samplers(), 1u) << "read twice, bound once";
  EXPECT_EQ(without.images[0].set, 1u);
  EXPECT_EQ(without.images[0].binding, 2u);
  EXPECT_EQ(without.images[0].fetches, 2u);
  EXPECT_EQ(with.fp32, 12u);
  EXPECT_EQ(with.fetches(), 3u);
  ASSERT_EQ(with.samplers(), 2u);
  EXPECT_EQ(with.images[1].binding, 5u);
}

TEST(SpirvCost, IsTheSameEveryTime) {
  EXPECT_EQ(costOfPiece(17).integer, costOfPiece(17).integer);
  EXPECT_EQ(costOfPiece(15, 1, 1).moves, costOfPiece(15, 1, 1).moves);
}

TEST(SpirvCost, RefusesWhatIsNoSpirv) {
  const std::uint32_t words[] = {1, 2, 3};
  EXPECT_THROW(costOf(words, {}), base::Error);
  std::vector<std::uint32_t> cut(std::begin(kSpirvCostComp), std::end(kSpirvCostComp));
  cut.resize(cut.size() - 1);
  EXPECT_THROW(costOf(cut, {}), base::Error);
}

} // namespace
} // namespace parity::gpu

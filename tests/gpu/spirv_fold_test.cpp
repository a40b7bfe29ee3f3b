// Instructions on integers and booleans against arithmetic on 64 bits.
#include "gpu/spirv/spirv_fold.h"

#include <array>
#include <functional>
#include <map>

#include <glslang/SPIRV/spirv.hpp>
#include <gtest/gtest.h>

namespace parity::gpu {
namespace {

TEST(SpirvFold, ComputesAsTheSpecificationDefines) {
  using Wide = std::int64_t;
  const auto floorMod = [](Wide x, Wide y) { return ((x % y) + y) % y; };
  const std::map<std::uint32_t, std::function<Wide(Wide, Wide)>> known = {
      {spv::OpIAdd, [](Wide x, Wide y) { return x + y; }},
      {spv::OpISub, [](Wide x, Wide y) { return x - y; }},
      {spv::OpIMul, [](Wide x, Wide y) { return x * y; }},
      {spv::OpSDiv, [](Wide x, Wide y) { return x / y; }},
      {spv::OpSRem, [](Wide x, Wide y) { return x % y; }},
      {spv::OpSMod, floorMod},
      {spv::OpSLessThan, [](Wide x, Wide y) { return Wide{x < y}; }},
      {spv::OpSGreaterThanEqual, [](Wide x, Wide y) { return Wide{x >= y}; }},
      {spv::OpUDiv, [](Wide x, Wide y) { return Wide{std::uint32_t(x)} / Wide{std::uint32_t(y)}; }},
      {spv::OpUMod, [](Wide x, Wide y) { return Wide{std::uint32_t(x)} % Wide{std::uint32_t(y)}; }},
      {spv::OpULessThanEqual, [](Wide x, Wide y) { return Wide{std::uint32_t(x) <= std::uint32_t(y)}; }},
      {spv::OpUGreaterThan, [](Wide x, Wide y) { return Wide{std::uint32_t(x) > std::uint32_t(y)}; }}};
  const auto fold = [](std::uint32_t opcode, std::optional<std::uint32_t> x, std::optional<std::uint32_t> y) {
    const std::array operands = {x, y};
    return foldSpirv(opcode, operands);
  };
  for (const auto& [opcode, compute] : known)
    for (const std::int32_t x : {0, 1, -1, 7, -7, 1'000'000'007, -2'147'483'647})
      for (const std::int32_t y : {1, -1, 2, -3, 65'537, -2'147'483'647 - 1})
        EXPECT_EQ(fold(opcode, x, y), static_cast<std::uint32_t>(compute(x, y))) << opcode << ": " << x << ", " << y;
  for (const std::uint32_t opcode : {spv::OpUDiv, spv::OpSDiv, spv::OpUMod, spv::OpSMod, spv::OpSRem})
    EXPECT_EQ(fold(opcode, 5, 0), std::nullopt) << "not defined";
  EXPECT_EQ(fold(spv::OpSDiv, 0x80000000u, 0xffffffffu), std::nullopt) << "not defined";
  EXPECT_EQ(fold(spv::OpShiftLeftLogical, 1, 32), std::nullopt) << "not defined";
  EXPECT_EQ(fold(spv::OpShiftLeftLogical, 1, 31), 0x80000000u);
  EXPECT_EQ(fold(spv::OpLogicalAnd, std::nullopt, 0), 0u) << "one operand decides";
  EXPECT_EQ(fold(spv::OpLogicalAnd, std::nullopt, 1), std::nullopt);
  EXPECT_EQ(fold(spv::OpLogicalOr, 1, std::nullopt), 1u);
  EXPECT_EQ(fold(spv::OpLogicalOr, 0, std::nullopt), std::nullopt);
  EXPECT_EQ(fold(spv::OpBitwiseAnd, 0, std::nullopt), 0u);
  EXPECT_EQ(fold(spv::OpBitwiseOr, 1, std::nullopt), std::nullopt) << "other bits are not known";
  EXPECT_EQ(fold(spv::OpFAdd, 1, 1), std::nullopt) << "left to the driver";
}

TEST(SpirvFold, ComputesBitsAndBooleans) {
  const auto fold = [](std::uint32_t opcode, std::vector<std::optional<std::uint32_t>> operands) {
    return foldSpirv(opcode, operands);
  };
  EXPECT_EQ(fold(spv::OpSNegate, {5}), 0xfffffffbu);
  EXPECT_EQ(fold(spv::OpNot, {5}), 0xfffffffau);
  EXPECT_EQ(fold(spv::OpLogicalNot, {1}), 0u);
  EXPECT_EQ(fold(spv::OpLogicalNot, {0}), 1u);
  EXPECT_EQ(fold(spv::OpBitcast, {0x80000000u}), 0x80000000u);
  EXPECT_EQ(fold(spv::OpShiftRightLogical, {0x80000000u, 31}), 1u);
  EXPECT_EQ(fold(spv::OpShiftRightArithmetic, {0x80000000u, 31}), 0xffffffffu);
  EXPECT_EQ(fold(spv::OpBitwiseXor, {6, 3}), 5u);
  EXPECT_EQ(fold(spv::OpBitwiseOr, {6, 3}), 7u);
  EXPECT_EQ(fold(spv::OpLogicalEqual, {1, 1}), 1u);
  EXPECT_EQ(fold(spv::OpLogicalNotEqual, {1, 1}), 0u);
  EXPECT_EQ(fold(spv::OpSelect, {1, 7, std::nullopt}), 7u);
  EXPECT_EQ(fold(spv::OpSelect, {0, 7, std::nullopt}), std::nullopt);
  EXPECT_EQ(fold(spv::OpSelect, {std::nullopt, 7, 7}), std::nullopt);
}

} // namespace
} // namespace parity::gpu

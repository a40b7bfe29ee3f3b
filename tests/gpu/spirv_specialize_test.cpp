// Shaders with their constants put in do what they do with the same numbers from memory, to the last bit.
#include "gpu/spirv/spirv_specialize.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <map>

#include <glslang/SPIRV/spirv.hpp>
#include <spirv-tools/libspirv.hpp>

#include "base/expect_error.h"
#include "gpu/spirv/spirv_fold.h"
#include "gpu/spirv/spirv_module.h"
#include "gpu_shaders/specialize.comp.h"
#include "support/device.h"

namespace parity::gpu {
namespace {

constexpr std::size_t kResults = 64;
constexpr std::uint32_t kUnwritten = 0xabcdef01;
constexpr vk::ShaderStageFlags kStage = vk::ShaderStageFlagBits::eCompute;

// The numbers of specialize.comp, in its order.
struct Numbers {
  std::uint32_t piece = 0, first = 0, second = 0;
  bool switched = false;
  float scale = 1.25f;
};

std::vector<std::uint32_t> constantsOf(const Numbers& numbers) {
  return {
      1, numbers.piece, numbers.first, numbers.second, numbers.switched, std::bit_cast<std::uint32_t>(numbers.scale)};
}

std::string refusalOf(std::span<const std::uint32_t> words) {
  std::string message;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
  tools.SetMessageConsumer(
      [&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { message = text; });
  return tools.Validate(words.data(), words.size()) ? "" : message;
}

class SpirvSpecializeTest : public tests::DeviceTest {
protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (IsSkipped()) return;
    const std::array<Binding, 2> bindings = {BufferBinding{}, BufferBinding{}};
    m_setLayout = makeSetLayout(device(), bindings, kStage);
    const std::array<vk::DescriptorSetLayout, 1> sets = {*m_setLayout};
    m_layout = makePipelineLayout(device(), sets, 0, kStage);
  }

  // What a driver makes of the module as it was written, with nothing known: the truth.
  vk::raii::Pipeline plain() const {
    const vk::raii::ShaderModule module(
        device().handle(), vk::ShaderModuleCreateInfo({}, sizeof(kSpecializeCompWritten), kSpecializeCompWritten));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    return {device().handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *m_layout)};
  }
  vk::raii::Pipeline specialized(Spirv spirv, const Numbers& numbers) const {
    return makeComputePipeline(device(), m_layout, spirv, constantsOf(numbers));
  }

  std::vector<std::uint32_t> run(const vk::raii::Pipeline& pipeline, const Numbers& numbers) const {
    std::vector<std::uint32_t> in = {numbers.piece, numbers.first, numbers.second, numbers.switched,
                                     std::bit_cast<std::uint32_t>(numbers.scale)};
    for (const float value : {0.3f, 1.7f, 0.1f, 0.9f, -0.4f, 0.6f, 2.2f, 0.7f})
      in.push_back(std::bit_cast<std::uint32_t>(value));
    in.resize(64);
    const std::vector<std::uint32_t> unwritten(kResults, kUnwritten);
    const Buffer inputs(device(), std::span<const std::uint32_t>(in)),
        outputs(device(), std::span<const std::uint32_t>(unwritten));
    const std::vector<Binding> bindings = {storage(inputs), storage(outputs)};
    const DescriptorSets sets(device(), m_setLayout, std::span{&bindings, 1});
    device().submit("test", [&](const vk::raii::CommandBuffer& commands) {
      commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
      commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *m_layout, 0, sets[0], nullptr);
      commands.dispatch(1, 1, 1);
      fullBarrier(commands);
    });
    return outputs.downloadAs<std::uint32_t>(kResults);
  }

  void expectSame(const std::vector<Numbers>& cases) const {
    const vk::raii::Pipeline truth = plain();
    for (const Numbers& numbers : cases) {
      SCOPED_TRACE(testing::Message() << "piece " << numbers.piece << ", " << numbers.first << ", " << numbers.second
                                      << ", " << numbers.switched << ", " << numbers.scale);
      const std::vector<std::uint32_t> expected = run(truth, numbers);
      EXPECT_NE(expected[0], kUnwritten);
      for (const Spirv spirv : {Spirv(kSpecializeComp), Spirv(kSpecializeCompWritten)}) {
        EXPECT_EQ(refusalOf(specializeSpirv(spirv, constantsOf(numbers))), "");
        EXPECT_EQ(run(specialized(spirv, numbers), numbers), expected);
      }
    }
  }

private:
  vk::raii::DescriptorSetLayout m_setLayout{nullptr};
  vk::raii::PipelineLayout m_layout{nullptr};
};

// Against arithmetic on 64 bits.
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

// What is left of a module whose piece is known: that piece.
TEST(SpirvSpecialize, LeavesOutWhatCannotRun) {
  const Spirv all = kSpecializeComp;
  for (const std::uint32_t piece : {1u, 2u, 3u, 4u}) {
    const std::vector<std::uint32_t> left =
        specializeSpirv(all, constantsOf({.piece = piece, .first = 2, .second = 4}));
    EXPECT_LT(left.size() * 2, all.size()) << "piece " << piece;
    EXPECT_EQ(left, specializeSpirv(all, constantsOf({.piece = piece, .first = 2, .second = 4})));
    const SpirvModule module(left);
    const auto isConditional = [](const SpirvInstruction& each) { return each.opcode == spv::OpBranchConditional; };
    const auto isSpecialized = [](const SpirvInstruction& each) {
      return each.opcode == spv::OpSpecConstant || each.opcode == spv::OpSpecConstantTrue ||
             each.opcode == spv::OpSpecConstantFalse;
    };
    EXPECT_TRUE(std::ranges::none_of(module.instructions(), isSpecialized));
    EXPECT_TRUE(piece != 4 || std::ranges::none_of(module.instructions(), isConditional)) << "all are decided";
  }
  const std::vector<std::uint32_t> nothing = specializeSpirv(all, constantsOf({.piece = 9}));
  const SpirvModule module(nothing);
  EXPECT_TRUE(std::ranges::none_of(module.instructions(), [](const SpirvInstruction& each) {
    return each.opcode == spv::OpStore || each.opcode == spv::OpLoad;
  })) << "a piece that is not there";
}

TEST(SpirvSpecialize, WithoutConstantsDefaultsHold) {
  const std::vector<std::uint32_t> left = specializeSpirv(Spirv(kSpecializeComp), {});
  EXPECT_EQ(refusalOf(left), "");
  EXPECT_GT(left.size(), specializeSpirv(Spirv(kSpecializeComp), constantsOf({.piece = 1})).size());
}

TEST(SpirvSpecialize, RefusesWhatIsNoModule) {
  const std::vector<std::uint32_t> words = {1, 2, 3, 4, 5, 6};
  base::expectError([&] { specializeSpirv(words, {}); }, "SPIR-V", "word 0");
}

TEST_F(SpirvSpecializeTest, ComputesWithIntegersAsADeviceDoes) {
  std::vector<Numbers> cases;
  for (const std::uint32_t first : {0u, 5u, 0x80000000u, 0xfffffff9u})
    for (const std::uint32_t second : {0u, 3u, 0x7fffffffu, 0xffffffffu})
      cases.push_back({.piece = 0, .first = first, .second = second, .switched = (first ^ second) % 2 == 0});
  expectSame(cases);
}

TEST_F(SpirvSpecializeTest, LeavesLoopsSwitchesAndFunctionsAsWritten) {
  std::vector<Numbers> cases;
  for (std::uint32_t first = 0; first < 4; ++first)
    for (const std::uint32_t second : {0u, 1u, 7u})
      for (const bool switched : {false, true})
        cases.push_back({.piece = 1, .first = first, .second = second, .switched = switched});
  expectSame(cases);
}

TEST_F(SpirvSpecializeTest, LoopsThatRunOnceOrNeverAreValid) {
  std::vector<Numbers> cases;
  for (const std::uint32_t piece : {2u, 3u})
    for (const std::uint32_t first : {0u, 5u})
      for (const std::uint32_t second : {0u, 6u})
        for (const bool switched : {false, true})
          cases.push_back({.piece = piece, .first = first, .second = second, .switched = switched});
  expectSame(cases);
}

TEST_F(SpirvSpecializeTest, KeepsStoresThatAreReadAndWritesThroughPointers) {
  std::vector<Numbers> cases;
  for (std::uint32_t first = 0; first < 3; ++first)
    for (const std::uint32_t second : {1u, 2u})
      for (const bool switched : {false, true})
        cases.push_back({.piece = 4, .first = first, .second = second, .switched = switched, .scale = 0.7f});
  expectSame(cases);
}

} // namespace
} // namespace parity::gpu

// Shaders with their constants put in do what they do with the same numbers from memory, to the last bit, on the
// software device.
#include "gpu/spirv/spirv_specialize.h"

#include <array>
#include <initializer_list>

#include "gpu/specialize_numbers.h"
#include "gpu_shaders/specialize.comp.h"
#include "support/device.h"

namespace parity::gpu {
namespace {

constexpr std::size_t kResults = 64;
constexpr std::uint32_t kUnwritten = 0xabcdef01;
constexpr vk::ShaderStageFlags kStage = vk::ShaderStageFlagBits::eCompute;

// Every combination, switched and not.
std::vector<Numbers> casesOf(std::initializer_list<std::uint32_t> pieces, std::initializer_list<std::uint32_t> firsts,
                             std::initializer_list<std::uint32_t> seconds) {
  std::vector<Numbers> cases;
  for (const std::uint32_t piece : pieces)
    for (const std::uint32_t first : firsts)
      for (const std::uint32_t second : seconds)
        for (const bool switched : {false, true})
          cases.push_back({.piece = piece, .first = first, .second = second, .switched = switched});
  return cases;
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

TEST_F(SpirvSpecializeTest, ComputesWithIntegersAsADeviceDoes) {
  std::vector<Numbers> cases;
  for (const std::uint32_t first : {0u, 5u, 0x80000000u, 0xfffffff9u})
    for (const std::uint32_t second : {0u, 3u, 0x7fffffffu, 0xffffffffu})
      cases.push_back({.piece = 0, .first = first, .second = second, .switched = (first ^ second) % 2 == 0});
  expectSame(cases);
}

TEST_F(SpirvSpecializeTest, LeavesLoopsSwitchesAndFunctionsAsWritten) {
  expectSame(casesOf({1}, {0, 1, 2, 3}, {0, 1, 7}));
}

TEST_F(SpirvSpecializeTest, LoopsThatRunOnceOrNeverAreValid) { expectSame(casesOf({2u, 3u}, {0u, 5u}, {0u, 6u})); }

TEST_F(SpirvSpecializeTest, KeepsStoresThatAreReadAndWritesThroughPointers) {
  std::vector<Numbers> cases;
  for (std::uint32_t first = 0; first < 3; ++first)
    for (const std::uint32_t second : {1u, 2u})
      for (const bool switched : {false, true})
        cases.push_back({.piece = 4, .first = first, .second = second, .switched = switched, .scale = 0.7f});
  expectSame(cases);
}

TEST_F(SpirvSpecializeTest, CallsWithPointersAndLoopsAroundLoopsAreTheSame) {
  expectSame(casesOf({5u, 6u}, {0u, 3u}, {1u, 2u}));
}

} // namespace
} // namespace parity::gpu

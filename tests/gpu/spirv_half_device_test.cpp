// Conversions to half by bits give what the driver's own give, and what rounding to nearest even gives, to the last
// bit; widened comparisons give what the driver's own give, and what numbers do.
#include "gpu/spirv/spirv_half.h"

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "gpu/run_words.h"
#include "gpu/spirv/spirv_half_compare.h"
#include "gpu/spirv/spirv_specialize.h"
#include "gpu_shaders/half.comp.h"
#include "gpu_shaders/half_compare.comp.h"
#include "shading/half.h"
#include "support/device.h"

namespace parity::gpu {
namespace {

using shading::Half;

constexpr std::size_t kWords = 6, kComparedWords = 5; // a number's, as half.comp and half_compare.comp write them

// Every half, the numbers halfway between neighbours, the floats beside both, and any bits at all.
std::vector<float> numbersToConvert() {
  std::vector<float> numbers;
  for (std::uint32_t bits = 0; bits <= 0x7c00; ++bits) {
    const float half = Half::fromBits(static_cast<std::uint16_t>(bits));
    const float next = bits < 0x7bff ? float(Half::fromBits(static_cast<std::uint16_t>(bits + 1))) : 65536.f;
    const std::uint32_t exact = std::bit_cast<std::uint32_t>(half),
                        middle = std::bit_cast<std::uint32_t>(half + (next - half) / 2);
    for (const std::uint32_t near : {exact - 1, exact, exact + 1, middle - 1, middle, middle + 1})
      for (const std::uint32_t sign : {0u, 0x80000000u}) numbers.push_back(std::bit_cast<float>(near | sign));
  }
  for (const std::uint32_t bits : {0x1u, 0x7fffffu, 0x800000u, 0x7f7fffffu, 0x7f800000u, 0x7f800001u, 0x7fffffffu})
    for (const std::uint32_t sign : {0u, 0x80000000u}) numbers.push_back(std::bit_cast<float>(bits | sign));
  std::mt19937 random(1);
  while (numbers.size() % 64 != 0 || numbers.size() < 600000)
    numbers.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  return numbers;
}

class SpirvHalfTest : public tests::DeviceTest {
protected:
  std::vector<std::uint32_t> run(const std::vector<std::uint32_t>& words, const std::vector<float>& numbers,
                                 std::size_t wordsOfNumber) const {
    const std::array<std::byte, 4> texel{};
    const std::span<const std::byte> mip = texel;
    const DeviceImage image(device(), {.width = 1, .height = 1, .mips = 1}, std::span{&mip, 1});
    const vk::raii::Sampler sampler(device().handle(), vk::SamplerCreateInfo());
    const Buffer in(device(), std::span<const float>(numbers)),
        out(device(), numbers.size() * wordsOfNumber * sizeof(std::uint32_t));
    runWords(device(), words,
             {storage(in), storage(out), vk::DescriptorImageInfo(*sampler, image.view(), kReadOnlyLayout)},
             static_cast<std::uint32_t>(numbers.size() / 64));
    return out.downloadAs<std::uint32_t>(numbers.size() * wordsOfNumber);
  }
};

// Bits of NaN but its sign are left open by both.
std::uint16_t bitsOf(std::uint16_t half) { return (half & 0x7fffu) > 0x7c00u ? half | 0x7fffu : half; }
std::uint32_t pairOf(float x, float y) { return bitsOf(Half(x).bits()) | std::uint32_t{bitsOf(Half(y).bits())} << 16; }

TEST_F(SpirvHalfTest, RoundsEveryNumberToTheNearestHalf) {
  if (!device().report().float16) GTEST_SKIP() << "the device has no arithmetic in half";
  const std::vector<float> numbers = numbersToConvert();
  const std::vector<std::uint32_t> plain = specializeSpirv(kHalfComp, std::array{0u}),
                                   byBits = convertHalvesByBits(plain);
  ASSERT_NE(byBits, plain);
  std::vector<std::vector<std::uint32_t>> results = {run(byBits, numbers, kWords)};
  // Another device may round otherwise, or flush denormals: only the software device's own bits are to be kept.
  if (device().properties().deviceType == vk::PhysicalDeviceType::eCpu) results.push_back(run(plain, numbers, kWords));
  for (const std::vector<std::uint32_t>& result : results)
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const float x = numbers[i], y = numbers[i ^ 1], z = numbers[i ^ 2], w = numbers[i ^ 3];
      const std::array<std::uint32_t, kWords> expected = {pairOf(x, 0), pairOf(x, y), pairOf(x, y),
                                                          pairOf(z, 0), pairOf(x, y), pairOf(z, w)};
      for (std::size_t k = 0; k < kWords; ++k) {
        const std::uint32_t word = result[kWords * i + k];
        const std::uint32_t found = bitsOf(static_cast<std::uint16_t>(word)) |
                                    std::uint32_t{bitsOf(static_cast<std::uint16_t>(word >> 16))} << 16;
        ASSERT_EQ(found, expected[k]) << "word " << k << " of " << x << ", " << y << ", " << z << ", " << w << ", "
                                      << (&result == results.data() ? "by bits" : "by the driver");
      }
    }
}

// < <= > >= == !=, a bit each.
template <typename T> std::uint32_t compare(T a, T b) {
  return std::uint32_t{a < b} | std::uint32_t{a <= b} << 1 | std::uint32_t{a > b} << 2 | std::uint32_t{a >= b} << 3 |
         std::uint32_t{a == b} << 4 | std::uint32_t{a != b} << 5;
}

// expected: the operand that is not NaN. The sign of zero is open.
void expectHalf(std::uint32_t bits, float expected, const std::string& what) {
  const float found = Half::fromBits(static_cast<std::uint16_t>(bits));
  ASSERT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected))) << what << ": " << found;
}

TEST_F(SpirvHalfTest, ComparesEveryHalfAsTheNumberThatItIs) {
  if (!device().report().float16) GTEST_SKIP() << "the device has no arithmetic in half";
  const std::vector<float> numbers = numbersToConvert();
  const std::vector<std::uint32_t> plain =
                                       convertHalvesByBits({std::begin(kHalfCompareComp), std::end(kHalfCompareComp)}),
                                   widened = compareHalvesWidened(plain);
  ASSERT_NE(widened, plain);
  const std::vector<std::uint32_t> results = run(widened, numbers, kComparedWords);
  if (device().properties().deviceType == vk::PhysicalDeviceType::eCpu) {
    ASSERT_TRUE(run(plain, numbers, kComparedWords) == results) << "the driver's own comparisons give other bits";
  }
  constexpr float kOne = 1, kLargest = 65504;
  const float small = Half(6.0e-8f);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const float x = numbers[i], a = Half(x), b = Half(numbers[i ^ 1]), near = Half(numbers[i ^ 2]);
    const std::uint32_t* result = &results[kComparedWords * i];
    const std::string what = std::to_string(a) + ", " + std::to_string(b);
    // A device may take a 32-bit denormal for 0. It must keep denormal halves.
    if (std::abs(x) >= 0x1p-126f || x == 0 || std::isnan(x)) {
      ASSERT_EQ(result[0], compare(a, b) | compare(a, small) << 6 | compare(kOne, a) << 12 | compare(a, kLargest) << 18)
          << what;
      ASSERT_EQ(result[1], compare(a, 0.f) | compare(-2.5f, a) << 6 | compare(x, kLargest) << 12 |
                               compare(x, 0.1f) << 18 | std::uint32_t{x > a} << 24)
          << what << " of " << x;
    }
    expectHalf(result[2], std::fmin(a, b), "min " + what);
    expectHalf(result[2] >> 16, std::fmax(a, b), "max " + what);
    expectHalf(result[3], std::fmax(kOne, a), "max(1, a) " + what);
    expectHalf(result[3] >> 16, std::fmin(std::fmax(a, 0.f), 1.f), "saturate " + what);
    ASSERT_EQ(result[4] & 0xffffu, compare(a, near)) << a << ", " << near;
    expectHalf(result[4] >> 16, std::fmax(a, near), "max of neighbours " + what);
    if (HasFatalFailure()) return;
  }
}

} // namespace
} // namespace parity::gpu

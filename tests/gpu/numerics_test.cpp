// The dispatch behind the numerics id: it computes what it says, and the same words each time.
#include "gpu/device/numerics.h"

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <set>

#include "gpu/shaders/numerics_interface.h"
#include "support/device.h"

namespace parity::gpu {
namespace {

// As the shader's realOf.
double realOf(std::uint32_t seed) {
  seed = (seed ^ 61u) ^ (seed >> 16);
  seed *= 9u;
  seed ^= seed >> 4;
  seed *= 0x27d4eb2du;
  seed ^= seed >> 15;
  return std::bit_cast<float>(0x3f800000u | (seed >> 9));
}

using NumericsTest = tests::DeviceTest;

TEST_F(NumericsTest, EachWordIsTheFunctionOfItsColumnWithinVulkansPrecision) {
  const std::vector<std::uint32_t> words = numericsOf(device());
  ASSERT_EQ(words.size(), std::size_t{kNumericsRows} * kNumericsWords);
  struct Column {
    const char* name;
    std::function<double(double, double)> truth;
    double relative, absolute; // Vulkan 1.3, "Precision and Operation of SPIR-V Instructions", with room
  };
  const std::array<Column, 10> columns = {{
      {"division", [](double x, double y) { return x / y; }, 1e-6, 0},
      {"sqrt", [](double x, double) { return std::sqrt(x); }, 1e-6, 0},
      {"inversesqrt", [](double, double y) { return 1 / std::sqrt(y); }, 1e-6, 0},
      {"exp2", [](double x, double) { return std::exp2(8 * (x - 0.5)); }, 1e-5, 0},
      {"log2", [](double x, double) { return std::log2(x + 1e-6); }, 1e-4, 1e-5},
      {"pow", [](double x, double y) { return std::pow(x, 5 * y); }, 1e-3, 1e-6},
      {"fma", [](double x, double y) { return x * y - 0.5; }, 1e-6, 2e-7},
      {"sin", [](double x, double) { return std::sin(6 * x); }, 0, 1e-3},
      {"atan", [](double x, double y) { return std::atan2(x, y); }, 1e-3, 1e-6},
      {"dot", [](double x, double y) { return x * y - y * x + 0.3 * 0.7; }, 1e-5, 1e-6},
  }};
  for (std::uint32_t row = 0; row < kNumericsRows; ++row) {
    const double x = realOf(2 * row) - 1, y = realOf(2 * row + 1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double truth = columns[i].truth(x, y);
      const double value = std::bit_cast<float>(words[row * kNumericsWords + i]);
      ASSERT_NEAR(value, truth, columns[i].relative * std::abs(truth) + columns[i].absolute)
          << columns[i].name << " of " << x << ", " << y;
    }
    for (std::size_t i = columns.size() + 1; i < columns.size() + 5; ++i) {
      const float texel = std::bit_cast<float>(words[row * kNumericsWords + i]);
      ASSERT_TRUE(texel >= 0 && texel <= 1) << "a fetch of 8 bits: " << texel;
    }
  }
  std::set<std::uint32_t> fetched;
  for (std::uint32_t row = 0; row < kNumericsRows; ++row) fetched.insert(words[row * kNumericsWords + 11]);
  EXPECT_GT(fetched.size(), kNumericsRows / 8) << "weights of all kinds, not single texels";
}

TEST_F(NumericsTest, WordsAreTheSameEachTime) { EXPECT_EQ(numericsOf(device()), numericsOf(device())); }

} // namespace
} // namespace parity::gpu

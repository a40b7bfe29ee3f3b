// The roots and powers that FLIP's vector loops use, against the standard library.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "compare/flip/flip_math-inl.h"

namespace parity::compare {
namespace {

namespace simd = HWY_NAMESPACE; // of the baseline instruction set: the formulas are the same in all
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 1>;

template <typename Function> double evaluate(Function function, float x) {
  const D d;
  return static_cast<double>(hn::GetLane(function(d, hn::Set(d, x))));
}

TEST(FlipMath, CubeRootsStayWithinTheStatedError) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(std::log2(1e-3), 1);
  for (int i = 0; i < 200000; ++i) {
    const float x = static_cast<float>(std::exp2(exponent(random)));
    const double found = evaluate([](D d, auto v) { return simd::fastCbrt(d, v); }, x);
    ASSERT_NEAR(found / std::cbrt(static_cast<double>(x)), 1, 2.5e-7) << x;
  }
}

TEST(FlipMath, LogarithmsStayWithinTheStatedError) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> exponent(-125, 125);
  for (int i = 0; i < 200000; ++i) {
    const float x = static_cast<float>(std::exp2(i % 2 == 0 ? exponent(random) : exponent(random) / 100));
    const double exact = std::log2(static_cast<double>(x));
    const double found = evaluate([](D d, auto v) { return simd::fastLog2(d, v); }, x);
    ASSERT_NEAR(found, exact, 2e-7 + 6e-8 * std::fabs(exact)) << x;
  }
}

TEST(FlipMath, PowersOfTwoStayWithinTheStatedError) {
  std::mt19937 random(13);
  std::uniform_real_distribution<float> exponent(-126, 126);
  for (int i = 0; i < 200000; ++i) {
    const float x = exponent(random);
    const double found = evaluate([](D d, auto v) { return simd::fastExp2(d, v); }, x);
    ASSERT_NEAR(found / std::exp2(static_cast<double>(x)), 1, 3e-7) << x;
  }
}

} // namespace
} // namespace parity::compare

// --at gives back what a run reported, to the last bit.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "study/stress/function_stress.h"

namespace parity::tests {
namespace {

using namespace stress;

TEST(StressAt, GivesBackTheWorstErrorBitForBit) {
  for (const char* name : {"D_GGX", "mobileIntegrateBxDF", "squareFalloff", "refitLobe", "halfVector"}) {
    const FunctionCase function = functionsNamed(name).front();
    const FunctionResult result = stressFunction(function, {.points = 3000, .devicePoints = 0}, nullptr);
    for (const Column& column : result.columns) {
      if (!column.tally.worstError) continue; // fp64
      const Example& worst = *column.tally.worstError;
      const At at = parseAt(formatAt(function, worst.row));
      const Row row = roundTo(column.precision, function.domain, at.row);
      EXPECT_EQ(row, worst.row) << column.name();
      const Result value = evaluateRounded(column.precision, function.id, row), exact = evaluate64(function.id, row);
      const auto k = static_cast<std::size_t>(worst.output);
      const double scale =
          std::max({std::fabs(exact[k]), function.errorScale, formatOf(column.precision).smallestNormal});
      EXPECT_EQ(std::fabs(value[k] - exact[k]) / scale, worst.value) << column.name() << " of " << name;
      EXPECT_NE(describeAt(at, nullptr).find(formatExactly(value[k])), std::string::npos) << "and it is printed";
    }
  }
}

TEST(StressAt, NumbersReadBackAsTheyWereWritten) {
  for (const double x : {0.1, 0x1p-149, 1 / 3.0, 65504.0, std::numeric_limits<double>::infinity(), -0.0}) {
    const At at = parseAt("sqr:" + formatExactly(x));
    EXPECT_EQ(at.row[0], x);
    EXPECT_EQ(std::signbit(at.row[0]), std::signbit(x));
  }
  EXPECT_TRUE(std::isnan(parseAt("sqr:nan").row[0]));
}

TEST(StressAt, RefusesWhatIsNoInput) {
  for (const char* text :
       {"D_GGX", "D_GGX:1", "D_GGX:1,2,3", "D_GGX:1,x", "D_GGX:1,", "nothing:1", "D_*:1,1", "D_GGX:1 ,2"}) {
    SCOPED_TRACE(text);
    base::expectError([&] { parseAt(text); }, {}, base::ExitCode::usage);
  }
}

TEST(StressAt, SaysWhatLiesOutside) {
  EXPECT_EQ(describeAt(parseAt("D_GGX:0.5,1"), nullptr).find("outside"), std::string::npos);
  EXPECT_NE(describeAt(parseAt("D_GGX:0.5,2"), nullptr).find("outside"), std::string::npos);
}

} // namespace
} // namespace parity::tests

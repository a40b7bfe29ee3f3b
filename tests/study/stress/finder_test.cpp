// What is planted is found, and nothing else.
#include "study/stress/planted.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "study/stress/stress_run.h"

namespace parity::tests {
namespace {

using namespace stress;
constexpr double kNan64 = std::numeric_limits<double>::quiet_NaN();

Expectation nanBelow(double r) {
  return {Fault::notFinite,
          kInAll,
          r == 0.25 ? [](const Row& row) { return row[0] < 0.25; } : [](const Row& row) { return row[0] < 0.125; },
          "small r",
          "for the test",
          Row{}};
}

TEST(Finder, SaysNothingOfAFunctionWithoutFaults) {
  FunctionCase function = makePlanted();
  function.increases("r").increases("c").sameSwapping("r", "c");
  const FunctionResult result = run(function, [](double r, double c) { return r * c; });
  EXPECT_TRUE(findingsOf(result).empty());
  EXPECT_GT(result.columns[2].tally.pairs, 1000u);
  EXPECT_EQ(result.columns[0].tally.worstError, std::nullopt) << "fp64 is its own reference";
}

TEST(Finder, FindsARegionOfNan) {
  const FunctionResult result =
      run(makePlanted(), [](double r, double c) { return r < 0.2 && c > 0.9 ? kNan64 : r + c; });
  const std::vector<Finding> found = unexpectedOf(result);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].fault, "not finite");
  EXPECT_GT(found[0].count, 100u);
}

TEST(Finder, FindsASingleInfinityAtTheEdgeOfTheDomain) {
  const std::vector<Finding> found = unexpectedOf(run(
      makePlanted(), [](double r, double c) { return r == 0 && c == 1 ? 1 / 0.0 : c; }, 0));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].reproduce, "--at planted:0,1");
}

TEST(Finder, FindsNegativeValuesAndThoseAboveOne) {
  FunctionCase function = makePlanted();
  function.gives(1, 1, 1);
  const std::vector<Finding> found = unexpectedOf(run(function, [](double r, double c) { return r + c - 0.5; }));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].fault, "negative");
  EXPECT_EQ(found[1].fault, "above 1");
  EXPECT_NEAR(found[0].magnitude, 0.5, 0) << "the worst one, at 0, 0";
  EXPECT_NEAR(found[1].magnitude, 1.5, 0);
}

TEST(Finder, FindsADecreaseThatMayNotBe) {
  FunctionCase function = makePlanted();
  function.increases("r");
  // Falls by a tenth between .5 and .6.
  const auto dent = [](double r, double) { return r < 0.5 ? r : r < 0.6 ? 1 - r : r - 0.2; };
  const std::vector<Finding> found = unexpectedOf(run(function, dent));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].fault, "not monotone");
  EXPECT_NE(found[0].example.find(" to planted:"), std::string::npos) << "names both rows: " << found[0].example;
  function.claims[0].kind = Claim::Kind::decreasing;
  EXPECT_EQ(unexpectedOf(run(function, [](double r, double) { return 1 - r; })).size(), 0u);
}

TEST(Finder, FindsWhatIsNotReciprocal) {
  FunctionCase function = makePlanted();
  function.sameSwapping("r", "c");
  EXPECT_EQ(unexpectedOf(run(function, [](double r, double c) { return r + c; })).size(), 0u);
  const std::vector<Finding> found = unexpectedOf(run(function, [](double r, double c) { return r + 0.9 * c; }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].fault, "not reciprocal");
}

TEST(Finder, ToleratesRoundingOfTheClaimsButNoMore) {
  FunctionCase function = makePlanted();
  function.gives(1).increases("r");
  const auto shaken = [](double r, double c, double ulps) { // in units of half at values of about 1
    return 1 + 1e-4 * r + (std::fmod(r * 1e6 + c, 2) < 1 ? ulps : 0) * 0x1p-10;
  };
  EXPECT_EQ(unexpectedOf(run(function, [&](double r, double c) { return shaken(r, c, 12); })).size(), 0u);
  EXPECT_EQ(unexpectedOf(run(function, [&](double r, double c) { return shaken(r, c, 40); })).size(), 1u);
}

TEST(Finder, AKnownFailureIsExpectedInsideItsRegionAlone) {
  FunctionCase function = makePlanted();
  function.expect(nanBelow(0.25));
  const auto failing = [](double r, double) { return r < 0.2 ? kNan64 : r; };
  const FunctionResult result = run(function, failing);
  EXPECT_EQ(unexpectedOf(result).size(), 0u);
  ASSERT_EQ(findingsOf(result).size(), 3u) << "one a precision";
  EXPECT_TRUE(findingsOf(result)[0].expected);
  EXPECT_EQ(findingsOf(result)[0].reason, "for the test");

  function.expected = {nanBelow(0.125)};
  const std::vector<Finding> beyond = unexpectedOf(run(function, failing));
  ASSERT_EQ(beyond.size(), 1u);
  EXPECT_EQ(beyond[0].fault, "not finite");
}

TEST(Finder, AKnownFailureThatVanishedIsAFinding) {
  FunctionCase function = makePlanted();
  function.expect(nanBelow(0.25));
  const std::vector<Finding> found = unexpectedOf(run(function, [](double r, double) { return r; }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].fault, "vanished: not finite");
  // And one of another kind does not stand in for it.
  EXPECT_EQ(unexpectedOf(run(function, [](double r, double) { return r - 0.1; })).size(), 2u);
}

TEST(Finder, AWitnessIsTriedHoweverFewPointsThereAre) {
  FunctionCase function = makePlanted();
  Expectation expectation = nanBelow(0.25);
  expectation.witness[0] = 0.15625; // exact in half; no special value
  function.expect(expectation);
  EXPECT_EQ(unexpectedOf(run(
                             function, [](double r, double) { return r == 0.15625 ? kNan64 : r; }, 0))
                .size(),
            0u);
}

TEST(Finder, OutsideOfTheDomainOnlyAContractFails) {
  FunctionCase function = makePlanted();
  const auto strict = [](double r, double c) { return r > 1 || r < 0 ? kNan64 : c * r + 1; };
  const FunctionResult result = run(function, strict);
  EXPECT_TRUE(unexpectedOf(result).empty());
  EXPECT_GT(result.columns[2].tally.outsideNotFinite, 0u) << "but it is counted";
  function.promises(Contract::forNumbers);
  const std::vector<Finding> found = unexpectedOf(run(function, strict));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].fault, "contract broken");
}

TEST(Finder, TheErrorIsRelativeToTheReferenceOrItsScale) {
  // Off by 1e-3 everywhere but in fp64; relative to max(value, 1).
  FunctionCase function = makePlanted();
  function.gives(1).relativeTo(1);
  const FunctionResult result = stressOnCpu(function, 5000, [](Precision precision, const Row& row) {
    return Result{row[0] + (precision == Precision::f64 ? 0 : 1e-3)};
  });
  EXPECT_NEAR(result.columns[1].tally.worstError->value, 1e-3, 1e-6);
  EXPECT_NEAR(result.columns[1].tally.errors.percentile(0.999), 1e-3, 0.05e-3);
  EXPECT_EQ(result.columns[0].tally.errors.percentile(0.999), 0);
}

TEST(Finder, ThePercentileIsThatOfTheErrorsThatWereCounted) {
  ErrorHistogram histogram;
  for (int i = 0; i < 990; ++i) histogram.add(0);
  for (int i = 0; i < 9; ++i) histogram.add(1e-3);
  histogram.add(1);
  EXPECT_EQ(histogram.percentile(0.5), 0);
  EXPECT_NEAR(histogram.percentile(0.995), 1e-3, 0.05e-3);
  EXPECT_NEAR(histogram.percentile(0.9999), 1, 0.05);
}

TEST(Finder, ResultsDoNotDependOnTheNumberOfThreads) {
  const auto runWith = [](int threads) {
    const base::ThreadLimit limit(threads);
    Report report;
    for (const char* name : {"EnvBRDFApprox", "mobileIntegrateBxDF", "V_SmithGGXCorrelated"})
      report.functions.push_back(
          stressFunction(functionsNamed(name).front(), {.points = 40'000, .devicePoints = 0}, nullptr));
    for (const FunctionResult& result : report.functions)
      for (const Finding& finding : findingsOf(result)) report.findings.push_back(finding);
    return formatJson(report);
  };
  EXPECT_EQ(runWith(1), runWith(3));
}

} // namespace
} // namespace parity::tests

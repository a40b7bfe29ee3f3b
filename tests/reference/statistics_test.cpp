// The noise: unbiased between seeds, as large as it says, and falling faster than that of random points.
#include <gtest/gtest.h>

#include <algorithm>

#include "reference/environment_integral.h"
#include "reference/surroundings.h"

namespace parity::reference {
namespace {

// Points of all kinds, the same light.
class StatisticsTest : public testing::Test {
protected:
  StatisticsTest() : m_sky(tests::makeSunnyPanorama()) {
    for (std::uint32_t i = 0; i < 240; ++i) {
      SurfaceSample sample = tests::makePoint(0.1 + 0.9 * (i % 16) / 16, 0.1f + 0.9f * (i % 15) / 15.f, (i % 3) * 0.5f);
      sample.baseColor = {0.8f, 0.6f, 0.4f};
      sample.pixel = i;
      m_samples.push_back(sample);
    }
  }
  Integral integrate(const SurfaceSample& sample, int count, std::uint32_t seed) const {
    return integrateEnvironment(sample, Lobes(sample, tests::plainModel(), sample.roughness, nullptr), m_sky,
                                glm::dvec3(0),
                                {.relativeError = 0, .minSamples = count, .maxSamples = count, .seed = seed});
  }
  static double green(const Integral& integral) { return integral.diffuse.y + integral.specular.y; }

  const EnvironmentSampler m_sky;
  std::vector<SurfaceSample> m_samples;
};

// Student's t with n degrees of freedom, two-sided: P(|T| > t), by Simpson's rule over the density.
double tailOfStudent(double t, int n) {
  const double scale = std::exp(std::lgamma(0.5 * (n + 1)) - std::lgamma(0.5 * n)) / std::sqrt(n * std::numbers::pi);
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = std::abs(t) * i / kSteps, weight = i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2;
    sum += weight * scale * std::pow(1 + x * x / n, -0.5 * (n + 1));
  }
  return 1 - 2 * sum * std::abs(t) / kSteps / 3;
}

TEST(Student, TailIsThatOfTheTables) {
  // Abramowitz and Stegun, table 26.10: t of 30 degrees beyond 2.042 and 2.750.
  EXPECT_NEAR(tailOfStudent(2.042, 30), 0.05, 1e-4);
  EXPECT_NEAR(tailOfStudent(2.750, 30), 0.01, 1e-4);
}

// Two seeds differ by no more than their errors say: Welch's t at every point, Holm's correction over all points (its
// first step is Bonferroni's) at 1 %. Each error has 15 degrees of freedom, their sum 15 to 30: the fewest are taken.
TEST_F(StatisticsTest, SeedsAgreeWithinTheirErrorsAtEveryPoint) {
  std::vector<double> tails;
  double squares = 0;
  for (const SurfaceSample& sample : m_samples) {
    const Integral a = integrate(sample, 1024, 1), b = integrate(sample, 1024, 2);
    const double z = (green(a) - green(b)) / std::hypot(a.standardError.y, b.standardError.y);
    ASSERT_NE(z, 0) << "seeds must differ";
    tails.push_back(tailOfStudent(z, kReplicates - 1));
    squares += z * z;
  }
  std::sort(tails.begin(), tails.end());
  for (std::size_t i = 0; i < tails.size(); ++i)
    EXPECT_GT(tails[i], 0.01 / static_cast<double>(tails.size() - i)) << "rank " << i;
  // The errors are neither too small nor too large: z^2 of 30 degrees averages 1.07; over 240 points +- 0.1.
  const double mean = squares / static_cast<double>(tails.size());
  EXPECT_TRUE(mean > 0.7 && mean < 1.5) << mean;
}

// Stopping when the estimated error looks small enough picks, now and then, an estimate that is luckier than it should
// be. All in all the error is what was asked for, and nothing is biased: 1 % wanted; 60 points, so 3 sigma of the mean
// of errors of 1 % is 0.4 %.
TEST_F(StatisticsTest, StoppingEarlyNeitherBiasesNorUnderstatesTheError) {
  double squares = 0, sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < m_samples.size(); i += 4, ++count) {
    const Lobes lobes(m_samples[i], tests::plainModel(), m_samples[i].roughness, nullptr);
    const Integral result =
        integrateEnvironment(m_samples[i], lobes, m_sky, glm::dvec3(0), {.relativeError = 0.01, .seed = 4});
    const double relative = green(result) / green(integrate(m_samples[i], 1 << 15, 9)) - 1;
    squares += relative * relative;
    sum += relative;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.01);
  EXPECT_LT(std::abs(sum / count), 0.004);
}

TEST_F(StatisticsTest, ErrorFallsFasterThanThatOfRandomPoints) {
  std::vector<double> truth;
  for (std::size_t i = 0; i < m_samples.size(); i += 4) truth.push_back(green(integrate(m_samples[i], 1 << 16, 9)));
  std::vector<double> errors;
  const std::vector<int> counts = {64, 256, 1024, 4096};
  for (const int count : counts) {
    double squares = 0;
    for (std::size_t i = 0; i < m_samples.size(); i += 4) {
      const double relative = green(integrate(m_samples[i], count, 3)) / truth[i / 4] - 1;
      squares += relative * relative;
    }
    errors.push_back(std::sqrt(squares / static_cast<double>(truth.size())));
  }
  const double rate = std::log(errors.back() / errors.front()) / std::log(double(counts.back()) / counts.front());
  RecordProperty("rate", std::to_string(rate));
  std::printf("relative RMSE at 64, 256, 1024, 4096 samples: %.2e %.2e %.2e %.2e; rate %.2f\n", errors[0], errors[1],
              errors[2], errors[3], rate);
  EXPECT_LT(rate, -0.6); // random points: -0.5
  EXPECT_LT(errors[1], 6e-3);
}

} // namespace
} // namespace parity::reference

#include "compare/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "compare/region_list.h"

namespace parity::compare {
namespace {

std::string shapeOf(const base::Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(image.channels);
}

bool allFinite(const float* values, int count) {
  return std::all_of(values, values + count, [](float v) { return std::isfinite(v); });
}

// Whether all of a pixel's figures are finite: x * 0 is 0 for no other x. Quicker than seven tests.
bool isMeasurable(const float* a, const float* b, float error) {
  return a[0] * 0.f + a[1] * 0.f + a[2] * 0.f + b[0] * 0.f + b[1] * 0.f + b[2] * 0.f + error * 0.f == 0.f;
}

// Rec.709 luma of display-encoded RGB.
double lumaOf(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

double squaredDifference(const float* a, const float* b, int channels) {
  double sum = 0;
  for (int c = 0; c < channels; ++c) {
    const double d = static_cast<double>(a[c]) - static_cast<double>(b[c]);
    sum += d * d;
  }
  return sum;
}

} // namespace

NonFinite countNonFinite(const base::Image& image) {
  NonFinite found;
  for (int y = 0; y < image.height; ++y) {
    const float* row = image.at(0, y);
    const int values = image.width * image.channels;
    // x * 0 is 0 unless x is not finite: one sum per row says whether any is.
    float sum = 0;
    for (int i = 0; i < values; ++i) sum += row[i] * 0.f;
    if (sum == 0.f) continue;
    for (int x = 0; x < image.width; ++x) {
      if (allFinite(image.at(x, y), image.channels)) continue;
      if (found.count++ == 0) found.x = x, found.y = y;
    }
  }
  return found;
}

void requireFinite(const base::Image& image, const char* name) {
  const NonFinite found = countNonFinite(image);
  if (found.count == 0) return;
  throw base::Error(base::ExitCode::failed, name, "x " + std::to_string(found.x) + ", y " + std::to_string(found.y),
                    std::to_string(found.count) + (found.count == 1 ? " pixel is" : " pixels are") +
                        " NaN or infinite, this is the first");
}

void requireComparable(const base::Image& reference, const base::Image& test) {
  if (reference.empty() || test.empty())
    throw base::Error(base::ExitCode::notComparable, reference.empty() ? "reference" : "test", "",
                      "the image has no pixels");
  if (reference.width == test.width && reference.height == test.height && reference.channels == test.channels) return;
  throw base::Error(base::ExitCode::notComparable, "images", "",
                    "the reference is " + shapeOf(reference) + " (channels last), the test " + shapeOf(test));
}

Pooling poolMap(const base::Image& map) {
  if (map.channels != 1 || map.empty())
    throw base::Error(base::ExitCode::failed, "map", "", "is " + shapeOf(map) + ", not of 1 channel");
  requireFinite(map, "map");
  Pooling out;
  const auto [low, high] = std::minmax_element(map.pixels.begin(), map.pixels.end());
  out.min = static_cast<double>(*low);
  out.max = static_cast<double>(*high);
  double sum = 0;
  for (float v : map.pixels) sum += static_cast<double>(v);
  out.mean = sum / static_cast<double>(map.pixels.size());
  if (*high > 0) { // else all values, which are the weights too, are 0
    constexpr std::array<double, 3> kQuartiles = {0.25, 0.5, 0.75};
    const std::vector<float> found = weightedPercentiles(map.pixels, map.pixels, kQuartiles);
    out.weightedQ1 = static_cast<double>(found[0]);
    out.weightedMedian = static_cast<double>(found[1]);
    out.weightedQ3 = static_cast<double>(found[2]);
  }
  return out;
}

double psnrOfMse(double mse) { return mse > 0 ? -10 * std::log10(mse) : std::numeric_limits<double>::infinity(); }

double rmse(const base::Image& reference, const base::Image& test) {
  requireComparable(reference, test);
  requireFinite(reference, "reference");
  requireFinite(test, "test");
  double sum = 0;
  for (int y = 0; y < reference.height; ++y)
    sum += squaredDifference(reference.at(0, y), test.at(0, y), reference.width * reference.channels);
  return std::sqrt(sum / static_cast<double>(reference.pixels.size()));
}

double psnr(const base::Image& reference, const base::Image& test) {
  const double error = rmse(reference, test);
  return psnrOfMse(error * error);
}

Figures measure(const base::Image& referenceDisplay, const base::Image& testDisplay, const base::Image& flipMap,
                const base::PixelList& region) {
  requireComparable(referenceDisplay, testDisplay);
  if (referenceDisplay.channels != 3 || flipMap.channels != 1 || flipMap.width != referenceDisplay.width ||
      flipMap.height != referenceDisplay.height)
    throw base::Error(base::ExitCode::notComparable, "images", "",
                      "the displayed images are " + shapeOf(referenceDisplay) + " (3 channels needed), the map " +
                          shapeOf(flipMap));
  requireWellFormed(region, flipMap.pixelCount());

  Figures out;
  std::vector<float> errors, weights;
  errors.reserve(region.pixels.size());
  weights.reserve(region.weights.size());
  double total = 0, flipSum = 0, squareSum = 0, referenceSum = 0, testSum = 0;
  for (std::size_t i = 0; i < region.pixels.size(); ++i) {
    const float weight = region.weights.empty() ? 1.f : region.weights[i];
    if (weight == 0) continue;
    const std::size_t pixel = region.pixels[i];
    const float *a = &referenceDisplay.pixels[3 * pixel], *b = &testDisplay.pixels[3 * pixel];
    float error = flipMap.pixels[pixel];
    double square = 3, lumaA = 0, lumaB = 0;
    if (isMeasurable(a, b, error)) {
      square = squaredDifference(a, b, 3);
      lumaA = lumaOf(a);
      lumaB = lumaOf(b);
    } else {
      error = 1;
      ++out.nonFinite;
    }
    const double w = static_cast<double>(weight);
    ++out.pixels;
    total += w;
    flipSum += w * static_cast<double>(error);
    squareSum += w * square;
    referenceSum += w * lumaA;
    testSum += w * lumaB;
    errors.push_back(error);
    if (!region.weights.empty()) weights.push_back(weight);
  }
  if (out.pixels == 0) return out;

  constexpr std::array<double, 2> kFractions = {0.5, 0.95};
  const std::vector<float> found = weightedPercentiles(errors, weights, kFractions);
  out.flip.mean = flipSum / total;
  out.flip.p50 = static_cast<double>(found[0]);
  out.flip.p95 = static_cast<double>(found[1]);
  out.flip.max = static_cast<double>(*std::max_element(errors.begin(), errors.end()));
  const double mse = squareSum / (3 * total);
  out.rmse = std::sqrt(mse);
  out.psnr = psnrOfMse(mse);
  out.referenceLuma = referenceSum / total;
  out.testLuma = testSum / total;
  return out;
}

} // namespace parity::compare

#include "compare/metrics/measure_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/parallel.h"
#include "compare/metrics/measure.h"
#include "compare/pooling/pooling.h"
#include "compare/verdict/wording.h"

namespace parity::compare {
namespace {

constexpr double kEpsilon = 0.01; // of relMSE

const std::vector<std::string> kMetrics = {"flip", "relmse", "bias"}, kTermFigures = {"flip.mean", "relmse"};

Measurement measurePath(const TruthInput& input, const TruthPicture& path, const base::PixelList& list,
                        MeasureRequest request, const std::optional<Rect>& box) {
  std::vector<std::uint32_t> invalid(input.truth.nonFinite.begin(), input.truth.nonFinite.end());
  invalid.insert(invalid.end(), path.nonFinite.begin(), path.nonFinite.end());
  request.options.box = box;
  return measureRegions({input.truth.displayed, path.displayed, input.truth.linear, path.linear, invalid}, {list},
                        request);
}

// Both paths' figures of each material.
struct SwapFigures {
  std::vector<Figures> reference, test;
};
SwapFigures measurePaths(const TruthPicture& truth, std::span<const TruthSwap> swaps, const MeasureRequest& request) {
  const SwapReference reference{truth.displayed, truth.linear, truth.nonFinite};
  std::vector<Swap> ofReference, ofTest;
  for (const TruthSwap& swap : swaps) {
    ofReference.push_back(swap.reference);
    ofTest.push_back(swap.test);
  }
  return {measureSwaps(reference, ofReference, request).figures, measureSwaps(reference, ofTest, request).figures};
}

// Planes of what is known of the truth's error.
struct ErrorPlanes {
  base::Image relative; // 0 where it is not known
  base::Image relmse;
  base::Image unknown; // 1 where the error is not finite though the truth is
  base::Image over;    // 1 where it is above what was wanted
  base::Image broken;  // 1 where the truth is not finite
};

ErrorPlanes makePlanes(const TruthPicture& truth, const base::Image& error, double wanted) {
  const base::Image zero(error.width, error.height, 1);
  ErrorPlanes planes{error, zero, zero, zero, zero};
  for (const std::uint32_t pixel : truth.nonFinite) planes.broken.pixels[pixel] = 1;
  for (std::size_t p = 0; p < error.pixels.size(); ++p) {
    const float relative = error.pixels[p];
    if (planes.broken.pixels[p] > 0 || !std::isfinite(relative)) {
      planes.unknown.pixels[p] = 1 - planes.broken.pixels[p];
      planes.relative.pixels[p] = 0;
      continue;
    }
    planes.over.pixels[p] = relative > static_cast<float>(wanted) ? 1.f : 0.f;
    const float* rgb = truth.linear->pixels.data() + 3 * p;
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double r = double{rgb[c]}, s = double{relative} * r;
      sum += s * s / (r * r + kEpsilon);
    }
    planes.relmse.pixels[p] = static_cast<float>(sum / 3);
  }
  return planes;
}

// How many pixels of the region have 1 in the plane, whatever their weights.
std::uint64_t countSet(const base::Image& plane, const RegionRuns& region) {
  std::uint64_t count = 0;
  for (const Run& run : region.runs) {
    const auto begin = plane.pixels.begin() + run.first;
    count += static_cast<std::uint64_t>(std::count(begin, begin + run.count, 1.f));
  }
  return count;
}

TruthFigures describeError(const ErrorPlanes& planes, const base::Image& samples, const RegionRuns& region) {
  TruthFigures result;
  result.nonFinite = countSet(planes.broken, region);
  const Distribution errors = poolPlane(planes.relative, region, {.fractions = {0.5}, .thresholds = {}});
  result.error = {errors.percentiles[0], errors.max, meanOf(planes.relmse, region), meanOf(samples, region)};
  if (countSet(planes.unknown, region) + result.nonFinite > 0) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    result.error.median = result.error.worst = result.error.relmse = kNan;
  }
  return result;
}

void noteCloseness(std::vector<std::string>& notes, const std::string& path, const Figures& figures,
                   const TruthError& error) {
  if (isWithinNoise(figures, error))
    notes.push_back(fmt::format("{}: the difference to the truth, relMSE {}, is within {:.0f} standard errors of the "
                                "truth; the noise of the truth alone gives {}",
                                path, formatRelMse(figures.find("relmse").value_or(0)), kFewStandardErrors,
                                formatRelMse(error.relmse)));
}

std::vector<std::string> notesOf(const TruthFigures& figures, const ErrorPlanes& planes, const RegionRuns& region,
                                 const TruthMeasureRequest& request) {
  std::vector<std::string> notes;
  const std::uint64_t unknown = countSet(planes.unknown, region), over = countSet(planes.over, region);
  if (unknown > 0)
    notes.push_back(fmt::format("the error of the truth is unknown at {} of {} pixels", unknown, region.pixels));
  if (over > 0)
    notes.push_back(fmt::format("the truth did not reach a standard error of {:.3g} % at {} of {} pixels",
                                100 * request.wantedError, over, region.pixels));
  noteCloseness(notes, request.reference, figures.reference, figures.error);
  noteCloseness(notes, request.test, figures.test, figures.error);
  return notes;
}

Truth describeTruth(const ErrorPlanes& planes, const base::Image& samples, const RegionRuns& region,
                    Figures ofReference, Figures ofTest, const TruthMeasureRequest& request) {
  Truth truth;
  if (region.pixels == 0) return truth;
  truth.figures = describeError(planes, samples, region);
  truth.figures.reference = std::move(ofReference);
  truth.figures.test = std::move(ofTest);
  truth.notes = notesOf(truth.figures, planes, region, request);
  return truth;
}

} // namespace

TruthMeasurement measureTruth(const TruthInput& input, const TruthErrorMaps& maps, const base::PixelList& list,
                              const TruthMeasureRequest& request) {
  MeasureRequest wanted{.metrics = kMetrics};
  if (request.keepMaps) wanted.keepMaps = {"flip"};
  Measurement ofReference = measurePath(input, input.reference, list, wanted, request.box);
  Measurement ofTest = measurePath(input, input.test, list, wanted, request.box);
  const ErrorPlanes planes = makePlanes(input.truth, *maps.error, request.wantedError);
  TruthMeasurement out;
  out.truth = describeTruth(planes, *maps.samples, runsOf(list, maps.error->width, maps.error->height),
                            std::move(ofReference.regions[0]), std::move(ofTest.regions[0]), request);
  if (request.keepMaps) {
    out.referenceFlip = *ofReference.findMap("flip");
    out.testFlip = *ofTest.findMap("flip");
  }
  return out;
}

std::vector<Truth> measureTruthSwaps(const TruthPicture& truth, const TruthErrorMaps& maps,
                                     std::span<const TruthSwap> swaps, const TruthMeasureRequest& request) {
  SwapFigures figures = measurePaths(truth, swaps, {.metrics = kMetrics});
  const ErrorPlanes planes = makePlanes(truth, *maps.error, request.wantedError);
  std::vector<Truth> out(swaps.size());
  base::parallelFor(swaps.size(), 1, [&](std::size_t s, std::size_t) {
    out[s] =
        describeTruth(planes, *maps.samples, runsOf(*swaps[s].reference.list, maps.error->width, maps.error->height),
                      std::move(figures.reference[s]), std::move(figures.test[s]), request);
  });
  return out;
}

TruthTerm measureTerm(const std::string& name, const TruthInput& input, const base::PixelList& list,
                      const std::optional<Rect>& box) {
  const MeasureRequest wanted{.statistics = kTermFigures};
  return {name,
          0,
          0,
          0,
          measurePath(input, input.reference, list, wanted, box).regions[0],
          measurePath(input, input.test, list, wanted, box).regions[0]};
}

std::vector<TruthTerm> measureTermSwaps(const std::string& name, const TruthPicture& truth,
                                        std::span<const TruthSwap> swaps) {
  SwapFigures figures = measurePaths(truth, swaps, {.statistics = kTermFigures});
  std::vector<TruthTerm> terms;
  for (std::size_t s = 0; s < swaps.size(); ++s)
    terms.push_back({name, 0, 0, 0, std::move(figures.reference[s]), std::move(figures.test[s])});
  return terms;
}

double meanLuminance(const base::Image& linear, const base::PixelList& list) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < list.pixels.size(); ++i) {
    const float* p = linear.pixels.data() + std::size_t{list.pixels[i]} * 3;
    const double weight = list.weights.empty() ? 1 : list.weights[i];
    sum += weight * (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
    total += weight;
  }
  return sum / total;
}

bool isBlack(const base::Image& linear, const base::PixelList& list) {
  return std::all_of(list.pixels.begin(), list.pixels.end(), [&](std::uint32_t pixel) {
    const float* rgb = linear.pixels.data() + std::size_t{pixel} * 3;
    return rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0;
  });
}

} // namespace parity::compare

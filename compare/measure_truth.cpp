#include "compare/measure_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "compare/flip.h"
#include "compare/measure.h"
#include "compare/pooling.h"
#include "compare/wording.h"

namespace parity::compare {
namespace {

constexpr double kEpsilon = 0.01; // of relMSE

Measurement measurePath(const TruthInput& input, const TruthPicture& path, const std::vector<base::PixelList>& lists,
                        MeasureRequest request, const std::optional<Rect>& box) {
  std::vector<std::uint32_t> invalid(input.truth.nonFinite.begin(), input.truth.nonFinite.end());
  invalid.insert(invalid.end(), path.nonFinite.begin(), path.nonFinite.end());
  request.options.box = box;
  return measureRegions({input.truth.displayed, path.displayed, input.truth.linear, path.linear, invalid}, lists,
                        request);
}

// Planes of what is known of the truth's error.
struct ErrorPlanes {
  base::Image relative; // 0 where it is not known
  base::Image relmse;
  base::Image unknown; // 1 where the error is not finite though the truth is
  base::Image over;    // 1 where it is above what was wanted
  base::Image broken;  // 1 where the truth is not finite
};

ErrorPlanes makePlanes(const TruthInput& input, const base::Image& error, double wanted) {
  const base::Image zero(error.width, error.height, 1);
  ErrorPlanes planes{error, zero, zero, zero, zero};
  for (const std::uint32_t pixel : input.truth.nonFinite) planes.broken.pixels[pixel] = 1;
  for (std::size_t p = 0; p < error.pixels.size(); ++p) {
    const float relative = error.pixels[p];
    if (planes.broken.pixels[p] > 0 || !std::isfinite(relative)) {
      planes.unknown.pixels[p] = 1 - planes.broken.pixels[p];
      planes.relative.pixels[p] = 0;
      continue;
    }
    planes.over.pixels[p] = relative > static_cast<float>(wanted) ? 1.f : 0.f;
    const float* rgb = input.truth.linear->pixels.data() + 3 * p;
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

TruthRegion describeError(const ErrorPlanes& planes, const base::Image& samples, const RegionRuns& region) {
  TruthRegion result;
  if (region.pixels == 0) return result;
  result.nonFinite = countSet(planes.broken, region);
  const Distribution errors = poolPlane(planes.relative, region, {.fractions = {0.5}, .thresholds = {}});
  result.error = {errors.percentiles[0], errors.max, meanOf(planes.relmse, region), meanOf(samples, region)};
  if (countSet(planes.unknown, region) + result.nonFinite > 0) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    result.error.median = result.error.worst = result.error.relmse = kNan;
  }
  return result;
}

void noteCloseness(std::vector<std::string>& notes, const char* path, const Figures& figures, const TruthError& error) {
  if (isWithinNoise(figures, error))
    notes.push_back(fmt::format("{}: the difference to the truth, relMSE {}, is within {:.0f} standard errors of the "
                                "truth, whose noise alone gives {}",
                                path, formatRelMse(figures.find("relmse").value_or(0)), kFewStandardErrors,
                                formatRelMse(error.relmse)));
}

// main: the region by which the figures are read.
std::vector<std::string> notesOf(const TruthRegion& main, const ErrorPlanes& planes, const RegionRuns& all,
                                 double wanted) {
  std::vector<std::string> notes;
  const std::uint64_t unknown = countSet(planes.unknown, all), over = countSet(planes.over, all);
  if (unknown > 0)
    notes.push_back(fmt::format("the truth's error is not known at {} of {} pixels", unknown, all.pixels));
  if (over > 0)
    notes.push_back(fmt::format("the truth did not reach a standard error of {:.3g} % at {} of {} pixels", 100 * wanted,
                                over, all.pixels));
  noteCloseness(notes, "high-end", main.highend, main.error);
  noteCloseness(notes, "mobile", main.mobile, main.error);
  return notes;
}

} // namespace

TruthMeasurement measureTruth(const TruthInput& input, const TruthErrorMaps& maps,
                              const std::vector<base::PixelList>& lists, const TruthMeasureRequest& request) {
  MeasureRequest wanted{.metrics = {"flip", "relmse", "bias"}};
  if (request.keepMaps) wanted.keepMaps = {"flip"};
  const Measurement highend = measurePath(input, input.highend, lists, wanted, request.box);
  const Measurement mobile = measurePath(input, input.mobile, lists, wanted, request.box);
  const ErrorPlanes planes = makePlanes(input, *maps.error, request.wantedError);
  const int radius = flipFilterRadius({.ppd = wanted.options.ppd});

  TruthMeasurement out;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const int width = input.truth.displayed.width, height = input.truth.displayed.height;
    const RegionRuns all = runsOf(lists[i], width, height), interior = erodeRuns(all, width, height, radius);
    Truth truth;
    truth.all = describeError(planes, *maps.samples, all);
    truth.interior = describeError(planes, *maps.samples, interior);
    truth.all.highend = highend.regions[i].all;
    truth.all.mobile = mobile.regions[i].all;
    truth.interior.highend = highend.regions[i].interior;
    truth.interior.mobile = mobile.regions[i].interior;
    if (all.pixels > 0) truth.notes = notesOf(i == 0 ? truth.all : mainRegion(truth), planes, all, request.wantedError);
    out.regions.push_back(std::move(truth));
  }
  if (request.keepMaps) {
    out.highendFlip = *highend.findMap("flip");
    out.mobileFlip = *mobile.findMap("flip");
  }
  return out;
}

std::vector<TruthTerm> measureTerm(const std::string& name, const TruthInput& input,
                                   const std::vector<base::PixelList>& lists, const TruthMeasureRequest& request) {
  const MeasureRequest wanted{.statistics = {"flip.mean", "relmse"}};
  const Measurement highend = measurePath(input, input.highend, lists, wanted, request.box);
  const Measurement mobile = measurePath(input, input.mobile, lists, wanted, request.box);
  std::vector<TruthTerm> terms;
  for (std::size_t i = 0; i < lists.size(); ++i)
    terms.push_back({name, 0, 0, 0, highend.regions[i], mobile.regions[i]});
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

#include "compare/flip/flip_hdr.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numeric>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/raw_vector.h"
#include "compare/flip/flip_run.h"

namespace parity::compare {
namespace {

constexpr double kTarget = 0.85; // what the ends of the range are exposed to

// k0..k5 of (k0 x^2 + k1 x + k2)/(k3 x^2 + k4 x + k5): docs/flip-metric.md 6b. ACES after K. Narkowicz 2016, Hable
// 2010.
constexpr float kAces[6] = {0.9036f, 0.018f, 0, 0.8748f, 0.354f, 0.14f};
constexpr float kHable[6] = {0.231683f, 0.013791f, 0, 0.18f, 0.3f, 0.018f};

// Of the positive luminances; median = sorted[N/2].
struct Luminances {
  float max = 0, median = 0; // 0: there is none
};

// Positive floats of a bucket share their exponent and the first four bits behind the point: buckets are in the order
// of the values.
constexpr int kBucketShift = 19;
constexpr std::size_t kLuminanceBuckets = std::size_t{1} << (31 - kBucketShift);
std::size_t bucketOf(float value) { return std::bit_cast<std::uint32_t>(value) >> kBucketShift; }
// A denormal one would be exposed by more than a float can hold.
bool isCounted(float luminance) { return luminance >= std::numeric_limits<float>::min(); }

Luminances measureLuminances(const PixelView& image) {
  base::RawVector<float> values(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::array<std::size_t, kLuminanceBuckets> counts{};
  std::mutex mutex;
  Luminances found;
  base::parallelFor(static_cast<std::size_t>(image.height), 64, [&](std::size_t begin, std::size_t end) {
    std::array<std::size_t, kLuminanceBuckets> own{};
    float most = 0;
    for (std::size_t y = begin; y < end; ++y) {
      const float* row = image.floats + static_cast<std::ptrdiff_t>(y) * image.stride;
      float* out = values.data() + y * static_cast<std::size_t>(image.width);
      for (int x = 0; x < image.width; ++x) {
        const float* c = row + static_cast<std::ptrdiff_t>(x) * image.channels;
        out[x] = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
        if (!isCounted(out[x])) continue;
        ++own[bucketOf(out[x])];
        most = std::max(most, out[x]);
      }
    }
    const std::lock_guard lock(mutex);
    found.max = std::max(found.max, most);
    for (std::size_t i = 0; i < kLuminanceBuckets; ++i) counts[i] += own[i];
  });
  const std::size_t count = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  if (count == 0) return {};
  // The bucket of the median, and its place in it.
  std::size_t bucket = 0, place = count / 2;
  for (; place >= counts[bucket]; ++bucket) place -= counts[bucket];
  std::vector<float> near;
  near.reserve(counts[bucket]);
  for (const float value : values)
    if (isCounted(value) && bucketOf(value) == bucket) near.push_back(value);
  const auto median = near.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(near.begin(), median, near.end());
  found.median = *median;
  return found;
}

bool areEqual(const PixelView& a, const PixelView& b) {
  const Rect whole = {0, 0, a.width, a.height};
  return !DifferenceMap(a, b, whole).differs(0, 0, a.width, a.height);
}

[[noreturn]] void refuse(const char* option, const std::string& value, const std::string& reason) {
  throw base::Error(base::ExitCode::usage, option, value, reason);
}

void requireUsable(const HdrFlipOptions& options) {
  requireUsablePpd(options.ppd);
  for (const std::optional<float>& end : {options.start, options.stop})
    if (end && !(std::fabs(*end) <= kMaxExposureEv))
      refuse("exposure", std::to_string(*end), "is not a number of EV from -127 to 127");
  if (options.exposures && (*options.exposures < 2 || *options.exposures > kMaxExposures))
    refuse("exposures", std::to_string(*options.exposures), "must be from 2 to " + std::to_string(kMaxExposures));
}

void requireFloats(const PixelView& reference, const PixelView& test) {
  requireComparableViews(reference, test);
  if (!reference.floats)
    throw base::Error(base::ExitCode::notComparable, "HDR-FLIP", "", "needs linear floats, not bytes");
}

// Of the i-th of the range's exposures.
float gainOf(const ExposureRange& range, int i) {
  const float step = (range.stop - range.start) / static_cast<float>(range.count - 1);
  return std::exp2(range.start + step * static_cast<float>(i));
}

bool hasLight(const PixelView& image) { return measureLuminances(image).max > 0; }

// One tile at every exposure; the input stays in the cache meanwhile.
std::uint64_t runTile(TileWorkspace& workspace, const TileJob& job, RowDecoder decoder, const ExposureRange& range,
                      const Rect& tile, HdrFlip& out) {
  std::vector<float> ldr(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height), 0.f);
  std::uint64_t filtered = 0;
  for (int i = 0; i < range.count; ++i) {
    decoder.exposure = gainOf(range, i);
    filtered = workspace.run(job, decoder, tile, {ldr.data(), nullptr, nullptr, tile.width});
    if (filtered == 0) break; // nothing differs, at no exposure
    const float mark = static_cast<float>(i) / static_cast<float>(range.count - 1);
    for (int y = 0; y < tile.height; ++y)
      keepLargest(ldr.data() + static_cast<std::ptrdiff_t>(y) * tile.width, tile.width, mark,
                  out.flip.at(tile.x, tile.y + y), out.exposure.at(tile.x, tile.y + y));
  }
  return filtered;
}

} // namespace

RowDecoder makeRowDecoder(Tonemapper tonemapper) {
  RowDecoder decoder;
  decoder.decoding = tonemapper == Tonemapper::reinhard ? Decoding::reinhard : Decoding::rational;
  std::copy_n(tonemapper == Tonemapper::hable ? kHable : kAces, 6, decoder.coefficients);
  return decoder;
}

double brightestExposed(Tonemapper tonemapper) {
  if (tonemapper == Tonemapper::reinhard) return kTarget / (1 - kTarget);
  const float* k = tonemapper == Tonemapper::hable ? kHable : kAces;
  const auto coefficient = [&](int i) { return static_cast<double>(k[i]) - kTarget * static_cast<double>(k[i + 3]); };
  const double a = coefficient(0), b = coefficient(1), c = coefficient(2);
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

ExposureRange exposureRange(const PixelView& reference, const PixelView& test, const HdrFlipOptions& options) {
  requireUsable(options);
  requireFloats(reference, test);
  ExposureRange range;
  if (!options.start || !options.stop) {
    const Rect whole = {0, 0, reference.width, reference.height};
    requireFinite(reference, whole, "reference");
    Luminances found = measureLuminances(reference);
    if (!(found.max > 0)) {
      requireFinite(test, whole, "test");
      found = measureLuminances(test);
      range.note = "the reference is black, so the exposures come from the test";
    }
    if (found.max > 0) {
      const double brightest = brightestExposed(options.tonemapper);
      const auto exposureFor = [&](float luminance) {
        const double ev = std::log2(brightest / static_cast<double>(luminance));
        return static_cast<float>(std::clamp<double>(ev, -kMaxExposureEv, kMaxExposureEv));
      };
      range.start = exposureFor(found.max);
      range.stop = exposureFor(found.median);
    } else {
      if (!areEqual(reference, test))
        throw base::Error(
            base::ExitCode::notComparable, "HDR-FLIP", "",
            "the images differ, but none has a positive luminance; give --start-exposure and --stop-exposure");
      range.start = -1, range.stop = 1;
      range.note = "both images are black";
    }
  }
  range.start = options.start.value_or(range.start);
  range.stop = options.stop.value_or(range.stop);
  if (range.start > range.stop)
    refuse("exposures", std::to_string(range.start) + " to " + std::to_string(range.stop),
           "the first exposure is above the last");
  const double stops = std::ceil(static_cast<double>(range.stop) - static_cast<double>(range.start));
  range.count = options.exposures.value_or(static_cast<int>(std::clamp(stops, 2., double{kMaxExposures})));
  if (!options.exposures && stops > kMaxExposures)
    range.note += (range.note.empty() ? "" : "; ") + std::to_string(static_cast<int>(stops)) + " EV are sampled at " +
                  std::to_string(kMaxExposures) + " exposures";
  return range;
}

HdrFlip flipHdr(const PixelView& reference, const PixelView& test, const HdrFlipOptions& options) {
  requireUsable(options);
  requireFloats(reference, test);
  const Rect region = regionOf(reference, options.region);
  const FlipFilters filters = makeFlipFilters(options.ppd);
  // First what is not finite anywhere it matters, then the exposures.
  const DifferenceMap differences(reference, test, withMargin(region, filters.radius, reference));
  HdrFlip out;
  out.range = exposureRange(reference, test, options);
  out.flip = base::Image(reference.width, reference.height, 1);
  out.exposure = base::Image(reference.width, reference.height, 1);
  const TileJob job = {reference, test, &filters, &differences};
  const RowDecoder decoder = makeRowDecoder(options.tonemapper);
  forEachTile(region, filters, [&](TileWorkspace& workspace, const Rect& tile) {
    return runTile(workspace, job, decoder, out.range, tile, out);
  });
  return out;
}

std::vector<std::vector<float>> flipHdrSwaps(const PixelView& reference, std::span<const FlipSwap> swaps,
                                             const HdrFlipOptions& options) {
  requireUsable(options);
  requireFloats(reference, reference);
  std::vector<std::vector<float>> largest(swaps.size());
  const auto measure = [&](std::size_t first, std::size_t count, const ExposureRange& range) {
    RowDecoder decoder = makeRowDecoder(options.tonemapper);
    for (std::size_t s = first; s < first + count; ++s) largest[s].assign(swaps[s].pixels.size(), 0.f);
    for (int i = 0; i < range.count; ++i) {
      decoder.exposure = gainOf(range, i);
      const std::vector<std::vector<float>> values =
          flipSwaps(reference, swaps.subspan(first, count), options.ppd, decoder);
      for (std::size_t s = 0; s < count; ++s)
        std::ranges::transform(values[s], largest[first + s], largest[first + s].begin(),
                               [](float a, float b) { return std::max(a, b); });
    }
  };
  if (hasLight(reference) || (options.start && options.stop)) {
    measure(0, swaps.size(), exposureRange(reference, reference, options));
    return largest;
  }
  for (std::size_t s = 0; s < swaps.size(); ++s) {
    if (swaps[s].pixels.empty()) continue;
    const base::Image black(swaps[s].colors.width, swaps[s].colors.height, swaps[s].colors.channels);
    measure(s, 1, exposureRange(black, swaps[s].colors, options));
  }
  return largest;
}

} // namespace parity::compare

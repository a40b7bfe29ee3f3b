#include "compare/images/flip_files.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/file.h"
#include "base/image/image_io.h"
#include "base/text/text.h"
#include "compare/flip/magma.h"
#include "compare/images/histogram_svg.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {

namespace {

namespace fs = std::filesystem;

constexpr const char* kHistogramEnding = ".flip.svg";

// Of one pair the file itself; of many a file in the folder, named by the pair.
fs::path fileFor(const FlipRequest& request, const fs::path& output, const FilePair& pair, const std::string& ending) {
  if (!request.files.many) return output;
  fs::path file = output / pair.name;
  file += ending;
  return file;
}

void writeMap(const fs::path& file, const base::Image& map, FlipPair& result) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".png")
    base::writeImage8(file, magmaImage(map));
  else
    base::writeImage(file, map);
  result.written.push_back(file);
}

// The map's values over all regions, with their weights.
struct Values {
  std::vector<float> values, weights;
};

Values gather(const FlipImages& images) {
  Values all;
  for (const base::PixelList& region : images.regions)
    for (std::size_t i = 0; i < region.pixels.size(); ++i) {
      all.values.push_back(images.flip.pixels[region.pixels[i]]);
      all.weights.push_back(region.weights.empty() ? 1.f : region.weights[i]);
    }
  return all;
}

std::string drawHistogram(const FlipImages& images, const FlipPair& pair) {
  constexpr std::size_t kBuckets = 100;
  const Values all = gather(images);
  std::array<double, kBuckets> buckets{};
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    const auto bucket = static_cast<std::size_t>(std::clamp(all.values[i], 0.f, 1.f) * kBuckets);
    buckets[std::min(bucket, kBuckets - 1)] += all.weights[i]; // the last one has 1, too
    sum += static_cast<double>(all.values[i]) * all.weights[i];
    total += all.weights[i];
  }
  const std::vector<float> percentiles = weightedPercentiles(all.values, all.weights, std::array{0.5, 0.95, 0.99});
  const char* flip = pair.hdr ? "HDR-FLIP" : "LDR-FLIP";
  HistogramPicture picture;
  picture.title = fmt::format("{} of {}", flip, base::plainLine(pair.files.name));
  picture.axis = fmt::format("{} error, {} buckets", flip, kBuckets);
  picture.buckets = buckets;
  picture.marks = {{"mean", sum / total}, {"p50", percentiles[0]}, {"p95", percentiles[1]}, {"p99", percentiles[2]}};
  return toSvg(picture);
}

} // namespace

std::vector<OutputFile> listFlipFiles(const FlipRequest& request) {
  const FlipOutputs& outputs = request.outputs;
  std::vector<OutputFile> files;
  for (const FilePair& pair : request.files.pairs) {
    const auto add = [&](const char* option, const fs::path& output, const std::string& ending) {
      if (!output.empty()) files.push_back({option, fileFor(request, output, pair, ending)});
    };
    add("--output", outputs.map, ".flip" + outputs.mapKind);
    add("--exposure-map", outputs.exposureMap, ".exposure" + outputs.mapKind);
    add("--histogram", outputs.histogram, kHistogramEnding);
  }
  return files;
}

void writeFlipFiles(const FlipRequest& request, const FlipImages& images, FlipPair& result) {
  const FlipOutputs& outputs = request.outputs;
  if (!outputs.map.empty())
    writeMap(fileFor(request, outputs.map, result.files, ".flip" + outputs.mapKind), images.flip, result);
  if (!outputs.exposureMap.empty() && images.exposure)
    writeMap(fileFor(request, outputs.exposureMap, result.files, ".exposure" + outputs.mapKind), *images.exposure,
             result);
  if (!outputs.histogram.empty()) {
    const fs::path file = fileFor(request, outputs.histogram, result.files, kHistogramEnding);
    base::writeText(file, drawHistogram(images, result));
    result.written.push_back(file);
  }
}

} // namespace parity::compare

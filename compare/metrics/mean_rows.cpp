#include "compare/metrics/mean_rows.h"

#include <algorithm>

#include "base/parallel.h"
#include "compare/metrics/color_rows.h"
#include "compare/pooling/pieces.h"
#include "compare/pooling/stretch.h"

namespace parity::compare {
namespace {

// Sets the pixels of a run that cannot be used.
void setWorst(const MeanRows& rows, const MetricInput& input, std::uint32_t first, std::uint32_t count,
              float* const* out) {
  const auto begin = std::lower_bound(input.nonFinite.begin(), input.nonFinite.end(), first);
  const auto end = std::lower_bound(begin, input.nonFinite.end(), first + count);
  for (auto pixel = begin; pixel != end; ++pixel)
    for (std::size_t k = 0; k < rows.worst.size(); ++k) out[k][*pixel - first] = rows.worst[k];
}

void makeRow(const MeanRows& rows, const MetricInput& input, RowSource& row, std::uint32_t first, float* const* out) {
  rows.make(row, out);
  setWorst(rows, input, first, static_cast<std::uint32_t>(row.count()), out);
}

// Buffers of one thread.
struct Workspace {
  RowSource row;
  std::vector<float> values;
  std::vector<float*> starts; // of each map's row in them

  void reserve(int count, std::size_t maps) {
    row.reserve(count);
    values.resize(std::max(values.size(), maps * static_cast<std::size_t>(count)));
    starts.clear();
    for (std::size_t k = 0; k < maps; ++k) starts.push_back(values.data() + k * static_cast<std::size_t>(count));
  }
};

struct Piece {
  std::size_t region = 0, first = 0, end = 0; // runs
};

std::vector<Piece> piecesOf(std::span<const RegionRuns> regions) {
  std::vector<Piece> pieces;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (std::size_t run = 0; run < regions[r].runs.size();) {
      const std::size_t end = endOfPiece(regions[r], run);
      pieces.push_back({r, run, end});
      run = end;
    }
  return pieces;
}

std::vector<double> sumPiece(std::span<const MeanRows* const> rows, const MetricInput& input, const RegionRuns& region,
                             const Piece& piece, std::size_t maps) {
  thread_local Workspace workspace; // its memory is not given back between pieces
  workspace.reserve(input.width(), maps);
  const auto width = static_cast<std::uint32_t>(input.width());
  std::vector<double> sums(maps);
  for (std::size_t i = piece.first; i < piece.end; ++i) {
    const Run& run = region.runs[i];
    workspace.row.set(input, static_cast<int>(run.first % width), static_cast<int>(run.first / width),
                      static_cast<int>(run.count));
    float** out = workspace.starts.data();
    for (const MeanRows* each : rows) {
      makeRow(*each, input, workspace.row, run.first, out);
      out += each->worst.size();
    }
    for (std::size_t k = 0; k < maps; ++k)
      sums[k] += sumOf(Stretch{workspace.starts[k], region.weightsOf(run), run.count});
  }
  return sums;
}

} // namespace

MeanMetric findMeanMetric(std::string_view name) {
  if (name == "rmse") return rmseOfMeans();
  if (name == "psnr") return psnrOfMeans();
  if (name == "bias") return biasOfMeans();
  return {};
}

std::vector<base::Image> mapsOf(const MeanRows& rows, const MetricInput& input, const Rect& box) {
  std::vector<base::Image> maps(rows.worst.size(), base::Image(input.width(), input.height(), 1));
  forRows(box, [&](int y) {
    RowSource row;
    row.reserve(box.width);
    row.set(input, box.x, y, box.width);
    std::vector<float*> out;
    for (base::Image& map : maps) out.push_back(map.at(box.x, y));
    makeRow(rows, input, row, static_cast<std::uint32_t>(y * input.width() + box.x), out.data());
  });
  // Outside of the box, too.
  for (std::size_t k = 0; k < maps.size(); ++k) setPixels(maps[k], input.nonFinite, rows.worst[k]);
  return maps;
}

std::vector<std::vector<double>> meansOf(std::span<const MeanRows* const> rows, const MetricInput& input,
                                         std::span<const RegionRuns> regions) {
  std::size_t maps = 0;
  for (const MeanRows* each : rows) maps += each->worst.size();
  const std::vector<Piece> pieces = piecesOf(regions);
  std::vector<std::vector<double>> sums(pieces.size()), means(regions.size());
  base::parallelFor(pieces.size(), 1, [&](std::size_t i, std::size_t) {
    sums[i] = sumPiece(rows, input, regions[pieces[i].region], pieces[i], maps);
  });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<double>& of = means[pieces[i].region];
    of.resize(maps);
    for (std::size_t k = 0; k < maps; ++k) of[k] += sums[i][k];
  }
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (double& mean : means[r]) mean /= regions[r].weight;
  return means;
}

} // namespace parity::compare

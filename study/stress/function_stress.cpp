#include "study/stress/function_stress.h"

#include <algorithm>
#include <mutex>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "study/stress/device_rows.h"

namespace parity::stress {

namespace {

constexpr std::size_t kCpuRows = 16384;         // a piece of work for one core
constexpr std::size_t kBatchRows = 256;         // of it at once, so that all stays in its cache
constexpr std::uint64_t kDeviceRows = 1u << 17; // a dispatch
constexpr std::uint64_t kPairEvery = 4;         // every fourth point is held against a claim

// The run's rows by number: the witnesses of what is expected, special values, then the points of the sequence.
class RowSource {
public:
  RowSource(const FunctionCase& function, std::uint32_t points)
      : m_function(function), m_grid(function.domain), m_witnesses(function.expected.size()),
        m_points(function.domain.inputs.empty() ? 0 : points) {}

  std::uint64_t size() const { return m_witnesses + m_grid.size() + m_points; }
  std::uint64_t points() const { return m_points; }

  Row row(std::uint64_t index) const {
    if (index < m_witnesses) return m_function.expected[index].witness;
    index -= m_witnesses;
    if (index < m_grid.size()) return m_grid.row(index);
    return samplePoint(m_function.domain, static_cast<std::uint32_t>(index - m_grid.size()));
  }

  // The claim that a row is held against together with a second one; null: none.
  const Claim* claimAt(std::uint64_t index) const {
    if (m_function.claims.empty()) return nullptr;
    if (index < m_witnesses + m_grid.size()) { // a witness of a claim's fault is held against each in turn
      return index < m_witnesses ? &m_function.claims[index % m_function.claims.size()] : nullptr;
    }
    index -= m_witnesses + m_grid.size();
    return index % kPairEvery == 0 ? &m_function.claims[index / kPairEvery % m_function.claims.size()] : nullptr;
  }

  Row partner(std::uint64_t index, const Claim& claim, const Row& row) const {
    const auto at = [&](int input) { return m_function.domain.inputs[static_cast<std::size_t>(input)].at; };
    if (claim.kind != Claim::Kind::symmetric)
      return movedPoint(m_function.domain, row, claim.input, static_cast<std::uint32_t>(index));
    Row swapped = row;
    std::swap(swapped[at(claim.input)], swapped[at(claim.other)]);
    return swapped;
  }

private:
  const FunctionCase& m_function;
  SpecialGrid m_grid;
  std::uint64_t m_witnesses, m_points;
};

// A range of rows, and behind them the second rows of claims.
struct Batch {
  struct Pair {
    const Claim* claim;
    std::size_t first, second;
  };
  std::uint64_t firstIndex = 0;
  std::size_t count = 0; // without the second rows
  std::vector<Row> rows;
  std::vector<Pair> pairs;
};

Batch makeBatch(const RowSource& source, std::uint64_t begin, std::uint64_t end) {
  Batch batch{.firstIndex = begin, .count = static_cast<std::size_t>(end - begin), .rows = {}, .pairs = {}};
  batch.rows.reserve(batch.count + batch.count / kPairEvery + 1);
  for (std::uint64_t i = begin; i < end; ++i) batch.rows.push_back(source.row(i));
  for (std::uint64_t i = begin; i < end; ++i)
    if (const Claim* claim = source.claimAt(i)) {
      const auto first = static_cast<std::size_t>(i - begin);
      batch.pairs.push_back({claim, first, batch.rows.size()});
      batch.rows.push_back(source.partner(i, *claim, batch.rows[first]));
    }
  return batch;
}

std::vector<Row> roundRows(Precision precision, const Domain& domain, const std::vector<Row>& rows) {
  std::vector<Row> rounded;
  rounded.reserve(rows.size());
  for (const Row& row : rows) rounded.push_back(roundTo(precision, domain, row));
  return rounded;
}

std::vector<Result> evaluateAll(Precision precision, const CpuFunction& evaluate, const std::vector<Row>& rows) {
  std::vector<Result> results;
  results.reserve(rows.size());
  for (const Row& row : rows) results.push_back(evaluate(precision, row));
  return results;
}

// cpu: null where these are the CPU's.
void countBatch(const FunctionCase& function, Precision precision, const Batch& batch, const std::vector<Row>& rows,
                const std::vector<Result>& results, const std::vector<Result>& references,
                const std::vector<Result>* cpu, Tally& tally) {
  for (std::size_t i = 0; i < batch.count; ++i)
    countRow(function, precision, batch.firstIndex + i, rows[i], results[i], references[i], cpu ? &(*cpu)[i] : nullptr,
             tally);
  for (const Batch::Pair& pair : batch.pairs)
    if (function.domain.contains(rows[pair.first]) && function.domain.contains(rows[pair.second]))
      countPair(function, precision, batch.firstIndex + pair.first, *pair.claim, rows[pair.first], results[pair.first],
                rows[pair.second], results[pair.second], tally);
}

Column makeColumn(const FunctionCase& function, Precision precision, bool onDevice) {
  return {.precision = precision, .onDevice = onDevice, .skipped = {}, .tally = Tally(function)};
}

// tallies: one for each of kPrecisions.
void countOnCpu(const FunctionCase& function, const CpuFunction& evaluate, const Batch& batch,
                std::vector<Tally>& tallies) {
  std::vector<Row> rows;
  std::vector<Result> references;
  for (const Precision precision : kPrecisions) {
    if (precision != Precision::f32) { // which has the rows of f64
      rows = roundRows(precision, function.domain, batch.rows);
      references = evaluateAll(Precision::f64, evaluate, rows);
    }
    Tally& tally = tallies[static_cast<std::size_t>(precision)];
    if (precision == Precision::f64)
      countBatch(function, precision, batch, rows, references, references, nullptr, tally);
    else
      countBatch(function, precision, batch, rows, evaluateAll(precision, evaluate, rows), references, nullptr, tally);
  }
}

std::vector<Column> columnsOnCpu(const FunctionCase& function, const RowSource& source, const CpuFunction& evaluate) {
  std::vector<Column> columns;
  for (const Precision precision : kPrecisions) columns.push_back(makeColumn(function, precision, false));
  std::mutex mutex;
  base::parallelFor(static_cast<std::size_t>(source.size()), kCpuRows, [&](std::size_t begin, std::size_t end) {
    std::vector<Tally> tallies(columns.size(), Tally(function));
    for (std::size_t first = begin; first < end; first += kBatchRows)
      countOnCpu(function, evaluate, makeBatch(source, first, std::min(first + kBatchRows, end)), tallies);
    // Sums and maxima, of equals the first row: in whatever order they come.
    std::lock_guard lock(mutex);
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].tally.merge(tallies[c]);
  });
  return columns;
}

Column stressOnDevice(const FunctionCase& function, const RowSource& source, const gpu::Device& device,
                      Precision precision) {
  Column column = makeColumn(function, precision, true);
  if (precision == Precision::f16 && !device.report().float16) {
    column.skipped = device.report().name + " has no shaderFloat16";
    return column;
  }
  const Evaluate evaluate = deviceEvaluator(device, function.id, precision);
  for (std::uint64_t begin = 0; begin < source.size(); begin += kDeviceRows) {
    const Batch batch = makeBatch(source, begin, std::min(begin + kDeviceRows, source.size()));
    const std::vector<Row> rows = roundRows(precision, function.domain, batch.rows);
    const std::vector<Result> results = evaluate(rows);
    std::vector<Result> cpu(rows.size()), references(rows.size());
    base::parallelFor(rows.size(), kCpuRows, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        cpu[i] = evaluateRounded(precision, function.id, rows[i]);
        references[i] = evaluate64(function.id, rows[i]);
      }
    });
    countBatch(function, precision, batch, rows, results, references, &cpu, column.tally);
  }
  return column;
}

} // namespace

std::string Column::name() const { return std::string(onDevice ? "device " : "cpu ") + nameOf(precision); }

Evaluate deviceEvaluator(const gpu::Device& device, int id, Precision precision) {
  const auto pipeline = std::make_shared<const DeviceRows>(device, functionShader(id, precision == Precision::f16), id);
  return [pipeline](const std::vector<Row>& rows) {
    std::vector<float> inputs;
    inputs.reserve(rows.size() * kInputs);
    for (const Row& row : rows)
      for (const double x : row) inputs.push_back(static_cast<float>(x));
    const std::vector<float> outputs = pipeline->run(inputs, static_cast<std::uint32_t>(rows.size()), kOutputs);
    std::vector<Result> results(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::copy_n(outputs.begin() + static_cast<std::ptrdiff_t>(i * kOutputs), kOutputs, results[i].begin());
    return results;
  };
}

FunctionResult stressOnCpu(const FunctionCase& function, std::uint32_t points, const CpuFunction& evaluate) {
  const base::Stopwatch watch(nullptr, "");
  FunctionResult result;
  result.function = function;
  const RowSource source(result.function, points);
  result.points = source.points();
  result.columns = columnsOnCpu(result.function, source, evaluate);
  result.timeMs = watch.elapsedMs();
  return result;
}

FunctionResult stressFunction(const FunctionCase& function, const FunctionOptions& options, const gpu::Device* device) {
  const base::Stopwatch watch(nullptr, "");
  FunctionResult result =
      stressOnCpu(function, options.points, [id = function.id](Precision precision, const Row& row) {
        return evaluateRounded(precision, id, row);
      });
  if (device && options.devicePoints > 0) {
    const RowSource onDevice(result.function, options.devicePoints);
    result.devicePoints = onDevice.points();
    for (const Precision precision : {Precision::f32, Precision::f16})
      result.columns.push_back(stressOnDevice(result.function, onDevice, *device, precision));
  }
  result.timeMs = watch.elapsedMs();
  return result;
}

} // namespace parity::stress

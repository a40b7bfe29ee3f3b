#include "study/stress/function_stress.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "study/stress/device_rows.h"

namespace parity::stress {

namespace {

constexpr std::uint64_t kRows = 16384;    // a piece of work for one core, and a dispatch
constexpr std::uint64_t kBatchRows = 256; // of it at once, so that all stays in the cache
constexpr std::uint64_t kPairEvery = 4;   // every fourth point is held against a claim

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

// One precision of a batch: the rows as it gets them, which of them are in the domain, the exact results there, and the
// CPU's.
struct Evaluated {
  std::vector<Row> rows;
  std::vector<char> inside;
  std::vector<Result> references, results;
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
  Evaluated single, half;

  // f64 has the rows of f32: its results are the references.
  const Evaluated& of(Precision precision) const { return precision == Precision::f16 ? half : single; }
};

Batch makeBatch(const RowSource& source, std::uint64_t begin, std::uint64_t end) {
  Batch batch;
  batch.firstIndex = begin;
  batch.count = static_cast<std::size_t>(end - begin);
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

Evaluated evaluateBatch(Precision precision, const FunctionCase& function, const CpuFunction& evaluate,
                        const std::vector<Row>& rows) {
  Evaluated evaluated{
      .rows = roundRows(precision, function.domain, rows), .inside = {}, .references = {}, .results = {}};
  for (const Row& row : evaluated.rows) evaluated.inside.push_back(function.domain.contains(row));
  evaluated.references = evaluateAll(Precision::f64, evaluate, evaluated.rows);
  evaluated.results = evaluateAll(precision, evaluate, evaluated.rows);
  return evaluated;
}

// results: of the batch's rows, from the first on. cpu: null where these are the CPU's.
void countBatch(const FunctionCase& function, Precision precision, const Batch& batch, std::span<const Result> results,
                const std::vector<Result>* cpu, Tally& tally) {
  const auto& [rows, inside, references, ofCpu] = batch.of(precision);
  for (std::size_t i = 0; i < batch.count; ++i)
    countRow(function, precision, batch.firstIndex + i, rows[i], inside[i] != 0, results[i], references[i],
             cpu ? &(*cpu)[i] : nullptr, tally);
  for (const Batch::Pair& pair : batch.pairs)
    if (inside[pair.first] && inside[pair.second])
      countPair(function, precision, batch.firstIndex + pair.first, *pair.claim, rows[pair.first], results[pair.first],
                rows[pair.second], results[pair.second], tally);
}

Column makeColumn(const FunctionCase& function, Precision precision, bool onDevice) {
  return {.precision = precision, .onDevice = onDevice, .skipped = {}, .tally = Tally(function)};
}

// The device's side of one function. Safe from several threads, which take turns.
class DeviceSide {
public:
  DeviceSide(const gpu::Device& device, int id) : m_device(device), m_id(id) {}

  // Of all rows of the batches, one batch after the other.
  std::vector<Result> evaluate(Precision precision, const std::vector<Batch>& batches) {
    std::vector<Row> rows;
    for (const Batch& batch : batches) {
      const std::vector<Row>& more = batch.of(precision).rows;
      rows.insert(rows.end(), more.begin(), more.end());
    }
    const std::lock_guard lock(m_mutex);
    Evaluate& evaluate = precision == Precision::f16 ? m_half : m_single;
    if (!evaluate) evaluate = deviceEvaluator(m_device, m_id, precision);
    return evaluate(rows);
  }

private:
  const gpu::Device& m_device;
  int m_id;
  std::mutex m_mutex;
  Evaluate m_single, m_half;
};

// Fills the columns of one function, piece by piece on all cores. The device sees the rows that the CPU sees, as far as
// both take them: what the CPU makes of them is computed once.
class ColumnCounter {
public:
  ColumnCounter(const FunctionCase& function, const CpuFunction& evaluate, DeviceSide* device,
                std::vector<Column>& columns)
      : m_function(function), m_evaluate(evaluate), m_device(device), m_columns(columns) {}

  // Rows begin..end-1, for the CPU's columns, the device's or both.
  void count(const RowSource& source, std::uint64_t begin, std::uint64_t end, bool onCpu, bool onDevice) {
    if (begin >= end) return;
    base::parallelFor(static_cast<std::size_t>(end - begin), kRows, [&](std::size_t first, std::size_t last) {
      const std::vector<Batch> batches = makeBatches(source, begin + first, begin + last);
      std::vector<Tally> tallies(m_columns.size(), Tally(m_function));
      for (std::size_t c = 0; c < m_columns.size(); ++c) {
        const Column& column = m_columns[c];
        if (!column.skipped.empty() || !(column.onDevice ? onDevice : onCpu)) continue;
        if (column.onDevice)
          countOnDevice(batches, column.precision, tallies[c]);
        else
          countOnCpu(batches, column.precision, tallies[c]);
      }
      // Sums and maxima, of equals the first row: in whatever order they come.
      const std::lock_guard lock(m_mutex);
      for (std::size_t c = 0; c < m_columns.size(); ++c) m_columns[c].tally.merge(tallies[c]);
    });
  }

private:
  std::vector<Batch> makeBatches(const RowSource& source, std::uint64_t begin, std::uint64_t end) const {
    std::vector<Batch> batches;
    for (std::uint64_t first = begin; first < end; first += kBatchRows) {
      Batch& batch = batches.emplace_back(makeBatch(source, first, std::min(first + kBatchRows, end)));
      batch.single = evaluateBatch(Precision::f32, m_function, m_evaluate, batch.rows);
      batch.half = evaluateBatch(Precision::f16, m_function, m_evaluate, batch.rows);
      batch.rows = {};
    }
    return batches;
  }

  void countOnCpu(const std::vector<Batch>& batches, Precision precision, Tally& tally) const {
    for (const Batch& batch : batches) {
      const Evaluated& evaluated = batch.of(precision);
      countBatch(m_function, precision, batch, precision == Precision::f64 ? evaluated.references : evaluated.results,
                 nullptr, tally);
    }
  }

  void countOnDevice(const std::vector<Batch>& batches, Precision precision, Tally& tally) const {
    const std::vector<Result> results = m_device->evaluate(precision, batches);
    std::span<const Result> left(results);
    for (const Batch& batch : batches) {
      const Evaluated& evaluated = batch.of(precision);
      countBatch(m_function, precision, batch, left, &evaluated.results, tally);
      left = left.subspan(evaluated.rows.size());
    }
  }

  const FunctionCase& m_function;
  const CpuFunction& m_evaluate;
  DeviceSide* m_device;
  std::mutex m_mutex;
  std::vector<Column>& m_columns;
};

FunctionResult stressColumns(const FunctionCase& function, const FunctionOptions& options, const CpuFunction& evaluate,
                             const gpu::Device* device) {
  const base::Stopwatch watch(nullptr, "");
  FunctionResult result;
  result.function = function;
  for (const Precision precision : kPrecisions) result.columns.push_back(makeColumn(function, precision, false));
  const RowSource rows(result.function, options.points), deviceRows(result.function, device ? options.devicePoints : 0);
  result.points = rows.points();
  std::optional<DeviceSide> onDevice;
  if (device && options.devicePoints > 0) {
    onDevice.emplace(*device, function.id);
    result.devicePoints = deviceRows.points();
    for (const Precision precision : {Precision::f32, Precision::f16}) {
      Column& column = result.columns.emplace_back(makeColumn(function, precision, true));
      if (precision == Precision::f16 && !device->report().float16)
        column.skipped = device->report().name + " has no shaderFloat16";
    }
  }
  ColumnCounter counter(result.function, evaluate, onDevice ? &*onDevice : nullptr, result.columns);
  const std::uint64_t ofDevice = onDevice ? deviceRows.size() : 0, both = std::min(rows.size(), ofDevice);
  counter.count(rows, 0, both, true, true);
  counter.count(rows, both, rows.size(), true, false);
  counter.count(deviceRows, both, ofDevice, false, true);
  result.timeMs = watch.elapsedMs();
  return result;
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
  return stressColumns(function, {.points = points, .devicePoints = 0}, evaluate, nullptr);
}

FunctionResult stressFunction(const FunctionCase& function, const FunctionOptions& options, const gpu::Device* device) {
  return stressColumns(
      function, options,
      [id = function.id](Precision precision, const Row& row) { return evaluateRounded(precision, id, row); }, device);
}

} // namespace parity::stress

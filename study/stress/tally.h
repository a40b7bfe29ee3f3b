// What a stress run counts of one function in one precision on one side: faults, errors, disagreement.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "study/stress/function_table.h"

namespace parity::stress {

// An input worth showing: the row as the precision got it, and for a fault of two rows the second one too.
struct Example {
  double value = 0; // how bad: the relative error, the value itself, or by how many last places two rows disagree
  int output = 0;
  std::uint64_t index = 0; // of the row in the run's order: ties go to the first
  Row row{};
  std::optional<Row> second;
};

// Relative errors, counted in bins of 1/16 octave from 2^-64 to 2^64: bounded memory, percentiles within 4.5 %.
class ErrorHistogram {
public:
  void add(double error);
  void merge(const ErrorHistogram& other);
  std::uint64_t count() const { return m_count; }
  // The error that this share of all stay below: the upper end of its bin; 0 where all below are exact.
  double percentile(double share) const;

private:
  static constexpr int kBinsOfOctave = 16, kLeastExponent = -64, kBins = 128 * kBinsOfOctave;
  std::uint64_t m_count = 0, m_exact = 0;
  std::vector<std::uint64_t> m_bins = std::vector<std::uint64_t>(kBins);
};

// How often a fault came and where it was worst; of what the table does not expect apart.
struct FaultCount {
  std::uint64_t rows = 0, unexpected = 0;
  std::optional<Example> worst, worstUnexpected;
};

inline constexpr int kMapSize = 24; // cells a side of the map of errors

struct Tally {
  std::uint64_t inside = 0, outside = 0; // rows within the domain, and special values beyond it
  std::uint64_t outsideNotFinite = 0;    // of the latter: what came out
  std::uint64_t pairs = 0;               // of rows, held against a claim
  std::uint64_t errorsOmitted = 0;       // values beyond the format's largest number, or not finite
  std::array<FaultCount, kFaultCount> faults;
  std::vector<std::uint64_t> expectationHits; // for each of FunctionCase::expected
  ErrorHistogram errors;                      // of the rows within the domain, each output
  std::optional<Example> worstError;
  double greatestUlps = 0; // device against CPU, at the agreement's scale
  std::optional<Example> worstUlps;
  std::vector<double> map; // kMapSize^2, the greatest error a cell, row by row of roughness; -1: no row; empty: no map

  explicit Tally(const FunctionCase& function);
  void merge(const Tally& other);
};

// One row, in the domain or not: what came out, the reference at the same row, and (device) what the CPU got at equal
// precision, else null.
void countRow(const FunctionCase& function, Precision precision, std::uint64_t index, const Row& row, bool inside,
              const Result& result, const Result& reference, const Result* cpu, Tally& tally);

// Two rows and a claim about them; both within the domain.
void countPair(const FunctionCase& function, Precision precision, std::uint64_t index, const Claim& claim,
               const Row& first, const Result& firstResult, const Row& second, const Result& secondResult,
               Tally& tally);

} // namespace parity::stress

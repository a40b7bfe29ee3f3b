#include "study/stress/tally.h"

#include <algorithm>
#include <cmath>

namespace parity::stress {

namespace {

// Keeps the worse of two; of equals the one that comes first.
void keepWorst(std::optional<Example>& kept, const Example& candidate) {
  if (!kept || candidate.value > kept->value || (candidate.value == kept->value && candidate.index < kept->index))
    kept = candidate;
}

void mergeWorst(std::optional<Example>& kept, const std::optional<Example>& other) {
  if (other) keepWorst(kept, *other);
}

// A fault of this row: expected where a region of the table holds it.
void addFault(const FunctionCase& function, Precision precision, Fault fault, const Example& example, Tally& tally) {
  FaultCount& count = tally.faults[static_cast<std::size_t>(fault)];
  ++count.rows;
  keepWorst(count.worst, example);
  for (std::size_t e = 0; e < function.expected.size(); ++e) {
    const Expectation& expected = function.expected[e];
    if (expected.fault != fault || !(expected.precisions & bitOf(precision))) continue;
    if (!expected.region(example.row) && !(example.second && expected.region(*example.second))) continue;
    ++tally.expectationHits[e];
    return;
  }
  ++count.unexpected;
  keepWorst(count.worstUnexpected, example);
}

int cellOf(double x) { return std::clamp(static_cast<int>(x * kMapSize), 0, kMapSize - 1); }

double ulpOf(double magnitude, const Format& format) {
  const int exponent = magnitude > 0 ? std::max(std::ilogb(magnitude), format.minExponent) : format.minExponent;
  return std::ldexp(1.0, exponent - format.mantissaBits);
}

bool keepsContract(Contract contract, const Row& row, const Domain& domain) {
  if (contract == Contract::none) return false;
  for (const Input& input : domain.inputs)
    for (int c = 0; c < input.components(); ++c) {
      const double x = row[input.at + c];
      if (std::isnan(x) || (contract == Contract::forFinite && std::isinf(x))) return false;
    }
  return true;
}

} // namespace

void ErrorHistogram::add(double error) {
  ++m_count;
  if (!(error > 0)) {
    ++m_exact;
    return;
  }
  const double bin = (std::log2(error) - kLeastExponent) * kBinsOfOctave;
  ++m_bins[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))];
}

void ErrorHistogram::merge(const ErrorHistogram& other) {
  m_count += other.m_count;
  m_exact += other.m_exact;
  for (std::size_t i = 0; i < m_bins.size(); ++i) m_bins[i] += other.m_bins[i];
}

double ErrorHistogram::percentile(double share) const {
  const double wanted = share * static_cast<double>(m_count);
  std::uint64_t below = m_exact;
  if (m_count == 0 || static_cast<double>(below) >= wanted) return 0;
  for (std::size_t i = 0; i < m_bins.size(); ++i) {
    below += m_bins[i];
    if (static_cast<double>(below) >= wanted)
      return std::exp2(kLeastExponent + static_cast<double>(i + 1) / kBinsOfOctave);
  }
  return 0;
}

Tally::Tally(const FunctionCase& function)
    : expectationHits(function.expected.size()),
      map(function.map.roughness >= 0 ? static_cast<std::size_t>(kMapSize * kMapSize) : 0, -1.0) {}

void Tally::merge(const Tally& other) {
  inside += other.inside;
  outside += other.outside;
  outsideNotFinite += other.outsideNotFinite;
  pairs += other.pairs;
  errorsOmitted += other.errorsOmitted;
  for (std::size_t f = 0; f < kFaultCount; ++f) {
    faults[f].rows += other.faults[f].rows;
    faults[f].unexpected += other.faults[f].unexpected;
    mergeWorst(faults[f].worst, other.faults[f].worst);
    mergeWorst(faults[f].worstUnexpected, other.faults[f].worstUnexpected);
  }
  for (std::size_t e = 0; e < expectationHits.size(); ++e) expectationHits[e] += other.expectationHits[e];
  errors.merge(other.errors);
  mergeWorst(worstError, other.worstError);
  mergeWorst(worstUlps, other.worstUlps);
  greatestUlps = std::max(greatestUlps, other.greatestUlps);
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = std::max(map[i], other.map[i]);
}

void countRow(const FunctionCase& function, Precision precision, std::uint64_t index, const Row& row, bool inside,
              const Result& result, const Result& reference, const Result* cpu, Tally& tally) {
  const auto exampleOf = [&](double value, int output) { return Example{value, output, index, row, {}}; };
  const bool finite =
      std::all_of(result.begin(), result.begin() + function.outputs, [](double value) { return std::isfinite(value); });
  if (!inside) {
    ++tally.outside;
    if (finite) return;
    ++tally.outsideNotFinite;
    if (keepsContract(function.contract, row, function.domain))
      addFault(function, precision, Fault::brokenContract, exampleOf(0, 0), tally);
    return;
  }
  ++tally.inside;
  const Format format = formatOf(precision);
  if (!finite) addFault(function, precision, Fault::notFinite, exampleOf(0, 0), tally);
  const double mostOne = 1 + std::ldexp(4.0, -format.mantissaBits);
  double greatestError = -1, lowest = 0, highest = mostOne;
  int lowestAt = 0, highestAt = 0;
  for (int k = 0; k < function.outputs; ++k) {
    const double value = result[k];
    if (function.nonNegative >> k & 1u && value < lowest) {
      lowest = value;
      lowestAt = k;
    }
    if (function.atMostOne >> k & 1u && value > highest) {
      highest = value;
      highestAt = k;
    }
    if (cpu) {
      const double ulps =
          ulpDistance(value, (*cpu)[k], function.agreement.scale, format.mantissaBits, format.minExponent);
      if (ulps > tally.greatestUlps || (ulps > 0 && ulps == tally.greatestUlps)) {
        tally.greatestUlps = ulps;
        keepWorst(tally.worstUlps, exampleOf(ulps, k));
      }
    }
    if (!std::isfinite(value) || !(std::fabs(reference[k]) <= format.largest)) {
      ++tally.errorsOmitted;
      continue;
    }
    const double scale = std::max({std::fabs(reference[k]), function.errorScale, format.smallestNormal});
    const double error = std::fabs(value - reference[k]) / scale;
    tally.errors.add(error);
    greatestError = std::max(greatestError, error);
    if (error > 0 && (!tally.worstError || error >= tally.worstError->value))
      keepWorst(tally.worstError, exampleOf(error, k));
  }
  if (lowest < 0) addFault(function, precision, Fault::negative, exampleOf(-lowest, lowestAt), tally);
  if (highest > mostOne) addFault(function, precision, Fault::overUnity, exampleOf(highest, highestAt), tally);
  if (!tally.map.empty() && greatestError >= 0) {
    double& cell = tally.map[static_cast<std::size_t>(cellOf(row[function.map.roughness]) * kMapSize +
                                                      cellOf(row[function.map.cosine]))];
    cell = std::max(cell, greatestError);
  }
}

// NOLINTNEXTLINE(readability-function-size): of a pair there are two of everything
void countPair(const FunctionCase& function, Precision precision, std::uint64_t index, const Claim& claim,
               const Row& first, const Result& firstResult, const Row& second, const Result& secondResult,
               Tally& tally) {
  const int at = function.domain.inputs[static_cast<std::size_t>(claim.input)].at;
  const bool symmetric = claim.kind == Claim::Kind::symmetric;
  if (!symmetric && (first[at] == second[at] || std::min(first[at], second[at]) <= claim.above)) return;
  ++tally.pairs;
  const Format format = formatOf(precision);
  std::optional<Example> worst;
  for (int k = 0; k < function.outputs; ++k) {
    if (!(claim.outputs >> k & 1u) || !std::isfinite(firstResult[k]) || !std::isfinite(secondResult[k])) continue;
    double wrong = secondResult[k] - firstResult[k]; // what the value may not do, if positive
    if (symmetric) {
      wrong = std::fabs(wrong);
    } else {
      if (second[at] < first[at]) wrong = -wrong;
      if (claim.kind == Claim::Kind::increasing) wrong = -wrong;
    }
    if (!(wrong > 0)) continue;
    const double scale = std::max({std::fabs(firstResult[k]), std::fabs(secondResult[k]), claim.scale});
    const double ulps = wrong / ulpOf(scale, format);
    if (ulps > claim.slackUlps) keepWorst(worst, {ulps, k, index, first, second});
  }
  if (worst) addFault(function, precision, symmetric ? Fault::notReciprocal : Fault::notMonotone, *worst, tally);
}

} // namespace parity::stress

// What a function of the table takes: names and ranges of its inputs, how points are spread over them, and which
// special values are tried.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "study/stress/evaluate.h"

namespace parity::stress {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

// How points are spread over an input's range. All visit both ends.
enum class Spacing {
  uniform,
  unit,        // [0, 1]: half of the points evenly, the rest crowded towards either end by powers of two
  cosine,      // [-1, 1]: as unit, with either sign
  logarithmic, // powers of two from `least` to `most`, with either sign where the range has both
  direction,   // three inputs: a unit vector
  choice,      // one of `choices`, to name a branch
};

struct Input {
  std::string name;
  int at = 0; // in the row; of a direction the first of three
  double low = 0, high = 1;
  Spacing spacing = Spacing::unit;
  bool wide = false; // at least single precision whatever the function's own is (real32)
  double least = 0x1p-24, most = 1;
  bool takesNan = false;
  std::vector<double> choices = {};

  int components() const { return spacing == Spacing::direction ? 3 : 1; }
};

// Inputs as the table writes them.
Input unit(int at, const char* name);
Input cosine(int at, const char* name);
Input within(int at, const char* name, double low, double high);
// Powers of two between least and most; low and high are the ends of the range.
Input powers(int at, const char* name, double low, double high, double least, double most);
Input direction(int at, const char* name);
Input choice(int at, const char* name, std::vector<double> choices);
Input wide(Input input);
// name.r, name.g, name.b: `input` three times.
std::vector<Input> rgb(Input input);

struct Domain {
  std::vector<Input> inputs;
  // What the ranges do not say, such as "inner >= outer"; null: nothing.
  bool (*holds)(const Row&) = nullptr;
  // Brings a sampled row to where `holds` is true, or to where the function is most interesting; `u` in (0, 1) is one
  // more number to do it by. Null: nothing.
  void (*settle)(Row&, double u) = nullptr;

  // How many numbers one row has (three for a direction).
  int numbers() const;
  // The index in the row of the i-th of them, and its name ("N.y").
  int position(int number) const;
  std::string nameOf(int number) const;
  // In the ranges of all inputs, and `holds`.
  bool contains(const Row& row) const;
};

// Each number as the precision gets it: half, or single where the input is wide; single too for Precision::f64, so that
// single precision sees the same rows.
Row roundTo(Precision precision, const Domain& domain, const Row& row);

// Point `index` of an Owen-scrambled Sobol sequence (padded by pairs of dimensions: Burley 2020, "Practical Hash-based
// Owen Scrambling", section 5) over the domain.
Row samplePoint(const Domain& domain, std::uint32_t index);
// The same point with input `input` (index into Domain::inputs; no direction) moved elsewhere: near or far.
Row movedPoint(const Domain& domain, const Row& row, int input, std::uint32_t index);

// Zero, the smallest and largest denormals and the smallest normal of half and single, neighbours of 1, 65504, 1e6,
// infinity, NaN, and negative ones.
const std::vector<double>& specialValues();

// A structured grid: a base point in the middle of the domain, with each special value and each end of the range for
// each number, alone and in pairs.
class SpecialGrid {
public:
  explicit SpecialGrid(const Domain& domain);
  std::uint64_t size() const { return m_size; }
  Row row(std::uint64_t index) const;

private:
  const Domain& m_domain;
  Row m_base{};
  std::uint64_t m_size = 1;
  int m_numbers;
  std::uint64_t m_values; // for each number
  double value(int number, std::uint64_t index) const;
};

} // namespace parity::stress

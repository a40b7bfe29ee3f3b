#include "study/stress/domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/sampling.h"
#include "shading/half.h"

namespace parity::stress {

namespace {

// Half of it evenly over (0, 1), a quarter towards each end by powers of two.
double spreadUnit(double u) {
  if (u < 0.5) return 2 * u;
  if (u < 0.75) return std::exp2(-24 * (4 * u - 2));
  return 1 - std::exp2(-24 * (4 * u - 3));
}

double spread(const Input& input, double u) {
  if (input.spacing == Spacing::choice)
    return input.choices[std::min(static_cast<std::size_t>(u * static_cast<double>(input.choices.size())),
                                  input.choices.size() - 1)];
  constexpr double kEnds = 1.0 / 64;
  if (u < kEnds) return input.low;
  if (u > 1 - kEnds) return input.high;
  u = (u - kEnds) / (1 - 2 * kEnds);
  switch (input.spacing) {
  case Spacing::unit:
    return spreadUnit(u);
  case Spacing::cosine:
    return u < 0.5 ? -spreadUnit(2 * u) : spreadUnit(2 * u - 1);
  case Spacing::logarithmic: {
    const bool signedRange = input.low < 0;
    const double sign = signedRange && u < 0.5 ? -1 : 1;
    if (signedRange) u = u < 0.5 ? 2 * u : 2 * u - 1;
    return sign * std::exp2(std::log2(input.least) + u * (std::log2(input.most) - std::log2(input.least)));
  }
  default:
    return input.low + (input.high - input.low) * u;
  }
}

void putDirection(Row& row, int at, double u, double v) {
  const double z = 2 * u - 1, phi = 2 * std::numbers::pi * v, r = std::sqrt(std::max(0.0, 1 - z * z));
  row[at] = r * std::cos(phi);
  row[at + 1] = r * std::sin(phi);
  row[at + 2] = z;
}

// Two dimensions of the padded sequence.
glm::dvec2 sobolPair(std::uint32_t index, std::uint32_t pair) {
  const std::uint32_t seed = reference::hashCombine(0x9d2c5680u, pair);
  const std::uint32_t shuffled =
      reference::reverseBits(reference::scrambleReversed(reference::reverseBits(index), seed));
  return reference::sobolPoint(shuffled, seed);
}

// Hands out the sequence's dimensions one after the other.
class Dimensions {
public:
  explicit Dimensions(std::uint32_t index, std::uint32_t firstPair = 0) : m_index(index), m_pair(firstPair) {}
  double next() {
    if (m_second) {
      m_second = false;
      return m_values.y;
    }
    m_values = sobolPair(m_index, m_pair++);
    m_second = true;
    return m_values.x;
  }

private:
  std::uint32_t m_index, m_pair;
  glm::dvec2 m_values{0};
  bool m_second = false;
};

} // namespace

Input unit(int at, const char* name) { return {.name = name, .at = at}; }
Input cosine(int at, const char* name) { return {.name = name, .at = at, .low = -1, .spacing = Spacing::cosine}; }
Input within(int at, const char* name, double low, double high) {
  return {.name = name, .at = at, .low = low, .high = high, .spacing = Spacing::uniform};
}
Input powers(int at, const char* name, double low, double high, double least, double most) {
  return {
      .name = name, .at = at, .low = low, .high = high, .spacing = Spacing::logarithmic, .least = least, .most = most};
}
Input direction(int at, const char* name) {
  return {.name = name, .at = at, .low = -1, .high = 1, .spacing = Spacing::direction};
}
Input choice(int at, const char* name, std::vector<double> choices) {
  Input input{.name = name, .at = at, .spacing = Spacing::choice};
  input.low = *std::min_element(choices.begin(), choices.end());
  input.high = *std::max_element(choices.begin(), choices.end());
  input.choices = std::move(choices);
  return input;
}
Input wide(Input input) {
  input.wide = true;
  return input;
}
std::vector<Input> rgb(Input input) {
  std::vector<Input> inputs(3, input);
  for (int c = 0; c < 3; ++c) {
    inputs[c].at += c;
    inputs[c].name += std::string(".") + "rgb"[c];
  }
  return inputs;
}

int Domain::numbers() const {
  int count = 0;
  for (const Input& input : inputs) count += input.components();
  return count;
}

int Domain::position(int number) const {
  for (const Input& input : inputs) {
    if (number < input.components()) return input.at + number;
    number -= input.components();
  }
  return -1;
}

std::string Domain::nameOf(int number) const {
  for (const Input& input : inputs) {
    if (number < input.components())
      return input.components() == 1 ? input.name : input.name + "." + std::string(1, "xyz"[number]);
    number -= input.components();
  }
  return {};
}

bool Domain::contains(const Row& row) const {
  for (const Input& input : inputs) {
    double squares = 0;
    for (int c = 0; c < input.components(); ++c) {
      const double x = row[input.at + c];
      if (!(x >= input.low && x <= input.high) && !(input.takesNan && std::isnan(x))) return false;
      squares += x * x;
    }
    // Halves are unit to 5e-4.
    if (input.spacing == Spacing::direction && !(std::fabs(std::sqrt(squares) - 1) < 2e-3)) return false;
  }
  return !holds || holds(row);
}

Row roundTo(Precision precision, const Domain& domain, const Row& row) {
  Row rounded{};
  for (const Input& input : domain.inputs)
    for (int i = input.at; i < input.at + input.components(); ++i)
      rounded[i] = precision == Precision::f16 && !input.wide ? static_cast<double>(shading::Half(row[i]))
                                                              : static_cast<double>(static_cast<float>(row[i]));
  return rounded;
}

Row samplePoint(const Domain& domain, std::uint32_t index) {
  Row row{};
  Dimensions dimensions(index);
  for (const Input& input : domain.inputs) {
    const double u = dimensions.next();
    if (input.spacing == Spacing::direction)
      putDirection(row, input.at, u, dimensions.next());
    else
      row[input.at] = spread(input, u);
  }
  if (domain.settle) domain.settle(row, dimensions.next());
  return row;
}

Row movedPoint(const Domain& domain, const Row& row, int input, std::uint32_t index) {
  const Input& moved = domain.inputs[static_cast<std::size_t>(input)];
  Dimensions dimensions(index, 1000);
  const double u = dimensions.next(), near = dimensions.next();
  Row other = row;
  other[moved.at] = spread(moved, u);
  // Half of the time a small step from where it was, down to a few last places of half.
  if (near < 0.5 && std::isfinite(other[moved.at]) && std::isfinite(row[moved.at]))
    other[moved.at] = row[moved.at] + (other[moved.at] - row[moved.at]) * std::exp2(-24 * near);
  return other;
}

const std::vector<double>& specialValues() {
  static const std::vector<double> values = {0,
                                             0x1p-149,
                                             0x1p-126 - 0x1p-149,
                                             0x1p-126,
                                             0x1p-24,
                                             0x1p-14 - 0x1p-24,
                                             0x1p-14,
                                             1 - 0x1p-11,
                                             1 - 0x1p-24,
                                             1,
                                             1 + 0x1p-23,
                                             1 + 0x1p-10,
                                             65504,
                                             1e6,
                                             kInf,
                                             std::numeric_limits<double>::quiet_NaN(),
                                             -0x1p-149,
                                             -0x1p-14,
                                             -1,
                                             -65504,
                                             -kInf};
  return values;
}

SpecialGrid::SpecialGrid(const Domain& domain)
    : m_domain(domain), m_numbers(domain.numbers()), m_values(specialValues().size() + 2) {
  for (const Input& input : domain.inputs) {
    if (input.spacing == Spacing::direction) {
      // Not one for all: a mirror direction is then neither the normal nor the view.
      putDirection(m_base, input.at, 0.7 + 0.01 * input.at, 0.15 + 0.11 * input.at);
    } else {
      m_base[input.at] = spread(input, 0.37);
    }
  }
  if (domain.settle) domain.settle(m_base, 0.25);
  const auto n = static_cast<std::uint64_t>(m_numbers);
  m_size = 1 + n * m_values + n * (n > 0 ? n - 1 : 0) / 2 * m_values * m_values;
}

double SpecialGrid::value(int number, std::uint64_t index) const {
  const std::vector<double>& values = specialValues();
  if (index < values.size()) return values[index];
  for (const Input& input : m_domain.inputs) {
    if (number < input.components()) return index == values.size() ? input.low : input.high;
    number -= input.components();
  }
  return 0;
}

Row SpecialGrid::row(std::uint64_t index) const {
  Row row = m_base;
  if (index == 0) return row;
  --index;
  const std::uint64_t singles = static_cast<std::uint64_t>(m_numbers) * m_values;
  if (index < singles) {
    const int number = static_cast<int>(index / m_values);
    row[m_domain.position(number)] = value(number, index % m_values);
    return row;
  }
  index -= singles;
  const std::uint64_t values = index % (m_values * m_values);
  std::uint64_t pair = index / (m_values * m_values);
  int first = 0;
  while (pair >= static_cast<std::uint64_t>(m_numbers - 1 - first)) {
    pair -= static_cast<std::uint64_t>(m_numbers - 1 - first);
    ++first;
  }
  const int second = first + 1 + static_cast<int>(pair);
  row[m_domain.position(first)] = value(first, values / m_values);
  row[m_domain.position(second)] = value(second, values % m_values);
  return row;
}

} // namespace parity::stress

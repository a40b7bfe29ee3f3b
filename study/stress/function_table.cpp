#include "study/stress/function_table.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/glob.h"
#include "base/text/nearest.h"

namespace parity::stress {

const char* nameOf(Fault fault) {
  constexpr const char* kNames[kFaultCount] = {"not finite",   "negative",       "above 1",
                                               "not monotone", "not reciprocal", "contract broken"};
  return kNames[static_cast<std::size_t>(fault)];
}

namespace {

int indexOf(const FunctionCase& function, const std::string& input) {
  const std::vector<Input>& inputs = function.domain.inputs;
  const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const Input& i) { return i.name == input; });
  if (found == inputs.end()) throw std::logic_error(function.name + " has no input " + input);
  return static_cast<int>(found - inputs.begin());
}

} // namespace

FunctionCase& FunctionCase::takes(std::vector<Input> inputs) {
  domain.inputs = std::move(inputs);
  return *this;
}
FunctionCase& FunctionCase::also(std::vector<Input> inputs) {
  domain.inputs.insert(domain.inputs.end(), inputs.begin(), inputs.end());
  return *this;
}
FunctionCase& FunctionCase::where(bool (*holds)(const Row&)) {
  domain.holds = holds;
  return *this;
}
FunctionCase& FunctionCase::settledBy(void (*settle)(Row&, double u)) {
  domain.settle = settle;
  return *this;
}
FunctionCase& FunctionCase::gives(int count, std::uint32_t notNegative, std::uint32_t notAboveOne) {
  outputs = count;
  nonNegative = notNegative;
  atMostOne = notAboveOne;
  return *this;
}
FunctionCase& FunctionCase::promises(Contract promised) {
  contract = promised;
  return *this;
}
FunctionCase& FunctionCase::relativeTo(double scale) {
  errorScale = scale;
  return *this;
}
FunctionCase& FunctionCase::increases(const char* input, std::uint32_t of, double scale, double above) {
  claims.push_back(
      {.kind = Claim::Kind::increasing, .input = indexOf(*this, input), .outputs = of, .scale = scale, .above = above});
  return *this;
}
FunctionCase& FunctionCase::decreases(const char* input, std::uint32_t of, double scale, double above) {
  claims.push_back(
      {.kind = Claim::Kind::decreasing, .input = indexOf(*this, input), .outputs = of, .scale = scale, .above = above});
  return *this;
}
FunctionCase& FunctionCase::sameSwapping(const char* input, const char* with, std::uint32_t of) {
  claims.push_back(
      {.kind = Claim::Kind::symmetric, .input = indexOf(*this, input), .other = indexOf(*this, with), .outputs = of});
  return *this;
}
FunctionCase& FunctionCase::mapped(int roughness, int cosineAt) {
  map = {roughness, cosineAt};
  return *this;
}
FunctionCase& FunctionCase::expect(const Expectation& expectation) {
  expected.push_back(expectation);
  return *this;
}

std::vector<FunctionCase> functionTable() {
  std::vector<FunctionCase> table;
  for (auto piece : {generalFunctions(), specularFunctions(), mobileFunctions(), bakedFunctions()})
    table.insert(table.end(), piece.begin(), piece.end());
  std::stable_sort(table.begin(), table.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return table;
}

std::vector<FunctionCase> functionsNamed(const std::string& glob) {
  std::vector<FunctionCase> chosen;
  const std::vector<FunctionCase> table = functionTable();
  std::vector<std::string_view> names;
  for (const FunctionCase& function : table) {
    names.push_back(function.name);
    if (base::matchesGlob(glob, function.name)) chosen.push_back(function);
  }
  if (chosen.empty())
    throw base::Error(base::ExitCode::usage, "--functions", glob,
                      "unknown function; " + base::describeNearestToGlob(glob, names));
  return chosen;
}

} // namespace parity::stress

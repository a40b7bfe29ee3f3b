#include "mobile/formulas.h"

namespace parity::mobile {

namespace {

constexpr std::size_t kBuiltIn = static_cast<std::size_t>(EnvironmentBrdf::refit) + 1;

std::vector<Formula>& formulas() {
  static std::vector<Formula> all;
  return all;
}

} // namespace

EnvironmentBrdf addFormula(const Formula& formula) {
  formulas().push_back(formula);
  return static_cast<EnvironmentBrdf>(kBuiltIn + formulas().size() - 1);
}

const Formula* formulaOf(EnvironmentBrdf environmentBrdf) {
  const auto place = static_cast<std::size_t>(environmentBrdf);
  return place < kBuiltIn ? nullptr : &formulas().at(place - kBuiltIn);
}

const std::vector<std::string>& environmentBrdfNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"karis2014", "ue4", "refit"};
    for (const Formula& formula : formulas()) all.push_back(formula.name);
    return all;
  }();
  return names;
}

} // namespace parity::mobile

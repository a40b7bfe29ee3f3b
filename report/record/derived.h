// What report.json says beyond a report's members: derived from them as it is written.
#pragma once

#include <map>
#include <string>

#include "compare/pooling/figures.h"
#include "report/report.h"

namespace parity::report {

// How to read and to write a figure.
struct FigureWords {
  std::string label, unit; // unit: "%" of a share
  int digits = 0;
  std::string better; // "lower", "higher" or "near zero"
};

// Of every figure that the report has or judges, by name; without names that no metric has.
std::map<std::string, FigureWords> figureWordsOf(const Report& report);

// The bias in words; empty without pixels. test: the path's name.
std::string biasOf(const compare::Figures& figures, const std::string& test);

} // namespace parity::report

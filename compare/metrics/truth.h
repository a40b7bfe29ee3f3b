// What the ground truth says of the two paths: figures against it, term by term, and how well it is known itself. It
// judges nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/pooling/figures.h"

namespace parity::compare {

// How well the truth is known over a region. All 0: exactly, or none of its samples met any light. NaN: a pixel's error
// is not known.
struct TruthError {
  double median = 0, worst = 0; // relative standard error of its pixels
  double relmse = 0;            // that this error alone would give (compare/metrics/measure_truth.h)
  double samples = 0;           // of the environment, a pixel and way of sampling, on average; 0: all in closed form
};

// Figures of a material or a whole image. In them the reference is the truth, the test is the path.
struct TruthFigures {
  Figures reference, test; // flip.*, relmse, bias.*
  TruthError error;
  std::uint64_t nonFinite = 0; // pixels where the truth itself is NaN or infinite
};

// One term by all three.
struct TruthTerm {
  std::string name;
  double truth = 0, reference = 0, test = 0; // mean scene-referred luminance
  Figures referenceFigures, testFigures;     // flip.mean and relmse of that term alone against the truth's
};

// Paths relative to the report folder, '/'-separated; empty where there is none.
struct TruthImages {
  std::string truth, referenceFlip, testFlip; // PNG for display; FLIP of each path against the truth, in magma
};

// Of a material or a whole image.
struct Truth {
  TruthFigures figures;
  std::vector<TruthTerm> terms;   // without those that are black in all three
  std::vector<std::string> notes; // what to beware of in these figures
  TruthImages images;
};

// Whether a path's relMSE against the truth is at most that of 2 standard errors of the truth (in root mean square), so
// that it says little. Not of a truth that is exact, nor of one whose error is not known.
bool isWithinNoise(const Figures& figures, const TruthError& error);
inline constexpr double kFewStandardErrors = 2;

} // namespace parity::compare

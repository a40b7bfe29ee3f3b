// What parity flip prints and writes of its result: for people, for spreadsheets, for programs, for CI.
#pragma once

#include <filesystem>
#include <string>

#include "compare/images/flip_run.h"

namespace parity::compare {

// What a verdict is called: that of limits, or "not judged" for a pass that no limits stand behind.
std::string nameOf(const FlipResult& result, Verdict verdict);

// For a terminal. One pair of one region: its figures one below the other; else a line for each region of each pair.
// Ends in the verdict in words. Names are made fit to be shown.
std::string toTable(const FlipResult& result);

// RFC 4180, UTF-8, a line for each region of each pair; a pair that could not be compared has one line without figures.
// Columns: pair, reference, test, region, range (ldr or hdr), verdict (or "not judged"), exit_code, pixels, non_finite,
// one for each figure that was measured in any row (over all pixels of the region; empty where it was not), reason.
std::string toCsv(const FlipResult& result, bool warnExit);

// {"tool", "version", "format": 1, "verdict", "exitCode", "warnings": [], "skippedFiles": [], "pairs": [{"name",
// "reference", "test", "width", "height", "channels", "range": "ldr"|"hdr", "rangeReason", "referenceSpace",
// "testSpace", "identical", "area", "notes": [], "verdict", "exitCode", "reason", "files": [], "pooling": {"mean",
// "weightedMedian", "weightedQ1", "weightedQ3", "min", "max", "histogram": [100]} or null, "regions": [{"name",
// "verdict", "reason", "figures": F, "checks":
// [{"metric", "value", "warn", "fail", "verdict", "regress", "unjudged", "note"}]}]}]} where F, as in
// report.json, = {"pixels", "nonFinite", "metrics": {NAME: value}, "referenceLuma", "testLuma"}. Full precision; NaN
// and infinity (the PSNR of identical pictures) are null. A verdict "not judged" is a pass without any limits. "width"
// to "area" are left out for a pair that could not be compared so far.
std::string toJson(const FlipResult& result, bool warnExit);

// A suite for each pair, a case for each of its regions (or one, "pair", where it could not be compared): <failure>
// beyond a limit, <error> where it could not be judged, <skipped> where there was no limit to judge by; a case that
// only warns passes and says so.
std::string toJunit(const FlipResult& result);

// Workflow commands of GitHub Actions (report/report.h): an error for each region or pair that failed, a warning for
// each that warns and for each of the run's own, at the budget rule's line or the list's. Files below `root` (the
// checkout) are named relative to it.
std::string toAnnotations(const FlipResult& result, const std::filesystem::path& root);

} // namespace parity::compare

// Pieces of the report page that materials and whole images share. Everything returned is escaped HTML.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/report.h"

namespace parity::compare {

// The verdict as a coloured label with a sign and its name: never colour alone.
std::string verdictBadge(Verdict verdict);
// The class name of a verdict in report_page.css: "pass", "not-seen", "warn", "fail", "error".
std::string verdictClass(Verdict verdict);

// Reference, test and FLIP side by side, each a link to the full-size file; a note where there is no image. With a
// truth two rows: the three pictures, below them how far apart they are. subject: what they show, for alt texts.
std::string imageTrio(const ImageSet& images, const std::optional<Truth>& truth, const std::string& subject);

// A bar for each budget check: the value, the limits as marks, and both in words.
std::string checkBars(const std::vector<CheckResult>& checks);

// Every figure: a column for interior pixels and one for all; with a baseline, the change since then (interior, or all
// where there is no interior).
std::string figureTable(const RegionFigures& regions, const std::optional<BaselineChange>& baseline);

// What the baseline says of it, as a paragraph; empty where there is none.
std::string baselineLine(const std::optional<BaselineChange>& baseline);

// The light of each term by both paths and what it adds to the difference; empty where there are none.
std::string termTable(const std::vector<TermFigures>& terms);

// Both paths against the truth, in words and figures; and their light by terms beside its. Empty where there is none.
// whole: of a whole image, over all pixels; else over the interior, where there is one.
std::string truthNumbers(const std::optional<Truth>& truth, bool whole);
std::string truthTerms(const std::optional<Truth>& truth, bool whole);

// What mobile's render target alone makes, as a paragraph; empty where it was not measured. whole: as truthNumbers.
std::string encodingLine(const std::optional<Encoding>& encoding, bool whole);

// What the figures above those are of; empty where there is no truth.
std::string pairHeading(const std::optional<Truth>& truth);

// What the reader has to know of the truth, as a paragraph; empty where there is none.
std::string truthHelp(const Report& report);

// The magma scale in which FLIP maps are drawn, 0..1.
std::string magmaLegend();

// <ul class=...> of texts; empty where there are none.
std::string textList(const std::vector<std::string>& texts, const char* cssClass);

// <dt> and <dd> of a list of facts; empty where there is no value.
std::string definition(const std::string& name, const std::string& value);

// What the run was held against, the largest changes since then, and what is gone; empty where there is no baseline.
std::string baselineSection(const Report& report);

// What a scene's run did, and what it skipped and why; empty where nothing is known of it.
std::string passTable(const std::vector<PassResult>& passes);

// The shaders that ran, with their costs where they are known; empty where there are none.
std::string permutationTable(const std::vector<PermutationResult>& permutations);

// One material's row.
std::string materialRow(const MaterialResult& material, const std::string& place, std::size_t order);

} // namespace parity::compare

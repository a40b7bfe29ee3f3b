// The records of compare/ that a report holds: figures, checks, conditions, the ground truth.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "compare/metrics/attribution.h"
#include "compare/metrics/truth.h"
#include "compare/pooling/condition.h"
#include "compare/pooling/figures.h"
#include "compare/pooling/statistic.h"
#include "compare/verdict/check.h"
#include "report/record/record.h"

namespace parity::report {

template <> struct Names<compare::Verdict> {
  using enum compare::Verdict;
  static constexpr std::array values = {pass, notSeen, tooSmall, notJudged, warn, fail, notRun, error};
  static constexpr std::string_view name = "verdict", refusal = "'{}' is not a verdict",
                                    words = "In order of severity; a whole has the worst verdict of its parts";
  static std::string nameOf(compare::Verdict value) { return compare::nameOf(value); }
};

template <> struct Names<compare::ActsOn> {
  using enum compare::ActsOn;
  static constexpr std::array values = {figures, wholes, truth};
  static constexpr std::string_view name = "", refusal = "'{}' is not what a condition acts on", words = "";
  static std::string nameOf(compare::ActsOn value) { return compare::nameOf(value); }
};

template <> struct Names<compare::Accept> {
  static constexpr const auto& values = compare::kAccepts;
  static constexpr std::string_view name = "accept", refusal = "'{}' cannot be accepted",
                                    words = "What a budget accepts although it is no pass";
  static std::string nameOf(compare::Accept value) { return compare::nameOf(value); }
};

template <> struct Names<compare::ApprovalState> {
  using enum compare::ApprovalState;
  static constexpr std::array values = {holds, loose, expired, lapsed};
  static constexpr std::string_view name = "", refusal = "'{}' is not a state of an approval", words = "";
  static std::string nameOf(compare::ApprovalState value) { return compare::nameOf(value); }
};

// A row is a line.
// clang-format off
template <> inline constexpr auto kRecord<compare::Figure> = record<compare::Figure>(
    "", "",
    hidden(&compare::Figure::name),
    hidden(&compare::Figure::value));
// An infinite figure of which more is better (psnr) is null; any other null is NaN.
template <> struct ByName<compare::Figure> {
  static const std::string& keyOf(const compare::Figure& figure) { return figure.name; }
  static double valueOf(const compare::Figure& figure) { return figure.value; }
  static compare::Figure make(const std::string& name, std::optional<double> value) {
    if (value) return {name, *value};
    const std::shared_ptr<const compare::Statistic> known = compare::statisticByName(name);
    return {name, known && known->better == compare::Better::higher && std::isinf(known->most) ? INFINITY : NAN};
  }
};

template <> inline constexpr auto kRecord<compare::Condition> = record<compare::Condition>(
    "condition",
    "A condition, besides the scene's files, that decides figures: a baseline with other conditions is not comparable",
    field("name", &compare::Condition::name, "", {.read = true, .filled = true}),
    field("value", &compare::Condition::value, "With full precision; a file counts by its content", {.read = true}),
    field("actsOn", &compare::Condition::actsOn,
          "The figures that it decides: all except those against the truth, only those of whole images, or only those "
          "against the truth", {.read = true}),
    field("words", &compare::Condition::words, "The value in words; absent: the same as the value",
          {.read = true, .ifEmpty = IfEmpty::absent, .filled = true}));

template <> inline constexpr auto kRecord<compare::Figures> = record<compare::Figures>(
    "figures", "",
    field("pixels", &compare::Figures::pixels, "", {.read = true, .least = 1}),
    field("nonFinite", &compare::Figures::nonFinite, "Pixels where either render is NaN or infinite", {.read = true}),
    field("metrics", &compare::Figures::values,
          "By the name of the figure: flip.mean, flip.fraction_over(0.1), psnr, bias.ev, ... (compare/pooling/statistic.h)",
          {.read = true}),
    field("clippedBlack", &compare::Figures::clippedBlack,
          "Share of pixels that are black in both displayed images, so that they show no difference",
          {.read = true, .mayLack = true, .least = 0, .most = 1}),
    field("clippedWhite", &compare::Figures::clippedWhite,
          "Share of pixels that are white in both displayed images, so that they show no difference",
          {.read = true, .mayLack = true, .least = 0, .most = 1}),
    field("referenceLuma", &compare::Figures::referenceLuma, "Mean Rec.709 luma of the displayed reference",
          {.read = true, .mayLack = true, .least = 0, .most = 1}),
    field("testLuma", &compare::Figures::testLuma, "The same for the test",
          {.read = true, .mayLack = true, .least = 0, .most = 1}),
    field("referenceLuminance", &compare::Figures::referenceLuminance,
          "Mean linear luminance of the reference as exposed, before clipping; 1 is white",
          {.read = true, .mayLack = true}),
    field("testLuminance", &compare::Figures::testLuminance, "The same for the test", {.read = true, .mayLack = true}));
// Without pixels all else is meaningless: a zero there would read as "alike".
template <> struct Emptiness<compare::Figures> {
  static bool isEmpty(const compare::Figures& figures) { return figures.pixels == 0; }
};

template <> inline constexpr auto kRecord<compare::AppliedApproval> = record<compare::AppliedApproval>(
    "approval", "An approval of the figure, as it stands on the day 'asOf' of the report",
    field("origin", &compare::AppliedApproval::origin, "Place of the entry"),
    field("state", &compare::AppliedApproval::state,
          "holds: it covers the figure; loose and expired: the same with a warning; lapsed: it does not"),
    field("value", &compare::AppliedApproval::value, "The figure that was approved", {.finite = true}),
    field("slack", &compare::AppliedApproval::slack, "How much worse the figure may be", {.finite = true, .least = 0}),
    field("until", &compare::AppliedApproval::until, "The last day on which it holds, ISO 8601"),
    field("daysLeft", &compare::AppliedApproval::daysLeft, "Until that day; negative: days since"),
    field("owner", &compare::AppliedApproval::owner),
    field("reason", &compare::AppliedApproval::reason),
    field("words", &compare::AppliedApproval::words, "Why it warns or does not hold; empty: it holds"));

template <> inline constexpr auto kRecord<compare::CheckResult> = record<compare::CheckResult>(
    "check", "",
    field("metric", &compare::CheckResult::metric, "A name in 'metrics'", {.readDeep = true, .filled = true}),
    field("regress", &compare::CheckResult::regress,
          "true: the value is not the figure, but its loss against the baseline"),
    field("value", &compare::CheckResult::value, "null: infinite, not a number, or unknown"),
    field("warn", &compare::CheckResult::warnAbove,
          "Limit of the verdict warn: an upper limit, or a lower limit if more is better (psnr, ssim); of the absolute "
          "value if the figure has a sign; null: no limit", {.ifEmpty = IfEmpty::null}),
    field("fail", &compare::CheckResult::failAbove,
          "Limit of the verdict fail: an upper limit, or a lower limit if more is better (psnr, ssim); of the absolute "
          "value if the figure has a sign; null: no limit", {.ifEmpty = IfEmpty::null}),
    shown("verdict", &compare::CheckResult::verdict,
          [](const compare::CheckResult& check) {
            return check.judged() ? check.verdict : compare::Verdict::notJudged;
          },
          "not judged: a regression whose baseline has no counterpart, or has other conditions; a figure of accepted NaN; "
          "an exposure of two pictures too dark to measure it",
          {.readDeep = true, .oneOf = "pass|warn|fail|error|not judged"}),
    shown("note", &compare::CheckResult::note,
          [](const compare::CheckResult& check) { return check.judged() ? check.note : check.unjudged; }),
    hidden(&compare::CheckResult::unjudged),
    field("approval", &compare::CheckResult::approval, "absent: none"));

template <> inline constexpr auto kRecord<compare::AppliedRule> = record<compare::AppliedRule>(
    "rule", "The budget rule that judged it",
    field("rule", &compare::AppliedRule::origin, "Place of the rule; empty: no rule matched"),
    field("preset", &compare::AppliedRule::preset, "Preset whose limits it uses; empty: it has its own limits"),
    field("reason", &compare::AppliedRule::reason),
    field("owner", &compare::AppliedRule::owner),
    field("requireSeen", &compare::AppliedRule::requireSeen),
    field("minPixels", &compare::AppliedRule::minPixels, "A material with fewer pixels is too small to be judged",
          {.least = 1}),
    field("accept", &compare::AppliedRule::accept, "What the rule accepts for its reason; absent: nothing",
          {.ifEmpty = IfEmpty::absent}),
    field("maxNonFinite", &compare::AppliedRule::maxNonFinite,
          "The most NaN or infinite pixels in a view that the rule accepts; absent: none", {.least = 1}),
    hidden(&compare::AppliedRule::file),
    hidden(&compare::AppliedRule::line));

template <> inline constexpr auto kRecord<compare::TermEffect> = record<compare::TermEffect>(
    "termEffect", "",
    field("term", &compare::TermEffect::term),
    field("flip", &compare::TermEffect::flip, "Mean FLIP after the test takes this term from the reference", {.least = 0}));

template <> inline constexpr auto kRecord<compare::Attribution> = record<compare::Attribution>(
    "attribution", "The term that makes the material differ; only for materials over budget, or as --attribution requests",
    field("flip", &compare::Attribution::flip, "Mean FLIP without a swap", {.least = 0}),
    field("terms", &compare::Attribution::terms, "Terms that differ between the paths"));

template <> inline constexpr auto kRecord<compare::TruthError> = record<compare::TruthError>(
    "truthError", "Error of the truth; null: unknown",
    field("median", &compare::TruthError::median, "Median of the relative standard errors of the pixels", {.least = 0}),
    field("worst", &compare::TruthError::worst, "Largest relative standard error of a pixel", {.least = 0}),
    field("relmse", &compare::TruthError::relmse,
          "Approximate relmse from this error alone; every relmse against the truth includes it", {.least = 0}),
    field("samples", &compare::TruthError::samples,
          "Mean number of environment samples for each pixel and sampling strategy; 0: all in closed form", {.least = 0}));

template <> inline constexpr auto kRecord<compare::TruthFigures> = record<compare::TruthFigures>(
    "truthFigures", "",
    field("nonFinite", &compare::TruthFigures::nonFinite,
          "Pixels where the truth itself is NaN or infinite; the verdict then is 'error'", {.read = true, .mayLack = true}),
    field("reference", &compare::TruthFigures::reference, "Figures of the reference against the truth"),
    field("test", &compare::TruthFigures::test, "Figures of the test against the truth"),
    field("error", &compare::TruthFigures::error));
template <> struct Emptiness<compare::TruthFigures> {
  static bool isEmpty(const compare::TruthFigures& figures) { return figures.reference.pixels == 0; }
};

template <> inline constexpr auto kRecord<compare::TruthTerm> = record<compare::TruthTerm>(
    "truthTerm", "",
    field("term", &compare::TruthTerm::name),
    group("luminance", "Mean scene-referred luminance",
        field("truth", &compare::TruthTerm::truth),
        field("reference", &compare::TruthTerm::reference),
        field("test", &compare::TruthTerm::test)),
    groupOrNull("figures",
                "Figures of the term alone against the same term of the truth, displayed like the colour, by name; null: no "
                "pixel", [](const compare::TruthTerm& term) { return term.referenceFigures.pixels == 0; },
        shown("reference", &compare::TruthTerm::referenceFigures,
              [](const compare::TruthTerm& term) { return term.referenceFigures.values; }),
        shown("test", &compare::TruthTerm::testFigures,
              [](const compare::TruthTerm& term) { return term.testFigures.values; })));

template <> inline constexpr auto kRecord<compare::TruthImages> = record<compare::TruthImages>(
    "truthImages", "Paths relative to the report's folder, '/'-separated; empty: none",
    field("truth", &compare::TruthImages::truth),
    field("referenceFlip", &compare::TruthImages::referenceFlip, "FLIP of the view's reference against the truth"),
    field("testFlip", &compare::TruthImages::testFlip, "FLIP of the view's test against the truth"));

template <> inline constexpr auto kRecord<compare::Truth> = record<compare::Truth>(
    "truth", "Both paths against the ground truth; only with --truth. It does not change verdicts",
    field("figures", &compare::Truth::figures, "null: no pixel",
          {.read = true, .mayLack = true, .ifEmpty = IfEmpty::null}),
    field("terms", &compare::Truth::terms, "Without terms that are black in the truth and in both paths"),
    field("notes", &compare::Truth::notes, "Cautions about these figures"),
    field("images", &compare::Truth::images));

// clang-format on
} // namespace parity::report

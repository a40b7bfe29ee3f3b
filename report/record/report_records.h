// The records of report/: the report itself, its scenes, views and materials, and what differs from run to run.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "report/record/compare_records.h"
#include "report/record/derived.h"
#include "report/record/record_writer.h"
#include "report/report.h"

namespace parity::report {

// A row is a line.
// clang-format off
template <> inline constexpr auto kRecord<FigureChange> = record<FigureChange>(
    "", "",
    hidden(&FigureChange::metric),
    hidden(&FigureChange::before),
    hidden(&FigureChange::now));
template <> struct ByName<FigureChange> {
  static const std::string& keyOf(const FigureChange& change) { return change.metric; }
  static double valueOf(const FigureChange& change) { return change.change(); }
};

template <> inline constexpr auto kRecord<BaselineImages> = record<BaselineImages>(
    "baselineImages",
    "Copies of the baseline's pictures that are not as in this run, relative to the report's folder; empty: as in this run, "
    "or the baseline has none of this size",
    field("reference", &BaselineImages::reference),
    field("test", &BaselineImages::test));
template <> struct Emptiness<BaselineImages> {
  static bool isEmpty(const BaselineImages& images) { return images.reference.empty() && images.test.empty(); }
};

template <> inline constexpr auto kRecord<BaselineChange> = record<BaselineChange>(
    "change", "",
    field("new", &BaselineChange::isNew, "The baseline does not have it"),
    shown("verdict", &BaselineChange::before,
          [](const BaselineChange& change) {
            return change.isNew ? std::nullopt : std::optional<compare::Verdict>(change.before);
          },
          "Verdict in the baseline; null: new", {.ifEmpty = IfEmpty::null}),
    field("notComparable", &BaselineChange::notComparable,
          "The conditions that differ, in words; then there are no changes and the verdict is at least warn; empty: no "
          "condition differs"),
    field("changes", &BaselineChange::changes, "Figure of this run minus figure of the baseline; null: from or to infinite"),
    field("images", &BaselineChange::images, "absent: no picture of it changed, or the baseline has none",
          {.ifEmpty = IfEmpty::absent}));

template <> inline constexpr auto kRecord<ImageSet> = record<ImageSet>(
    "images", "Paths relative to the report's folder, '/'-separated; empty: none",
    field("reference", &ImageSet::reference, "", {.read = true, .mayLack = true}),
    field("test", &ImageSet::test, "", {.read = true, .mayLack = true}),
    field("flip", &ImageSet::flip, "", {.read = true, .mayLack = true}));

template <> inline constexpr auto kRecord<TermFigures> = record<TermFigures>(
    "termLight", "Mean scene-referred luminance over the material's pixels",
    field("term", &TermFigures::term),
    field("reference", &TermFigures::reference),
    field("test", &TermFigures::test));

template <> inline constexpr auto kRecord<PixelFiles> = record<PixelFiles>(
    "pixelFiles", "Files of pixel values, relative to the report's folder; empty: none",
    field("color", &PixelFiles::color,
          "Both paths, FLIP of the whole images, FLIP of each material by swap, and the material of each pixel"),
    field("terms", &PixelFiles::terms, "Terms of both paths"));

template <> inline constexpr auto kRecord<StageResult> = record<StageResult>(
    "stage",
    "Change that one stage of the test path alone causes in its picture: the reference is the displayed picture "
    "without the stage, the test is the displayed picture with it. It does not change verdicts",
    field("stage", &StageResult::stage, "encoding: storing the colour in the target; textures: compressing them"),
    field("through", &StageResult::through, "Format of the stage: rgba8-gamma2, astc6x6"),
    field("figures", &StageResult::figures, "null: no pixel", {.ifEmpty = IfEmpty::null}));

template <> inline constexpr auto kRecord<WhatIf> = record<WhatIf>(
    "whatIf", "What the figures and the verdict of a material would be with another preset of the test path",
    field("preset", &WhatIf::preset, "", {.filled = true}),
    field("words", &WhatIf::words, "All of it in a sentence", {.kept = false}),
    field("verdict", &WhatIf::verdict, "", {.kept = false}),
    field("reason", &WhatIf::reason, "Reason of the verdict; empty for a pass", {.kept = false}),
    field("figures", &WhatIf::figures),
    hidden(&WhatIf::checks, {.kept = false}));
template <> struct Emptiness<std::vector<WhatIf>> {
  static bool isEmpty(const std::vector<WhatIf>& list) { return list.empty(); }
};

template <> inline constexpr auto kRecord<ApproximationEffect> = record<ApproximationEffect>(
    "approximationEffect", "",
    field("approximation", &ApproximationEffect::approximation, "Approximation of the test path", {.filled = true}),
    field("change", &ApproximationEffect::change, "Change to a nearer form: sky-sh=9", {.filled = true}),
    field("alone", &ApproximationEffect::alone, "Mean FLIP that the change takes off by itself", {.finite = true}),
    field("share", &ApproximationEffect::share, "The same, averaged over all orders of the changes (Shapley value)", {.finite = true}));

template <> inline constexpr auto kRecord<ExplainedSet> = record<ExplainedSet>(
    "explainedSet", "Changes of the test path, made together",
    field("changes", &ExplainedSet::changes, "Empty: none"),
    field("flip", &ExplainedSet::flip, "Mean FLIP of the material", {.finite = true, .least = 0, .most = 1}),
    field("operations", &ExplainedSet::operations, "Scalar operations of a pixel"),
    field("fetches", &ExplainedSet::fetches, "Texture fetches of a pixel"));

template <> inline constexpr auto kRecord<ErrorRange> = record<ErrorRange>(
    "errorRange", "",
    field("quantity", &ErrorRange::quantity, "", {.oneOf = "roughness|metallic|N.V"}),
    field("from", &ErrorRange::from, "", {.finite = true}),
    field("to", &ErrorRange::to, "", {.finite = true}),
    field("pixels", &ErrorRange::pixels, "Share of the material's pixels", {.finite = true, .least = 0, .most = 1}),
    field("flip", &ErrorRange::flip, "Share of the material's FLIP", {.finite = true, .least = 0, .most = 1}));

template <> inline constexpr auto kRecord<ErrorMask> = record<ErrorMask>(
    "errorMask", "Where on a texture half of the material's FLIP lies",
    field("input", &ErrorMask::input, "Input of the material's card, whose texture the picture covers", {.filled = true}),
    field("picture", &ErrorMask::picture, "Relative to the report's folder; transparent where the other half lies", {.filled = true}),
    field("texels", &ErrorMask::texels, "Share of the seen texels that hold this half", {.finite = true, .least = 0, .most = 1}));

template <> inline constexpr auto kRecord<Explanation> = record<Explanation>(
    "explanation", "Approximations of the test path that make the material differ, and what would help",
    field("words", &Explanation::words, "The largest approximation and the advice, in a line"),
    field("failure", &Explanation::failure, "Reason why there is no explanation; absent: there is one", {.ifEmpty = IfEmpty::absent}),
    field("advice", &Explanation::advice, "Sentences; what they say was rendered"),
    field("approximations", &Explanation::approximations, "The largest share first"),
    field("sets", &Explanation::sets, "The best set of each size, that of no change first"),
    field("advised", &Explanation::advised, "Place in 'sets'; 0: none"),
    field("picture", &Explanation::picture,
          "Crop of the test picture with the advised set, relative to the report's folder; empty: none"),
    field("ranges", &Explanation::ranges, "Tenths of each quantity that hold pixels"),
    field("masks", &Explanation::masks));

template <> inline constexpr auto kRecord<CardTexture> = record<CardTexture>(
    "cardTexture",
    "Texture of an input. least, most and mean: of each channel over the texels, times the factor, colours linear; empty: not "
    "decoded, or a normal map",
    field("name", &CardTexture::name),
    field("file", &CardTexture::file, "Empty: within the scene's own file, or made by the program"),
    field("channels", &CardTexture::channels, "Channels that the input reads", {.oneOf = "rgb|r|g|b|a"}),
    field("width", &CardTexture::width, "0: not decoded, because no mesh shows the material", {.least = 0}),
    field("height", &CardTexture::height, "", {.least = 0}),
    field("texCoord", &CardTexture::texCoord, "Number of the set of texture coordinates", {.least = 0}),
    field("picture", &CardTexture::picture, "A small picture of these channels, relative to the report's folder; empty: none"),
    field("least", &CardTexture::least, "", {.finite = true}),
    field("most", &CardTexture::most, "", {.finite = true}),
    field("mean", &CardTexture::mean, "", {.finite = true}));

template <> inline constexpr auto kRecord<CardInput> = record<CardInput>(
    "cardInput", "",
    field("name", &CardInput::name, "", {.oneOf = kCardInputs}),
    field("value", &CardInput::value, "Linear colour or number; the factor if there is a texture", {.finite = true}),
    field("texture", &CardInput::texture, "absent: none"));

template <> inline constexpr auto kRecord<MaterialCard> = record<MaterialCard>(
    "materialCard", "What a material is made of",
    field("name", &MaterialCard::name),
    field("inputs", &MaterialCard::inputs,
          "Base colour, metallic and roughness; other inputs only if they differ from glTF's default"),
    field("alphaMode", &MaterialCard::alphaMode, "", {.oneOf = "opaque|mask|blend"}),
    field("alphaCutoff", &MaterialCard::alphaCutoff, "Only of a mask", {.finite = true}),
    field("doubleSided", &MaterialCard::doubleSided),
    field("unlit", &MaterialCard::unlit),
    field("nonmetal", &MaterialCard::nonmetal, "Found: metallic is 0 everywhere and F0 is 0.04"),
    field("fullyRough", &MaterialCard::fullyRough, "As requested"),
    field("vertexColors", &MaterialCard::vertexColors, "Colours of vertices multiply base colour and opacity"),
    field("f0", &MaterialCard::f0, "Reflectance at normal incidence of a dielectric, before textures", {.finite = true}),
    field("notModelled", &MaterialCard::notModelled, "Parts that no path models"));
template <> struct Emptiness<std::vector<MaterialCard>> {
  static bool isEmpty(const std::vector<MaterialCard>& list) { return list.empty(); }
};

template <> inline constexpr auto kRecord<DroppedLobe> = record<DroppedLobe>(
    "droppedLobe", "",
    field("lobe", &DroppedLobe::lobe, "", {.oneOf = "clear coat|sheen|anisotropy|iridescence|transmission|diffuse transmission"}),
    field("flip", &DroppedLobe::flip,
          "Mean FLIP of the reference's picture without this lobe of the material against its picture with it",
          {.finite = true, .least = 0, .most = 1}));

template <> inline constexpr auto kRecord<MaterialResult> = record<MaterialResult>(
    "material", "",
    field("name", &MaterialResult::name, "", {.read = true}),
    hidden(&MaterialResult::test),
    field("verdict", &MaterialResult::verdict, "", {.kept = false, .read = true}),
    field("reason", &MaterialResult::reason, "Reason of the verdict; empty for a pass",
          {.kept = false, .read = true, .mayLack = true}),
    field("accepted", &MaterialResult::accepted,
          "What its budget or an approval accepts although it is no pass, with the reason; absent: nothing",
          {.kept = false, .ifEmpty = IfEmpty::absent}),
    field("seenElsewhere", &MaterialResult::seenElsewhere,
          "Not seen or too small in this view, but seen in another view; the row does not count", {.kept = false}),
    computed("bias", [](const MaterialResult& material) { return biasOf(material.figures, material.test); },
             "Difference of light and tint in words; empty without pixels"),
    field("figures", &MaterialResult::figures, "null: no pixel",
          {.read = true, .ifEmpty = IfEmpty::null}),
    field("checks", &MaterialResult::checks, "Empty if the material is not seen", {.kept = false, .readDeep = true}),
    field("budget", &MaterialResult::rule, "", {.kept = false}),
    field("baseline", &MaterialResult::baseline, "null: there is no baseline",
          {.kept = false, .ifEmpty = IfEmpty::null}),
    field("notModelled", &MaterialResult::notModelled,
          "Parts that no path models; then only the base layer is judged, and the verdict is at least warn",
          {.read = true, .mayLack = true}),
    field("notes", &MaterialResult::notes, "Permutation, sampler excess, tinted F0, ..."),
    field("external", &MaterialResult::isExternal,
          "A picture of another engine takes part, so no terms and no cause are known; absent: no", {.ifEmpty = IfEmpty::absent}),
    field("terms", &MaterialResult::terms),
    field("crops", &MaterialResult::crops, "", {.read = true, .mayLack = true}),
    field("truth", &MaterialResult::truth, "", {.read = true, .mayLack = true}),
    field("stages", &MaterialResult::stages),
    field("droppedLobes", &MaterialResult::droppedLobes,
          "Lobes of the material that the test path leaves out; absent: none, or not requested (--dropped-lights 0)",
          {.ifEmpty = IfEmpty::absent}),
    field("whatIf", &MaterialResult::whatIf, "Only with --what-if", {.ifEmpty = IfEmpty::absent}),
    field("explanation", &MaterialResult::explanation, "Only of materials over budget, with --explain over-budget",
          {.ifEmpty = IfEmpty::absent}),
    field("attribution", &MaterialResult::attribution));

template <> inline constexpr auto kRecord<LightEffect> = record<LightEffect>(
    "lightEffect", "",
    field("name", &LightEffect::material),
    field("flip", &LightEffect::flip,
          "Mean FLIP of the reference's picture without this light against its picture with all lights",
          {.finite = true, .least = 0, .most = 1}));

template <> inline constexpr auto kRecord<DroppedLight> = record<DroppedLight>(
    "droppedLight", "",
    field("name", &DroppedLight::name),
    field("kind", &DroppedLight::kind, "", {.oneOf = "directional|point|spot"}),
    field("keptBy", &DroppedLight::keptBy, "Number of visible objects that the test path shades with this light"),
    field("droppedBy", &DroppedLight::droppedBy,
          "Number of visible objects that this light reaches and that the test path shades without it", {.least = 1}),
    field("materials", &DroppedLight::materials, "Materials of the objects that drop the light, the largest change first"));

template <> inline constexpr auto kRecord<DroppedLights> = record<DroppedLights>(
    "droppedLights",
    "Lights that the test path drops for visible objects; absent: none, or not requested. They do not change verdicts",
    field("lights", &DroppedLights::lights, "Number of lights that reach visible objects, dropped or not", {.least = 1}),
    field("measured", &DroppedLights::measured, "The largest effect first"),
    field("notMeasured", &DroppedLights::notMeasured,
          "Names of dropped lights that were not measured (--dropped-lights), the largest estimated effect first"));

template <> inline constexpr auto kRecord<ViewResult> = record<ViewResult>(
    "view", "",
    field("name", &ViewResult::name, "", {.read = true}),
    field("reference", &ViewResult::reference, "The reference path of the figures"),
    field("test", &ViewResult::test, "The test path of the figures"),
    field("width", &ViewResult::width, "", {.least = 1}),
    field("height", &ViewResult::height, "", {.least = 1}),
    field("conditions", &ViewResult::conditions, "Conditions of the view: its camera", {.kept = false, .read = true}),
    field("verdict", &ViewResult::verdict, "", {.kept = false, .read = true}),
    group("whole", "All pixels that show a material",
        field("verdict", &ViewResult::wholeVerdict, "", {.kept = false, .read = true}),
        field("reason", &ViewResult::reason, "Reason of the verdict; empty for a pass",
              {.kept = false, .read = true, .mayLack = true}),
        field("accepted", &ViewResult::accepted,
              "What its budget or an approval accepts although it is no pass, with the reason; absent: nothing",
              {.kept = false, .ifEmpty = IfEmpty::absent}),
        computed("bias", [](const ViewResult& view) { return biasOf(view.whole, view.test); },
                 "Difference of light and tint in words; empty without pixels"),
        field("figures", &ViewResult::whole, "null: no pixel",
              {.read = true, .ifEmpty = IfEmpty::null}),
        field("checks", &ViewResult::checks, "", {.kept = false, .readDeep = true}),
        field("budget", &ViewResult::rule, "", {.kept = false}),
        field("baseline", &ViewResult::baseline, "null: there is no baseline",
              {.kept = false, .ifEmpty = IfEmpty::null}),
        field("truth", &ViewResult::truth, "", {.read = true, .mayLack = true}),
        field("stages", &ViewResult::stages)),
    field("materials", &ViewResult::materials, "In the order of the scene", {.read = true}),
    field("images", &ViewResult::images, "", {.read = true, .mayLack = true}),
    field("exposureEv", &ViewResult::exposureEv, "Exposure of the pictures; apply it to the values of 'pixels'",
          {.finite = true}),
    field("pixels", &ViewResult::pixels),
    field("droppedLights", &ViewResult::droppedLights));

template <> inline constexpr auto kRecord<PassResult> = record<PassResult>(
    "pass", "",
    field("name", &PassResult::name),
    field("count", &PassResult::count, "Number of units; work from a cache counts as done"),
    field("unit", &PassResult::unit),
    field("skipped", &PassResult::skipped, "Reason why nothing was done; null if count is not 0",
          {.ifEmpty = IfEmpty::null}));

template <> inline constexpr auto kRecord<PermutationCost> = record<PermutationCost>(
    "permutationCost", "Largest cost of a pixel, counted from SPIR-V; only with --costs",
    field("fp32", &PermutationCost::fp32, "Scalar operations on 32-bit reals"),
    field("fp16", &PermutationCost::fp16, "Scalar operations on 16-bit reals"),
    field("integer", &PermutationCost::integer, "Scalar operations on integers and booleans"),
    field("fetches", &PermutationCost::fetches, "Texture reads"),
    field("openLoops", &PermutationCost::openLoops,
          "Number of loops with unknown iteration count; their bodies count once"));

template <> inline constexpr auto kRecord<PermutationResult> = record<PermutationResult>(
    "permutation", "",
    field("path", &PermutationResult::path),
    field("textures", &PermutationResult::textures, "Textures that it reads, or 'none'"),
    field("features", &PermutationResult::features, "Features of its materials, or 'none'"),
    field("pixels", &PermutationResult::pixels, "Number of surface samples that it shaded, in all views"),
    field("samplers", &PermutationResult::samplers,
          "Number of samplers that it binds: textures of its materials, and other inputs of the path"),
    field("cost", &PermutationResult::cost));

template <> inline constexpr auto kRecord<SceneInputs> = record<SceneInputs>(
    "sceneInputs",
    "What decides the figures besides the settings of the run, as digests of 12 hexadecimal digits: equal content, equal digest",
    field("asset", &SceneInputs::asset, "The scene's file, its buffers and its images", {.read = true}),
    field("environment", &SceneInputs::environment, "Empty: none", {.read = true}),
    field("request", &SceneInputs::request, "What is asked of the scene otherwise than of the run, and its views", {.read = true}),
    field("bake", &SceneInputs::bake, "Its baked light; empty: none", {.read = true}),
    field("pictures", &SceneInputs::pictures, "Pictures of other engines; absent: none", {.read = true, .ifEmpty = IfEmpty::absent}));

// Scenes with an error are not kept; the conditions are in the archive's key.
template <> inline constexpr auto kRecord<SceneResult> = record<SceneResult>(
    "scene", "",
    field("name", &SceneResult::name, "", {.read = true}),
    field("source", &SceneResult::source, "The file as named in the command or suite, or builtin:NAME"),
    field("environment", &SceneResult::environment, "Name, or 'none'", {.read = true}),
    field("sun", &SceneResult::sun, "In words, or 'none'", {.read = true}),
    field("light", &SceneResult::light, "Scales of light, and fog, in words; absent: the defaults",
          {.read = true, .ifEmpty = IfEmpty::absent}),
    field("conditions", &SceneResult::conditions, "Conditions of the scene: its light, the shown part of the file, ...",
          {.kept = false, .read = true}),
    field("inputs", &SceneResult::inputs, "Absent: the scene's files could not be read", {.read = true, .mayLack = true}),
    field("verdict", &SceneResult::verdict, "", {.kept = false, .read = true}),
    groupOrNull("error", "Reason why the scene could not be compared; the views hold the part done before. null: it was compared",
                [](const SceneResult& scene) { return scene.error.empty(); },
        field("message", &SceneResult::error, "", {.kept = false, .read = true, .filled = true}),
        field("exitCode", &SceneResult::errorExitCode, "128 and more: a signal ended the run before the scene was done",
              {.kept = false, .least = 3, .most = 255})),
    field("warnings", &SceneResult::warnings),
    field("materials", &SceneResult::materials, "What its materials are made of; absent: not known",
          {.ifEmpty = IfEmpty::absent}),
    field("views", &SceneResult::views, "", {.read = true}),
    field("passes", &SceneResult::passes, "Work done for the scene in all views, and skipped work"),
    field("permutations", &SceneResult::permutations,
          "The specialised shaders of the pictures, by path, in order of their first use"));

template <> inline constexpr auto kRecord<RunDigests> = record<RunDigests>(
    "runDigests", "What decides the figures and verdicts of every scene: digests, in hexadecimal digits",
    field("settings", &RunDigests::settings, "Of scenes that have no settings of their own", {.read = true}),
    field("budgets", &RunDigests::budgets, "Of the text of the budget files; empty: the built-in ones", {.read = true}));

template <> inline constexpr auto kRecord<GoneRow> = record<GoneRow>(
    "goneRow", "",
    field("scene", &GoneRow::scene),
    field("view", &GoneRow::view, "Empty: the whole scene is gone"),
    field("material", &GoneRow::material, "Empty: the whole view is gone"));

template <> inline constexpr auto kRecord<BaselineSummary> = record<BaselineSummary>(
    "baseline", "",
    field("source", &BaselineSummary::source, "The file as given; without its folder if the path is absolute"),
    field("version", &BaselineSummary::version, "Version of the program that made it"),
    field("device", &BaselineSummary::device),
    field("common", &BaselineSummary::common, "Number of material views in both reports"),
    field("notComparable", &BaselineSummary::notComparable,
          "Number of material views and whole images in both reports with different conditions; at least a warning"),
    field("gone", &BaselineSummary::gone, "Rows of the baseline that this run does not have; at least a warning"),
    field("error", &BaselineSummary::error, "Reason why it could not be used (then the verdict is 'error'); empty: it was used"),
    field("notWhole", &BaselineSummary::notWhole,
          "Why nobody can tell by it which failures are new: it is of a part of the scenes, or lacks results; absent: it is whole",
          {.ifEmpty = IfEmpty::absent}));

template <> inline constexpr auto kRecord<ApprovalSummary> = record<ApprovalSummary>(
    "approvals", "",
    field("source", &ApprovalSummary::source, "The file as given; without its folder if the path is absolute"),
    field("asOf", &ApprovalSummary::asOf, "The day of the run for approvals, ISO 8601"),
    field("entries", &ApprovalSummary::entries, "", {.least = 1}));

template <> inline constexpr auto kRecord<RunProblem> = record<RunProblem>(
    "problem", "",
    field("verdict", &RunProblem::verdict, "", {.oneOf = "fail|error"}),
    field("reason", &RunProblem::reason),
    hidden(&RunProblem::file),
    hidden(&RunProblem::line));

template <> inline constexpr auto kRecord<VerdictCounts> = record<VerdictCounts>(
    "counts",
    "counts: rows (material x view) by verdict, without materials that only another view shows; wholeCounts: whole images",
    field("pass", &VerdictCounts::pass),
    field("notSeen", &VerdictCounts::notSeen),
    field("tooSmall", &VerdictCounts::tooSmall),
    field("notJudged", &VerdictCounts::notJudged),
    field("warn", &VerdictCounts::warn),
    field("fail", &VerdictCounts::fail),
    field("error", &VerdictCounts::error));

template <> inline constexpr auto kRecord<FigureWords> = record<FigureWords>(
    "statistic", "",
    field("label", &FigureWords::label, "Name in a sentence"),
    field("unit", &FigureWords::unit, "%: a share, which is 0 to 1 in this file"),
    field("digits", &FigureWords::digits, "Digits after the point for display"),
    field("better", &FigureWords::better, "", {.oneOf = "lower|higher|near zero"}));

using Setting = std::pair<std::string, std::string>;
template <> inline constexpr auto kRecord<Setting> = record<Setting>(
    "setting", "",
    field("name", &Setting::first, "", {.read = true}),
    field("value", &Setting::second, "", {.read = true}));

using Timing = std::pair<std::string, double>;
template <> inline constexpr auto kRecord<Timing> = record<Timing>(
    "timing", "",
    field("stage", &Timing::first, "", {.read = true}),
    field("timeMs", &Timing::second, "", {.read = true}));

using Schema = std::integral_constant<int, kReportSchema>;

template <> inline constexpr auto kRecord<Report> = record<Report>(
    "report",
    "Visible difference of two shading paths, per material. Equal inputs give a byte-identical file; times and dates are "
    "in run.json. null in place of a number means infinite (psnr of identical images) or not a number (then the "
    "verdict is 'error').",
    computed("schema", [](const Report&) { return Schema(); }, "Version of this format"),
    field("tool", &Report::tool),
    field("version", &Report::version, "", {.read = true}),
    field("suite", &Report::suite, "Name of the suite; empty: the run had none", {.read = true, .mayLack = true}),
    field("device", &Report::device, "Vulkan device name and driver", {.read = true}),
    field("verdict", &Report::verdict, "", {.read = true}),
    computed("headline", [](const Report& report) { return headline(report); }, "The whole report in a sentence"),
    computed("counts", [](const Report& report) { return countVerdicts(report); }),
    computed("wholeCounts", [](const Report& report) { return countWholes(report); }),
    field("displayTable", &Report::displayTable,
          "File of the display transform as a table, relative to the report's folder; empty: none"),
    shown("problems", &Report::lost, [](const Report& report) { return problemsOf(report); },
          "Reasons why the whole run does not pass: no material was compared, or a material that a budget requires is missing"),
    field("warnings", &Report::warnings, "Warnings about the whole run"),
    field("baseline", &Report::baseline, "The earlier report that this run was compared with",
          {.ifEmpty = IfEmpty::null}),
    field("approvals", &Report::approvals, "The approvals that the run was judged by (--approvals); absent: it had none"),
    field("only", &Report::only, "Globs of the views that were asked for (--only); absent: all",
          {.read = true, .ifEmpty = IfEmpty::absent}),
    field("settings", &Report::settings, "Settings of the run, in a fixed order", {.read = true}),
    field("conditions", &Report::conditions, "Conditions of every scene; the device is one more condition", {.read = true}),
    field("digests", &Report::digests, "", {.read = true, .mayLack = true}),
    computed("statistics", [](const Report& report) { return figureWordsOf(report); },
             "Label, unit and digits of each figure in 'metrics' and 'checks', by its name"),
    field("scenes", &Report::scenes, "", {.read = true}));

template <> inline constexpr auto kRecord<AgainCommand> = record<AgainCommand>(
    "againCommand", "A command line that compares one view again and prints its rows",
    field("scene", &AgainCommand::scene),
    field("view", &AgainCommand::view),
    field("command", &AgainCommand::command, "For a POSIX shell; --material GLOB chooses a material"));

template <> inline constexpr auto kRecord<SceneTime> = record<SceneTime>(
    "sceneTime", "Wall time of a scene, from its file or the cache to its figures and pictures",
    field("scene", &SceneTime::scene, "", {.read = true}),
    field("seconds", &SceneTime::seconds, "", {.read = true, .finite = true, .least = 0}),
    field("cpuSeconds", &SceneTime::cpuSeconds,
          "CPU time of all threads; 0: not known, because several scenes ran at a time in one process",
          {.read = true, .mayLack = true, .finite = true, .least = 0}),
    field("machine", &SceneTime::machine, "Processor; absent: that of 'origin'",
          {.read = true, .ifEmpty = IfEmpty::absent}));

template <> inline constexpr auto kRecord<RunOrigin> = record<RunOrigin>(
    "origin", "What made the run",
    field("build", &RunOrigin::build, "Hash of the program", {.read = true}),
    field("driver", &RunOrigin::driver, "Driver of the device, with its version", {.read = true}),
    field("numerics", &RunOrigin::numerics, "Numerics id: how the machine rounds; empty: not known", {.read = true}),
    field("machine", &RunOrigin::machine, "Name of the processor; empty: not known", {.read = true}),
    field("whole", &RunOrigin::isWhole, "false: with --only or --material", {.read = true}),
    field("complete", &RunOrigin::isComplete, "false: a scene was not run, or has no result", {.read = true}),
    field("cpuSeconds", &RunOrigin::cpuSeconds, "CPU time of this process and of its workers, all threads",
          {.read = true, .finite = true, .least = 0}));

template <> inline constexpr auto kRecord<RunInfo> = record<RunInfo>(
    "run", "Data that differs from run to run, so that it is not in the report",
    computed("schema", [](const RunInfo&) { return Schema(); }),
    field("startedAt", &RunInfo::startedAt, "ISO 8601, UTC", {.read = true}),
    field("commandLine", &RunInfo::commandLine),
    field("timings", &RunInfo::timings, "", {.read = true, .mayLack = true}),
    field("compiledShaders", &RunInfo::compiledShaders, "Shaders of all paths; equal shaders count once"),
    field("cachedScenes", &RunInfo::cachedScenes, "Scenes whose unchanged results came from the cache", {.read = true}),
    field("again", &RunInfo::again, "For each view that was asked for"),
    field("incidents", &RunInfo::incidents, "Crashes of workers after which a second try succeeded",
          {.read = true, .mayLack = true}),
    field("sceneTimes", &RunInfo::sceneTimes, "Of each scene that was done; several scenes may run at a time",
          {.read = true, .mayLack = true}),
    field("warningsFail", &RunInfo::warningsFail,
          "true: a warning alone makes the exit code 1 (--warn-exit), and its case in junit.xml fails"),
    field("origin", &RunInfo::origin, "", {.read = true, .mayLack = true}));

// clang-format on

template <> inline constexpr bool kIsOfScenes<std::vector<SceneResult> Report::*> = true;
template <> inline constexpr bool kIsOfScenes<std::vector<AgainCommand> RunInfo::*> = true;

} // namespace parity::report

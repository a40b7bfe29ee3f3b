// Figures in words: the bias that artists ask for first, checks with the limit that decided, numbers with their units.
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "compare/verdict/wording.h"
#include "report/dropped_lobes.h"
#include "report/sample_report.h"
#include "report/term_words.h"
#include "report/wording.h"
#include "shading/terms.h"

namespace parity::report {
namespace {

std::string describe(double ev, double lightness, double red, double yellow) {
  compare::Figures figures = makeFigures(0.1, 4000, 0.8);
  for (const auto& [name, value] :
       {std::pair{"bias.ev", ev}, {"bias.dl", lightness}, {"bias.da", red}, {"bias.db", yellow}})
    setFigure(figures, name, value);
  return compare::describeBias(figures, "mobile");
}

TEST(Wording, BiasIsSaidAsArtistsSayIt) {
  EXPECT_EQ(describe(-0.3, -5, 0.2, 2.5), "mobile is 0.3 EV darker and warmer");
  EXPECT_EQ(describe(1.24, 9, -3, -2), "mobile is 1.2 EV brighter, cooler and greener");
  EXPECT_EQ(describe(0, 0, 1, 0), "mobile is redder");
  EXPECT_EQ(describe(0, 0, 0, -1.5), "mobile is cooler");
  EXPECT_EQ(describe(0.02, -1.6, 0, 0), "mobile is 2 L* darker") << "light hides a difference that is seen";
}

TEST(Wording, BiasThatNobodySeesIsNotSaid) {
  EXPECT_EQ(describe(0.049, 0.9, 0.9, -0.9), "same brightness and tint on average");
  EXPECT_EQ(describe(0.05, 0, 0, 0), "mobile is 0.05 EV brighter");
  EXPECT_EQ(describe(-0.05, 0, 0.99, 1), "mobile is 0.05 EV darker and warmer");
}

TEST(Wording, BiasNamesTheTestAsTold) {
  EXPECT_EQ(compare::describeBias(makeFigures(0.1, 4000, 0.8), "b.png"), "b.png is 0.3 EV darker");
}

TEST(Wording, WithoutBiasTheLumaIsSaid) {
  const auto say = [](double reference, double test) {
    compare::Figures figures;
    figures.referenceLuma = reference;
    figures.testLuma = test;
    return compare::describeBias(figures, "mobile");
  };
  EXPECT_EQ(say(0.5, 0.4), "mobile is 20.0 % darker");
  EXPECT_EQ(say(0.4, 0.5), "mobile is 25.0 % brighter");
  EXPECT_EQ(say(0.4, 0.4001), "same brightness on average");
  EXPECT_EQ(say(0, 0), "both are nearly black on average") << "not known of each pixel";
  EXPECT_EQ(say(0, 0.5), "the reference is nearly black");
}

TEST(Wording, BlackIsSaidOnlyWhereTheLightIsTheSameToo) {
  compare::Figures figures = makeFigures(0, 4000);
  setFigure(figures, "bias.ev", 0);
  figures.referenceLuma = figures.testLuma = 0;
  figures.clippedBlack = 1;
  EXPECT_EQ(compare::describeBias(figures, "mobile"), "both are black");
  setFigure(figures, "bias.ev", -2);
  EXPECT_EQ(compare::describeBias(figures, "mobile"), "mobile is 2.0 EV darker") << "below what the display shows";
}

// The means of a few bright pixels among many black ones round to black: the words must not deny the pixels.
TEST(Wording, BlackIsSaidOnlyWhereEveryPixelIs) {
  compare::Figures figures = makeFigures(0, 1000000, 1);
  figures.clippedWhite = 0;
  figures.referenceLuma = figures.testLuma = 1e-6;
  for (const double black : {0.0, 0.5, 0.999999, std::nextafter(1.0, 0)}) {
    figures.clippedBlack = black;
    EXPECT_EQ(compare::describeBias(figures, "mobile"), "both are nearly black on average") << black;
  }
  figures.clippedBlack = 1;
  EXPECT_EQ(compare::describeBias(figures, "mobile"), "both are black");
  figures.testLuma = 0.5 / 255;
  EXPECT_EQ(compare::describeBias(figures, "mobile"), "the reference is nearly black") << "the other one is not";
}

TEST(Wording, ClippingIsSaidWithWhatWouldHelp) {
  const auto say = [](double black, double white) {
    compare::Figures figures = makeFigures(0.1, 4000);
    figures.clippedBlack = black;
    figures.clippedWhite = white;
    return compare::describeClipping(figures);
  };
  EXPECT_EQ(say(0, 0), "");
  EXPECT_EQ(say(0.02, 0.029), "");
  EXPECT_EQ(say(0, 0.12), "12.0 % of the pixels are white in both pictures; lower --exposure");
  EXPECT_EQ(say(0.05, 0), "5.0 % of the pixels are black in both pictures; raise --exposure");
  EXPECT_EQ(say(1, 0), "100.0 % of the pixels are black in both pictures; raise --exposure");
  EXPECT_EQ(
      say(0.1, 0.03),
      "10.0 % of the pixels are black in both pictures and 3.0 % are white; a higher --exposure shows more of them");
  EXPECT_EQ(
      say(0.03, 0.1),
      "3.0 % of the pixels are black in both pictures and 10.0 % are white; a lower --exposure shows more of them");
  EXPECT_EQ(say(0.0004, 0.229), "22.9 % of the pixels are white in both pictures; lower --exposure");
  EXPECT_EQ(compare::describeClipping(compare::Figures{}), "") << "of nothing";
  compare::Figures unlit = makeFigures(0, 4000);
  unlit.clippedBlack = 1;
  unlit.referenceLuminance = unlit.testLuminance = 0;
  EXPECT_EQ(compare::describeClipping(unlit),
            "all pixels are black in both pictures, because neither path renders any light there")
      << "no exposure helps";
}

TEST(Wording, FewHighlightsDoNotMakeADarkerImageBrighter) {
  EXPECT_EQ(describe(0.4, -4, 0, 0), "mobile has 0.4 EV more light in total, but is darker on average (dL* -4.0)");
  EXPECT_EQ(describe(-0.4, 4, 1.5, 2),
            "mobile has 0.4 EV less light in total, but is brighter on average (dL* +4.0), warmer and redder");
  EXPECT_EQ(describe(0.4, -0.5, 0, 0),
            "mobile has 0.4 EV more light in total, but is equally bright on average (dL* -0.5)");
}

TEST(Wording, OfNonFinitePixelsNoBiasIsSaid) {
  compare::Figures figures = makeFigures(0.1, 4000, 0.8);
  figures.nonFinite = 1;
  EXPECT_EQ(compare::describeBias(figures, "mobile"), "bias is unknown: some pixels are NaN or infinite");
}

compare::CheckResult checkOf(const char* metric, double value, std::optional<double> warn, double fail,
                             compare::Verdict verdict) {
  compare::CheckResult check;
  check.metric = metric;
  check.value = value;
  check.warnAbove = warn;
  check.failAbove = fail;
  check.verdict = verdict;
  return check;
}

TEST(Wording, ChecksAreSaidWithTheLimitThatDecided) {
  const auto say = [](auto... arguments) { return compare::describeCheck(checkOf(arguments...)); };
  EXPECT_EQ(say("psnr", 30.04, 32, 28, compare::Verdict::warn), "PSNR 30.0 dB is below 32.0 dB");
  EXPECT_EQ(say("flip.p95", 0.6, 0.3, 0.5, compare::Verdict::fail), "95th percentile of FLIP 0.600 is above 0.500");
  EXPECT_EQ(say("rmse", 0.1, std::nullopt, 0.5, compare::Verdict::pass), "RMSE 0.1000 is within 0.5000");
  EXPECT_EQ(say("rmse", NAN, 0.2, 0.5, compare::Verdict::error), "RMSE not a number");
  EXPECT_EQ(say("bias.ev", -0.4, 0.1, 0.3, compare::Verdict::fail),
            "mean exposure difference -0.40 EV is beyond ±0.30 EV");
  EXPECT_EQ(say("bias.ev", -0.05, 0.1, 0.3, compare::Verdict::pass),
            "mean exposure difference -0.05 EV is within ±0.10 EV");
}

TEST(Wording, ACheckThatCouldNotBeJudgedSaysWhyAndHasNoLimit) {
  compare::CheckResult check = checkOf("bias.ev", 0.9, 0.25, 0.5, compare::Verdict::warn);
  check.unjudged = "too dark";
  EXPECT_EQ(compare::describeCheck(check), "mean exposure difference +0.90 EV is not judged: too dark");
}

TEST(Wording, SharesAreSaidAsPercentagesOfThePixels) {
  const auto say = [](auto... arguments) { return compare::describeCheck(checkOf(arguments...)); };
  EXPECT_EQ(say("flip.fraction_over(0.2)", 0.325, std::nullopt, 0, compare::Verdict::fail),
            "32.5 % of the pixels have FLIP over 0.2, more than 0.0 %");
  EXPECT_EQ(say("deltae.fraction_over(2.3)", 0.02, 0.1, 0.2, compare::Verdict::pass),
            "2.0 % of the pixels have CIEDE2000 over 2.3, within 10.0 %");
  EXPECT_EQ(say("flip.fraction_over(0.2)", 0.00004, std::nullopt, 0, compare::Verdict::fail),
            "0.004 % of the pixels have FLIP over 0.2, more than 0.000 %");
  EXPECT_EQ(compare::formatFigure("flip.fraction_over(0.2)", 0.325), "32.5 %");
}

TEST(Wording, AValueBeyondItsLimitNeverReadsAsTheLimit) {
  const auto say = [](auto... arguments) { return compare::describeCheck(checkOf(arguments...)); };
  EXPECT_EQ(say("psnr", 20.88, std::nullopt, 20.9, compare::Verdict::fail), "PSNR 20.88 dB is below 20.90 dB");
  EXPECT_EQ(say("flip.mean", 0.20004, 0.1, 0.2, compare::Verdict::fail), "mean FLIP 0.20004 is above 0.20000");
  EXPECT_EQ(say("flip.mean", std::nextafter(0.2, 1), std::nullopt, 0.2, compare::Verdict::fail),
            "mean FLIP 0.20000000000000004 is above 0.2");
  EXPECT_EQ(say("flip.mean", 0.2, std::nullopt, 0.2, compare::Verdict::pass), "mean FLIP 0.200 is within 0.200");
  compare::CheckResult check = checkOf("flip.mean", 0.0104, std::nullopt, 0.01, compare::Verdict::fail);
  check.regress = true;
  EXPECT_EQ(compare::describeCheck(check), "mean FLIP is 0.0104 worse than in the baseline, above 0.0100");
}

TEST(Wording, ASignedFigureGetsFurtherFromZero) {
  compare::CheckResult check = checkOf("bias.ev", 0.1, std::nullopt, 0.05, compare::Verdict::fail);
  check.regress = true;
  EXPECT_EQ(compare::formatCheckValue(check), "0.10 EV further from 0 than in the baseline");
  check.value = -0.1;
  EXPECT_EQ(compare::formatCheckValue(check), "0.10 EV nearer to 0 than in the baseline");
}

TEST(Wording, RegressionsAreSaidAsChanges) {
  compare::CheckResult check = checkOf("flip.mean", 0.04, 0.01, 0.03, compare::Verdict::fail);
  check.regress = true;
  EXPECT_EQ(compare::describeCheck(check), "mean FLIP is 0.040 worse than in the baseline, above 0.030");
  check.value = -0.01;
  check.verdict = compare::Verdict::pass;
  EXPECT_EQ(compare::describeCheck(check), "mean FLIP is 0.010 better than in the baseline");
  check.value = 0;
  EXPECT_EQ(compare::describeCheck(check), "mean FLIP is as in the baseline");
  check.unjudged = "no baseline";
  EXPECT_EQ(compare::describeCheck(check), "regression of mean FLIP: no baseline");

  check = checkOf("psnr", INFINITY, 1, 3, compare::Verdict::fail);
  check.regress = true;
  EXPECT_EQ(compare::describeCheck(check), "PSNR is no longer identical, above 3.0 dB");
}

TEST(Wording, NumbersCarryTheirUnitAndSign) {
  EXPECT_EQ(compare::formatFigure("flip.mean", 0.1416), "0.142");
  EXPECT_EQ(compare::formatFigure("psnr", 31.42), "31.4 dB");
  EXPECT_EQ(compare::formatFigure("psnr", INFINITY), "identical");
  EXPECT_EQ(compare::formatFigure("rmse", INFINITY), "infinite");
  EXPECT_EQ(compare::formatFigure("bias.ev", 0.314), "+0.31 EV");
  EXPECT_EQ(compare::formatFigure("bias.ev", -0.314), "-0.31 EV");
  EXPECT_EQ(compare::formatFigure("bias.ev", -0.004), "+0.00 EV") << "what rounds to 0 has no sign of its own";
  EXPECT_EQ(compare::formatFigure("rmse", NAN), "not a number");
  EXPECT_EQ(compare::formatChange("flip.mean", 0.0123), "+0.012");
  EXPECT_EQ(compare::formatChange("psnr", -1.44), "-1.4 dB");
  EXPECT_EQ(compare::formatChange("psnr", -INFINITY), "no longer identical");
  EXPECT_EQ(compare::formatChange("flip.mean", -0.0), "+0.000");
}

TEST(Wording, WhatIsGoneIsNamedAsFarAsItIsKnown) {
  EXPECT_EQ(describeGone({"Desk", "front", "Lamp"}),
            "gone: material 'Lamp', scene Desk, view front: in the baseline, but not in this run");
  EXPECT_EQ(describeGone({"Desk", "front", ""}),
            "gone: view front of scene Desk: in the baseline, but not in this run");
  EXPECT_EQ(describeGone({"Desk", "", ""}), "gone: scene Desk: in the baseline, but not in this run");
}

TEST(Wording, ARelMseKeepsTwoDigitsHoweverSmallItIs) {
  EXPECT_EQ(compare::formatRelMse(0.01234), "0.012");
  EXPECT_EQ(compare::formatRelMse(0.0000312), "3.1e-05");
  EXPECT_EQ(compare::formatRelMse(7e-16), "under 1e-06");
  EXPECT_EQ(compare::formatRelMse(0), "0");
  EXPECT_EQ(compare::formatRelMse(NAN), "not known");
}

TEST(Wording, CauseIsTheTermThatExplainsMost) {
  const compare::Attribution sky{0.142, {{"sunSpecular", 0.1}, {"skySpecular", 0.031}, {"emissive", 0.142}}};
  EXPECT_EQ(describeCause(sky, "highend"),
            "skySpecular (reflections of the environment): FLIP 0.142 -> 0.031 with the high-end term");
  const std::string none = "no single term explains it";
  EXPECT_EQ(describeCause({0.2, {{"fog", 0.181}, {"skySpecular", 0.3}}}, "highend"), none);
  EXPECT_EQ(describeCause({0.2, {{"fog", 0.18}}}, "highend"),
            "fog (light of the fog): FLIP 0.200 -> 0.180 with the high-end term");
  EXPECT_EQ(describeCause({0.2, {}}, "highend"), none);
  EXPECT_EQ(describeCause({0.0004, {{"fog", 0}}}, "highend"), "") << "there is nothing to explain";
}

TEST(Wording, EveryTermHasWordsInTheOrderOfShading) {
  ASSERT_EQ(kTermWords.size(), shading::kTermNames.size());
  for (std::size_t i = 0; i < kTermWords.size(); ++i) {
    EXPECT_EQ(kTermWords[i].term, shading::kTermNames[i]);
    EXPECT_FALSE(kTermWords[i].words.empty()) << kTermWords[i].term;
  }
  EXPECT_EQ(termWithWords("emissive"), "emissive (emitted light)");
  EXPECT_EQ(termWithWords("of a later version"), "of a later version");
}

TEST(Wording, DroppedLightsAreNamedByWhatTheyDo) {
  DroppedLights dropped = makeDroppedLights();
  rankByEffect(dropped);
  EXPECT_EQ(describe(dropped, "highend", "mobile"),
            "mobile drops 4 of 5 lights; without 'lamp 2' the high-end picture of 'Glass' changes by "
            "FLIP 0.250, 'Rough metal' by 0.031 without 'lamp 1'; 2 more were not measured "
            "(--dropped-lights)");
  for (int i = 0; i < 4; ++i) dropped.measured.push_back(dropped.measured[0]);
  dropped.notMeasured.resize(1);
  const std::string many = describe(dropped, "highend", "mobile");
  EXPECT_NE(many.find("7 of 5"), std::string::npos);
  std::size_t named = 0;
  for (std::size_t at = many.find("without '"); at != std::string::npos; at = many.find("without '", at + 1)) ++named;
  EXPECT_EQ(named, 3u) << "at most: " << many;
  EXPECT_TRUE(many.ends_with("; 1 more was not measured (--dropped-lights)")) << many;

  dropped = makeDroppedLights();
  for (DroppedLight& light : dropped.measured)
    for (LightEffect& effect : light.materials) effect.flip = 0.0004;
  dropped.notMeasured.clear();
  EXPECT_EQ(describe(dropped, "highend", "mobile"),
            "mobile drops 2 of 5 lights; no measured light changes the high-end picture");
  dropped.measured[0].materials.clear(); // all of it is see-through
  rankByEffect(dropped);
  EXPECT_EQ(dropped.measured[0].name, "lamp 2");
}

TEST(Wording, DroppedLightsAndTheirMaterialsAreRankedAndEqualOnesKeepTheirOrder) {
  DroppedLights dropped = makeDroppedLights();
  dropped.measured.push_back(dropped.measured[1]);
  dropped.measured[2].name = "as much as lamp 2";
  rankByEffect(dropped);
  EXPECT_EQ(dropped.measured[0].name, "lamp 2");
  EXPECT_EQ(dropped.measured[1].name, "as much as lamp 2");
  EXPECT_EQ(dropped.measured[2].materials[0].material, "Rough metal");
  EXPECT_EQ(dropped.measured[2].materials[1].material, "Glass");
}

TEST(Wording, DroppedLobesAreNamedWithWhatTheyAreWorth) {
  MaterialResult material;
  material.droppedLobes = {{"sheen", 0.4874}};
  EXPECT_EQ(describeDroppedLobes(material, "highend", "mobile"),
            "mobile drops the sheen (FLIP 0.487 of the high-end picture without it)");
  material.droppedLobes = {{"clear coat", 0.043}, {"sheen", 0.12}};
  EXPECT_EQ(describeDroppedLobes(material, "highend", "mobile"),
            "mobile drops the clear coat (FLIP 0.043 of the high-end picture without it) and the sheen (0.120)");
}

} // namespace
} // namespace parity::report

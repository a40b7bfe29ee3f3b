// A report with one of everything: each verdict, several views, a broken scene, notes, terms; for the report tests.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace parity::report {

// Figures whose every number differs, so that a swapped field shows. mean: FLIP; gain: test / reference, of luma and
// light. No clipping to speak of. Empty where there are no pixels.
compare::Figures makeFigures(double mean, std::uint64_t pixels, double gain = 0.95);

// Sets a figure, which is added where it is not measured yet.
void setFigure(compare::Figures& figures, const std::string& name, double value);

// Not judged yet.
MaterialResult makeMaterial(const std::string& name, double mean, std::uint64_t pixels, double gain = 0.95);

// Judged by the built-in budgets and settled. Material and scene names come from `names`, in order, for as long as
// there are any; then harmless ones.
Report makeSampleReport(const std::vector<std::string>& names = {});
// The same, held against an earlier run: Rough metal was at 0.20, Bulb is new, `gone` is gone from the view in front, a
// regression of Shade is judged and one of Bulb is not, and the view from behind had another field of view.
Report makeSampleReportSince(const std::vector<std::string>& names = {}, const std::string& gone = "Old lamp");
// The same, with a truth of the first scene's views and of each material that they show: high-end is at a third, mobile
// at all of the FLIP between the two. The truth of Glass is as noisy as high-end's difference to it; that of Rough
// metal has the terms sunSpecular and skySpecular.
Report makeSampleReportWithTruth(const std::vector<std::string>& names = {});
RunInfo makeSampleRun();

// A mask, whose roughness has a texture of that name.
MaterialCard makeCard(const std::string& material, const std::string& texture);
WhatIf makeWhatIf(const std::string& preset, double mean);

// Four of five lights, of which two were measured over these two materials; not ranked yet: the other one of each two
// does more.
DroppedLights makeDroppedLights(const std::string& light = "lamp", const std::string& material = "Glass",
                                const std::string& more = "Rough metal");

// Names that break naive writers: markup, quotes, URLs, controls, invalid UTF-8, text direction.
std::vector<std::string> hostileNames();

} // namespace parity::report

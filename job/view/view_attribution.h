// Which materials' terms are to be swapped, and the swapping: which term makes a material differ.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/verdict/budget.h"
#include "job/conditions.h"
#include "job/context.h"
#include "job/scene/scene_renderer.h"
#include "job/view/view_comparison.h"
#include "report/report.h"

namespace parity::job {

// What a view's materials are judged by.
struct Judges {
  const compare::Budgets& budgets;
  const report::Report* baseline = nullptr; // for the budgets' regressions; null: none
  std::string scene;
  const Conditions& conditions; // of the run and the scene: of others the baseline's figures are not comparable
  std::string device;
};

// The places in view.materials of those to attribute, of those that show a pixel: all, or those that are over budget
// (also by a regression since the baseline) or without a verdict. view: need not be judged, but has its
// conditions.
std::vector<std::size_t> materialsToAttribute(Attribution wanted, const report::ViewResult& view, const Judges& judges);

// Sets the attribution of those materials of compared.view, and the terms' figures of all where they are missing.
// frames: with their terms, as compareView was given them or since shaded again; path: the one that was compared.
void attributeView(Context& context, const ViewFrames& frames, const std::vector<std::size_t>& materials,
                   const Settings& settings, const paths::Path& path, ComparedView& compared);

// The pass that the report lists: how many terms were swapped, one count a view and term, or why none was.
report::PassResult attributionPass(Attribution wanted, const report::SceneResult& result);

} // namespace parity::job

// What each number means, in one sentence, behind a "?" beside it.
import { html, type TemplateResult } from "lit";

export const kHelp = {
  flip: "FLIP measures how different two pictures look if you flip between them. 0: identical, 1: largest difference. 0.1 is 10 % more or less light, visible side by side. 0.2 is visible at a glance.",
  materialFlip: "FLIP of a material compares the reference path's picture with a copy in which only this material has the test path's colours. Differences of neighbours and of surfaces behind the material do not count.",
  wholeFlip: "FLIP of a whole view compares the pictures of the two paths, over all pixels that show a material.",
  mean: "The mean of FLIP over the pixels of the material, weighted by its coverage of each pixel. Budgets usually limit this figure.",
  p95: "5 % of the pixels are worse than this value.",
  max: "The worst pixel.",
  pixels: "Number of pixels in the view that show the material, fully or partly. A material with fewer pixels than min_pixels of its budget is too small to be judged.",
  clipping: "These pixels are black in both pictures or white in both, so they show no difference. Compare at another --exposure. 5 % or more is a warning. A material with more than half of its pixels clipped is not judged, unless it fails.",
  baseLayer: "No path models these parts of the material. Only the base layer below them is compared, so the material never simply passes.",
  bias: "Average difference of the test path from the reference path: darker or brighter, and the change of tint.",
  worstTerm: "The likely cause: the term of light that lowers the FLIP of this material most if it comes from the reference path.",
  attribution: "Mean FLIP if the test path takes only this term from the reference path and keeps all others.",
  droppedLights: "The mobile path shades each object with one sun and at most four local lights. FLIP here compares the reference path's picture without the light with its picture with all lights. It shows the effect of the light, not the error of the test path.",
  droppedLobes: "The mobile path leaves this part of the material out. FLIP here compares the reference path's picture without it with its picture with it. It shows the effect of the part, not the error of the test path.",
  termLight: "Mean light of this term over the material, for each path, in the units of the scene.",
  budget: "The value and its limits: the first mark is the limit that warns, the second is the limit that fails.",
  baseline: "The change since the earlier report, the baseline of this run.",
  exposure: "Brightens or darkens both pictures before display, from their unclipped values. Use it to look at highlights and shadows. It does not change the verdict.",
  threshold: "Pixels with FLIP below this value appear grey, as identical.",
  gain: "Factor by which the difference of the displayed pictures is enlarged. Grey: no difference.",
  histogram: "Number of pixels for each value of FLIP. The line is the budget of the mean. For a material, every pixel counts that the material covers most, with the material's own FLIP. For a whole view, every pixel counts that shows a material.",
  inspector: "The values of one pixel: linear (as shaded), display (as on screen), and each term of light. FLIP is the value of the FLIP map. For a material, it is the own FLIP of the material that covers the pixel most.",
  linear: "Scene-referred light before exposure and display transform, Rec.709 primaries.",
  display: "The value that goes to the screen, 0 to 255.",
  truth: "The ground truth: exact integrals of the same material and light. For a material, the truth is compared with a copy in which only this material has the colours of the path. It does not change verdicts.",
  skipped: "Passes that this scene did not need, with the reason. They cost no time.",
  permutations: "The specialised shaders that ran, with the number of pixels that each shaded and the cost of a pixel.",
  timings: "Wall time of each stage of the run. Stages of two scenes can run at the same time.",
  encoding: "Change that the render target alone causes in the path's own picture.",
  textures: "Change that texture compression alone causes in the path's own picture.",
  stressError: "Error against fp64 at the same inputs, relative to the value or to the scale in the table. 99.9 % of the rows have a smaller error.",
  ulp: "Difference between device and CPU at equal precision, in units of the last place.",
  unexpected: "Findings that the table of functions and scenes does not list, and entries of the table that no row shows. They fail the run.",
  pareto: "Time and error of each setting. No other setting is both faster and better than one on the line.",
  zoom: "All panes move together. Wheel or pinch: zoom; drag: move; double click: zoom in. At 100 % one picture pixel is one screen pixel.",
  split: "One picture is left of the divider, the other is right of it. Drag the divider or this slider.",
  opacity: "Opacity of the test path's picture over the other picture. A shifted edge or highlight appears twice.",
  flicker: "Shows the pictures in turn at the same place, which makes the smallest change visible. Hold the button or the key F, or press once to stay.",
  showTerm: "Shows only one term of the light, for both paths. The colour is the sum of all terms.",
  showTruth: "Also shows the ground truth. If two pictures share a pane, the truth replaces the reference path.",
  showBaseline: "Also shows the pictures of the baseline that are not as in this run. If two pictures share a pane, the test path's picture in the baseline replaces the reference path.",
  dimOthers: "Darkens all other materials.",
  magma: "Black: identical. Bright yellow: the end of the range and all above it. Grey: below the threshold. The automatic range holds 99.5 % of the pixels that are looked at; the fixed range is 0 to 1, as in the report's pictures.",
  differenceLegend: "Difference of the displayed values, test path minus reference path, in steps of 255. Grey: equal. Brighter than grey: the test path is brighter. Each colour channel counts by itself, so a red pixel means more red.",
  falseColor: "Shows the luminance of the unclipped values in colours that stand for EV steps. 0 EV is middle grey, 18 % of white after exposure. +1 EV is twice the light, −1 EV is half of it. White is at +2.5 EV. Below −6 EV: black. Above +6 EV: white.",
  autoRange: "On: the range of a map holds 99.5 % of the pixels that are looked at. Off: FLIP from 0 to 1, and differences enlarged by the gain, so that maps of different items compare. The legend says the range.",
  overRuns: "The figure in each run before this one, and in this run. A line of points marks a run in which something about the row changed. Without a line the same inputs gave the same figure.",
  approximationShare: "Mean FLIP that the approximation adds: what a change to a nearer form takes off, as a mean over all orders in which the changes can be made (Shapley value). All shares add up to what all changes take off together. Alone: what this change takes off by itself. Below 0 the approximation hides another error.",
  explainedSets: "The changes of the test path with the least mean FLIP, for each number of changes. Operations and fetches are those of one pixel, counted in the shader. The mark is today's number of operations.",
  errorRanges: "The material's pixels in tenths of what its shader has there. Where the share of FLIP is larger than the share of pixels, the material differs more than elsewhere.",
  change: "Change of mean FLIP since the baseline. Above 0 the paths are further apart than then.",
} as const;
export type Topic = keyof typeof kHelp;

/** A button that says what a number means: on click and focus, and to screen readers at once. */
export function help(topic: Topic): TemplateResult {
  return html`<button type="button" class="help" data-help=${topic} aria-label=${"What this means: " + kHelp[topic]}>
    ?
  </button>`;
}

// What each number means, in one sentence, behind a "?" beside it.
import { html, type TemplateResult } from "lit";

export const kHelp = {
  flip: "FLIP says how different two pictures look when one flips between them: 0 is alike, 1 is far apart; 0.1 is 10 % more or less light, seen side by side, 0.2 is seen at a glance.",
  materialFlip: "FLIP of a material compares the reference path's picture with that picture in which this material alone has the test path's colours: no difference of a neighbour, or of what lies behind it, counts.",
  wholeFlip: "FLIP of a whole view compares the two paths' pictures as they are, over all pixels of any material.",
  mean: "The mean of FLIP over its pixels, weighted by how much of each it covers: what a budget usually limits.",
  p95: "A twentieth of the pixels is worse than this.",
  max: "The worst pixel.",
  pixels: "How many pixels of the view show it, wholly or in part. A material of fewer than its budget's min_pixels is too small to be judged.",
  clipping: "These pixels are black in both pictures or white in both, so no difference can be seen there: compare at another --exposure. From 5 % on it is a warning; a material of which more than half is clipped is not judged, unless it fails.",
  baseLayer: "Neither path models these parts of the material: only what lies below them is compared, so it never simply passes.",
  bias: "The test path against the reference path, on average: how much darker or brighter, and which way its tint goes.",
  worstTerm: "The term whose swap to the reference path's lowers this material's FLIP most: the likely cause.",
  attribution: "What mean FLIP becomes if the test path takes this one term from the reference path and keeps all others.",
  droppedLights: "The mobile path gives an object one sun and at most four local lights. FLIP here is the reference path's picture without the light against that with all lights: what the light does, not what the test path makes of it.",
  termLight: "Mean light of this term over the material, by path, in the scene's own units.",
  budget: "The value against its limits: the first mark warns, the second fails.",
  baseline: "The change since the earlier report that this run was held against.",
  exposure: "More or less light before both pictures are displayed, from their unclipped values: for judging highlights and shadows. The verdict is unaffected.",
  threshold: "Pixels whose FLIP is below this are shown as alike.",
  gain: "How many times the difference of the displayed pictures is enlarged; grey is no difference.",
  histogram: "How many pixels have which FLIP; the line is the budget of the mean. Of a material each pixel counts that it covers most of, with the material's own FLIP; of a whole view each pixel of any material.",
  inspector: "The values of one pixel: linear as shaded, display as seen, and what each term adds. FLIP is that of the map: in a material's view the own one of the material that covers most of the pixel.",
  linear: "Scene-referred light before exposure and display transform, Rec.709 primaries.",
  display: "What the screen is sent, 0 to 255.",
  truth: "The ground truth: exact integrals of the same material and light. Of a material the truth is held against the truth with this material's colours of the path. It judges nothing.",
  skipped: "What this scene did not need, and why: it cost no time.",
  permutations: "The specialised shaders that ran, how many pixels each shaded and what a pixel costs.",
  timings: "Wall time by stage of the run; stages of two scenes may run at the same time.",
  encoding: "What the path's render target alone changes in its own picture.",
  textures: "What the compression of the path's textures alone changes in its own picture.",
  stressError: "Against fp64 at the very same inputs, relative to the value or to the scale that the table states: 99.9 % of the rows are better than this.",
  ulp: "The device against the CPU at equal precision, in units of the last place.",
  unexpected: "What the table of functions and scenes does not list, or lists and no row shows any more. It fails the run.",
  pareto: "Each setting's time against its error; the ones on the line have no better rival at their price.",
  zoom: "All panes move together: wheel or pinch zooms, dragging moves, a double click goes closer; 100 % is one picture pixel to one screen pixel.",
  split: "What is left of the divider is one picture, what is right of it the other; drag the divider or this slider.",
  opacity: "How much of the test path's picture lies over the other one: a shifted edge or highlight shows twice.",
  flicker: "The pictures at the same place in turn, which shows the least change: hold the button or the key F, or press once to stay.",
  showTerm: "One part of the light alone, by both paths: the colour is the sum of all parts.",
  showTruth: "Also the ground truth; where two pictures share a pane it takes the reference path's place.",
  dimOthers: "Darkens what is not this material.",
  magma: "Black is alike, bright yellow is far apart; grey lies below the threshold.",
} as const;
export type Topic = keyof typeof kHelp;

/** A button that says what a number means: on click and focus, and to screen readers at once. */
export function help(topic: Topic): TemplateResult {
  return html`<button type="button" class="help" data-help=${topic} aria-label=${"What this means: " + kHelp[topic]}>
    ?
  </button>`;
}

// What each number means, in one sentence, behind a "?" beside it.
import { html, type TemplateResult } from "lit";

export const kHelp = {
  flip: "FLIP says how different two pictures look when one flips between them: 0 is alike, 1 is far apart; 0.1 is 10 % more or less light, seen side by side, 0.2 is seen at a glance.",
  mean: "The mean of FLIP over the material's pixels: what a budget usually limits.",
  p95: "A twentieth of the pixels is worse than this.",
  max: "The worst pixel.",
  interior: "Pixels at least 10 away from any other material: FLIP looks that far, so a neighbour's difference cannot show here.",
  all: "Every pixel of the material, also its rim, where FLIP sees the neighbours too.",
  pixels: "How many pixels of the view show this material.",
  bias: "Mobile against high-end, on average: how much darker or brighter, and which way its tint goes.",
  worstTerm: "The term whose swap to the high-end path's lowers this material's FLIP most: the likely cause.",
  attribution: "What mean FLIP becomes if mobile takes this one term from the high-end path and keeps all others.",
  droppedLights: "The mobile path gives an object one sun and at most four local lights. FLIP here is the high-end picture without the light against that with all lights: what the light does, not what mobile makes of it.",
  termLight: "Mean light of this term over the material, by path, in the scene's own units.",
  budget: "The value against its limits: the first mark warns, the second fails.",
  baseline: "The change since the earlier report that this run was held against.",
  exposure: "More or less light before both pictures are displayed, from their unclipped values: for judging highlights and shadows. The verdict is unaffected.",
  threshold: "Pixels whose FLIP is below this are shown as alike.",
  gain: "How many times the difference of the displayed pictures is enlarged; grey is no difference.",
  histogram: "How many pixels have which FLIP; the line is the budget of the mean.",
  inspector: "The values of one pixel: linear as shaded, display as seen, and what each term adds.",
  linear: "Scene-referred light before exposure and display transform, Rec.709 primaries.",
  display: "What the screen is sent, 0 to 255.",
  truth: "The reference path: exact integrals of the same material and light. It judges nothing.",
  skipped: "What this scene did not need, and why: it cost no time.",
  permutations: "The specialised shaders that ran, how many pixels each shaded and what a pixel costs.",
  timings: "Wall time by stage of the run; stages of two scenes may run at the same time.",
  encoding: "What the mobile path's render target alone changes in its own picture.",
  textures: "What the compression of the mobile path's textures alone changes in its own picture.",
  pareto: "Each setting's time against its error; the ones on the line have no better rival at their price.",
  zoom: "All panes move together: wheel or pinch zooms, dragging moves, a double click goes closer; 100 % is one picture pixel to one screen pixel.",
  split: "What is left of the divider is one picture, what is right of it the other; drag the divider or this slider.",
  opacity: "How much of the mobile picture lies over the other one: a shifted edge or highlight shows twice.",
  flicker: "The pictures at the same place in turn, which shows the least change: hold the button or the key F, or press once to stay.",
  showTerm: "One part of the light alone, by both paths: the colour is the sum of all parts.",
  showTruth: "Also the reference path; where two pictures share a pane it takes the high-end picture's place.",
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

// The buttons and sliders above the comparison: those that its mode has use for. What is needed less often folds away.
import { html, nothing, type TemplateResult } from "lit";

import { pathTitle, pathWord } from "../data/paths";
import { kDefaultState, kModes, type Mode, type ViewerState } from "../data/state";
import { help } from "../help";
import { exposureText } from "./arrange";
import { kExposureStep, kMostExposure } from "./keys";
import { check, range } from "./range_control";
import { kTermNames, termLabel } from "./terms";

export interface ControlScene {
  state: ViewerState;
  hasTruth: boolean;
  hasBaseline: boolean; // pictures of it that are not as in this run
  hasTerms: boolean;
  material: string | null; // the chosen one's name; null: the whole picture
  above: string; // how many pixels the threshold leaves; "": not known
  zoom: string;
  showsTest: boolean;
  test: string; // the path that is compared with the reference
  set: (change: Partial<ViewerState>) => void;
  zoomBy: (factor: number) => void;
  holdTest: (event: Event) => void; // of the flicker's button
  isPhone: boolean; // modes are a list of choices, and zooming, which fingers do, folds away
  isFolded: boolean;
  fold: (isFolded: boolean) => void;
}

const kModeNames: Readonly<Record<Mode, { name: string; key: string }>> = {
  side: { name: "Side by side", key: "S" },
  slider: { name: "Slider", key: "S" },
  onion: { name: "Onion skin", key: "O" },
  flicker: { name: "Flicker", key: "F" },
  difference: { name: "Difference", key: "D" },
  flip: { name: "FLIP map", key: "H" },
};

function modeButtons({ state, set, isPhone }: ControlScene): TemplateResult {
  if (isPhone)
    return html`<select
      class="mode"
      aria-label="How to compare"
      @change=${(event: Event) => set({ mode: (event.target as HTMLSelectElement).value as Mode })}
    >
      ${kModes.map((mode) => html`<option value=${mode} .selected=${state.mode === mode}>${kModeNames[mode].name}</option>`)}
    </select>`;
  return html`<div class="modes" role="group" aria-label="How to compare">
    ${kModes.map(
      (mode) =>
        html`<button
          type="button"
          aria-pressed=${state.mode === mode ? "true" : "false"}
          title=${`${kModeNames[mode].name} (${kModeNames[mode].key})`}
          @click=${() => set({ mode })}
        >
          ${kModeNames[mode].name}
        </button>`,
    )}
  </div>`;
}

function zoomButtons({ set, zoom, zoomBy }: ControlScene): TemplateResult {
  return html`<div class="zooms" role="group" aria-label="Zoom">
    <button type="button" aria-label="Zoom out" title="Zoom out (−)" @click=${() => zoomBy(1 / 1.5)}>−</button>
    <output aria-label="Zoom">${zoom}</output>
    <button type="button" aria-label="Zoom in" title="Zoom in (+)" @click=${() => zoomBy(1.5)}>+</button>
    <button type="button" title="Fit (0)" @click=${() => set({ zoom: 1, panX: 0.5, panY: 0.5 })}>Fit</button>
    ${help("zoom")}
  </div>`;
}

function termChoice({ state, hasTerms, set }: ControlScene): TemplateResult | typeof nothing {
  if (!hasTerms && state.term === "") return nothing;
  return html`<span class="choice"
    ><label for="viewer-term">Show</label>
    <select id="viewer-term" @change=${(event: Event) => set({ term: (event.target as HTMLSelectElement).value })}>
      <option value="" .selected=${state.term === ""}>colour</option>
      ${kTermNames.map(
        (term) => html`<option value=${term} .selected=${state.term === term}>${term}: ${termLabel(term)}</option>`,
      )}
    </select>
    ${help("showTerm")}</span
  >`;
}

function modeControl(scene: ControlScene): TemplateResult | typeof nothing {
  const { state, set } = scene;
  const percent = (value: number): string => `${Math.round(100 * value)} %`;
  const share = { least: 0, most: 1, step: 0.01, usual: 0.5 };
  if (state.mode === "slider")
    return range({
      ...share,
      id: "split",
      label: "Split",
      topic: "split",
      value: state.split,
      text: percent(state.split),
      set: (split) => set({ split }),
    });
  if (state.mode === "onion")
    return range({
      ...share,
      id: "opacity",
      label: pathTitle(scene.test),
      topic: "opacity",
      value: state.opacity,
      text: percent(state.opacity),
      set: (opacity) => set({ opacity }),
    });
  if (state.mode === "flicker")
    return html`<span class="choice"
      ><button
        type="button"
        class="hold"
        aria-pressed=${scene.showsTest ? "true" : "false"}
        @pointerdown=${scene.holdTest}
        @pointerup=${scene.holdTest}
        @pointercancel=${scene.holdTest}
        @click=${scene.holdTest}
      >
        Show ${pathWord(scene.test)}</button
      >${help("flicker")}</span
    >`;
  return nothing;
}

function thresholdRange({ state, set, above }: ControlScene): TemplateResult {
  const text = state.threshold.toFixed(2) + (above === "" ? "" : `, ${above}`);
  return range({
    id: "threshold",
    label: "Threshold",
    topic: "threshold",
    value: state.threshold,
    text,
    least: 0,
    most: 1,
    step: 0.01,
    usual: 0,
    set: (threshold) => set({ threshold }),
  });
}

/** What the pictures and maps are made of in this state. */
function shows({ state }: ControlScene): { pictures: boolean; flip: boolean; difference: boolean } {
  const isSide = state.mode === "side";
  return {
    pictures: state.mode !== "difference" && state.mode !== "flip",
    flip: state.mode === "flip" || (isSide && state.term === ""),
    difference: state.mode === "difference" || (isSide && state.term !== ""),
  };
}

/** How many of the folded controls are not as at first: the button says so. */
export function changedCount(state: ViewerState): number {
  const keys = ["exposure", "threshold", "autoRange", "term", "falseColor", "showTruth", "showBaseline", "dimOthers"] as const;
  return keys.filter((key) => state[key] !== kDefaultState[key]).length;
}

function foldButton({ state, isFolded, fold }: ControlScene): TemplateResult {
  const changed = isFolded ? changedCount(state) : 0;
  return html`<button
    type="button"
    class="fold"
    aria-expanded=${isFolded ? "false" : "true"}
    aria-controls="viewer-more"
    @click=${() => fold(!isFolded)}
  >
    Adjust${changed > 0 ? ` (${changed})` : ""} <span aria-hidden="true">${isFolded ? "▾" : "▴"}</span>
  </button>`;
}

function mapControls(scene: ControlScene): TemplateResult {
  const { state, set } = scene;
  const { flip, difference } = shows(scene);
  return html`${flip || difference
    ? check(html`Automatic range`, "autoRange", state.autoRange, (autoRange) => set({ autoRange }))
    : nothing}
  ${difference && !state.autoRange
    ? range({
        id: "gain",
        label: "Gain",
        topic: "gain",
        value: state.gain,
        text: `× ${state.gain}`,
        least: 1,
        most: 64,
        step: 1,
        usual: 4,
        set: (gain) => set({ gain }),
      })
    : nothing}
  ${flip ? thresholdRange(scene) : nothing}`;
}

/** The whole tool bar. */
export function controls(scene: ControlScene): TemplateResult {
  const { state, set, isPhone } = scene;
  return html`<div class="tools" role="group" aria-label="Comparison">
    <div class="tool-line">
      ${modeButtons(scene)}
      ${isPhone
        ? html`${foldButton(scene)} ${modeControl(scene)}`
        : html`${zoomButtons(scene)} ${modeControl(scene)} ${foldButton(scene)}`}
    </div>
    <div class="tool-line" id="viewer-more" ?hidden=${scene.isFolded}>
      ${isPhone ? zoomButtons(scene) : nothing} ${termChoice(scene)}
      ${shows(scene).pictures
        ? check(html`False colours`, "falseColor", state.falseColor, (falseColor) => set({ falseColor }))
        : nothing}
      ${range({
        id: "exposure",
        label: "Exposure",
        topic: "exposure",
        value: state.exposure,
        text: exposureText(state.exposure) || "0 EV",
        least: -kMostExposure,
        most: kMostExposure,
        step: kExposureStep,
        usual: 0,
        set: (exposure) => set({ exposure }),
      })}
      ${mapControls(scene)}
      ${scene.hasBaseline
        ? check(html`Baseline`, "showBaseline", state.showBaseline, (showBaseline) => set({ showBaseline }))
        : nothing}
      ${scene.hasTruth ? check(html`Truth`, "showTruth", state.showTruth, (showTruth) => set({ showTruth })) : nothing}
      ${scene.material === null
        ? nothing
        : check(html`Dim all but <bdi>${scene.material}</bdi>`, "dimOthers", state.dimOthers, (dimOthers) =>
            set({ dimOthers }),
          )}
    </div>
  </div>`;
}

// The buttons and sliders above the comparison: those that its mode has use for.
import { html, nothing, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";

import { kModes, type Mode, type ViewerState } from "../data/state";
import { help, type Topic } from "../help";
import { exposureText } from "./arrange";
import { pathTitle, pathWord } from "../data/paths";
import { kExposureStep, kMostExposure } from "./keys";
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
}

const kModeNames: Readonly<Record<Mode, { name: string; key: string }>> = {
  side: { name: "Side by side", key: "S" },
  slider: { name: "Slider", key: "S" },
  onion: { name: "Onion skin", key: "O" },
  flicker: { name: "Flicker", key: "F" },
  difference: { name: "Difference", key: "D" },
  flip: { name: "FLIP map", key: "H" },
};

interface Range {
  id: string;
  label: string;
  topic: Topic;
  value: number;
  text: string;
  least: number;
  most: number;
  step: number;
  usual: number; // what the reset button sets
  set(value: number): void;
}

function range(r: Range): TemplateResult {
  const id = "viewer-" + r.id;
  return html`<div class="range">
    <label for=${id}>${r.label}</label>${help(r.topic)}
    <input
      id=${id}
      type="range"
      min=${r.least}
      max=${r.most}
      step=${r.step}
      .value=${live(String(r.value))}
      aria-valuetext=${r.text}
      @input=${(event: Event) => r.set(Number((event.target as HTMLInputElement).value))}
    />
    <output for=${id}>${r.text}</output>
    <button
      type="button"
      class="reset"
      ?disabled=${r.value === r.usual}
      aria-label=${`${r.label}: reset`}
      title="Reset"
      @click=${() => r.set(r.usual)}
    >
      ↺
    </button>
  </div>`;
}

function check(label: TemplateResult, topic: Topic, isOn: boolean, set: (isOn: boolean) => void): TemplateResult {
  return html`<span class="check"
    ><label
      ><input
        type="checkbox"
        .checked=${live(isOn)}
        @change=${(event: Event) => set((event.target as HTMLInputElement).checked)}
      />
      ${label}</label
    >${help(topic)}</span
  >`;
}

function modeButtons({ state, set }: ControlScene): TemplateResult {
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

/** The whole tool bar. */
export function controls(scene: ControlScene): TemplateResult {
  const { state, set } = scene;
  const showsFlip = state.mode === "flip" || (state.mode === "side" && state.term === "");
  const showsDifference = state.mode === "difference" || (state.mode === "side" && state.term !== "");
  return html`<div class="tools" role="group" aria-label="Comparison">
    ${modeButtons(scene)} ${zoomButtons(scene)} ${modeControl(scene)}
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
    ${showsFlip ? thresholdRange(scene) : nothing}
    ${showsDifference
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
    ${termChoice(scene)}
    ${scene.hasBaseline
      ? check(html`Baseline`, "showBaseline", state.showBaseline, (showBaseline) => set({ showBaseline }))
      : nothing}
    ${scene.hasTruth ? check(html`Truth`, "showTruth", state.showTruth, (showTruth) => set({ showTruth })) : nothing}
    ${scene.material === null
      ? nothing
      : check(html`Dim all but <bdi>${scene.material}</bdi>`, "dimOthers", state.dimOthers, (dimOthers) =>
          set({ dimOthers }),
        )}
  </div>`;
}

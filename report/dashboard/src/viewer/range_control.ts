// A slider with its value and a reset button, and a check box with its help: what the tool bar is made of.
import { html, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";

import { help, type Topic } from "../help";

export interface Range {
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

export function range(r: Range): TemplateResult {
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

export function check(
  label: TemplateResult,
  topic: Topic,
  isOn: boolean,
  set: (isOn: boolean) => void,
): TemplateResult {
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

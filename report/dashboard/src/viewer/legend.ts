// The scale of FLIP maps: magma's colours with numbers, and where the threshold cuts.
import { html, nothing, type TemplateResult } from "lit";

import { magmaCss } from "../data/magma";
import { help } from "../help";
import { styleText } from "./style_text";

const kStops = 32;
const kGradient = `linear-gradient(to right, ${Array.from({ length: kStops + 1 }, (_, i) => magmaCss(i / kStops)).join(", ")})`;
const kTicks = [0, 0.25, 0.5, 0.75, 1];

function at(share: number): string {
  return styleText({ left: `${100 * share}%` });
}

export function legend(threshold: number): TemplateResult {
  const words = threshold > 0 ? `; grey below the threshold ${threshold.toFixed(2)}` : "";
  return html`<div class="legend">
    <span class="legend-name">FLIP${help("magma")}</span>
    <div
      class="legend-scale"
      role="img"
      aria-label=${`FLIP from 0 (black, identical) to 1 (bright yellow, largest difference)${words}`}
    >
      <div class="legend-bar" .style=${styleText({ background: kGradient })}>
        ${threshold > 0
          ? html`<i class="alike" .style=${styleText({ width: `${100 * threshold}%` })}></i
              ><i class="cut" .style=${at(threshold)}></i>`
          : nothing}
      </div>
      ${kTicks.map((tick) => html`<span class="tick" .style=${at(tick)}>${tick}</span>`)}
    </div>
  </div>`;
}

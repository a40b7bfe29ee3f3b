// The pixel in a line beside the legends: the inspector below may be out of sight.
import { html, type TemplateResult } from "lit";

import { fixed } from "../format";
import { luminanceTexts } from "./inspect";
import type { Inspected } from "./inspector";

export function readout(at: Inspected | null, falseColor: boolean): TemplateResult {
  if (at === null) return html`<p class="readout aside">Point at a picture for the values of a pixel.</p>`;
  const values = falseColor ? `, ${luminanceTexts(at).join(", ")}` : "";
  return html`<p class="readout">
    <b class="number">${at.pixel.x}, ${at.pixel.y}</b> FLIP <b class="number">${fixed(at.flip, 3)}</b>${values}
    <bdi>${at.material ?? ""}</bdi>
  </p>`;
}

// The lights that a path drops: what each does to a material, or in a view.
import { html, nothing, type TemplateResult } from "lit";

import { pathTitle, pathWord } from "../data/paths";
import type { Head } from "../data/page";
import type { DroppedLight, DroppedLights, View } from "../data/types";
import { countOf } from "../data/wording";
import { figure } from "../format";
import { help } from "../help";

const kNamed = 3; // materials of a light, in a view's table

/** The lights that an object of the material lacks, with what each does to it, the most first. */
export function lightsOf(dropped: DroppedLights, material: string): { light: DroppedLight; flip: number }[] {
  return dropped.measured
    .flatMap((light) => light.materials.filter((each) => each.name === material).map(({ flip }) => ({ light, flip })))
    .sort((a, b) => b.flip - a.flip);
}

/** "Mobile drops 5 of 9 lights." */
export function describeDropped(dropped: DroppedLights, path: string): string {
  return `${pathTitle(path)} drops ${dropped.measured.length + dropped.notMeasured.length} of ${countOf(dropped.lights, "lights")}`;
}

/** material: its name; null: of the whole view. Nothing where its test path drops none of its lights. */
export function droppedLights(view: View | undefined, material: string | null, report: Head): TemplateResult | typeof nothing {
  const dropped = view?.droppedLights;
  if (!dropped) return nothing;
  const statistic = report.statistics["flip.mean"];
  const rows = material === null ? dropped.measured.map((light) => ({ light, flip: light.materials[0]?.flip ?? 0 })) : lightsOf(dropped, material);
  if (rows.length === 0 && dropped.notMeasured.length === 0) return nothing;
  const most = Math.max(...rows.map(({ flip }) => flip), 1e-6);
  const changed = ({ materials }: DroppedLight): TemplateResult => html`${materials.slice(0, kNamed).map(
    ({ name, flip }, i) => html`${i > 0 ? ", " : ""}<bdi>${name}</bdi> ${figure(flip, statistic)}`,
  )}${materials.length > kNamed ? `, and ${materials.length - kNamed} more` : ""}`;
  return html`<section class="dropped-lights"><h3>Lights that ${pathWord(view.test)} drops ${help("droppedLights")}</h3>
    <p>${describeDropped(dropped, view.test)} for at least one object of this view${material === null ? "" : rows.length === 0 ? "; no measured light is dropped for this material" : `; ${rows.length} of the measured lights are dropped for this material`}.</p>
    ${rows.length === 0 ? nothing : html`<div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table class="attribution">
      <thead><tr><th scope="col">light</th><th scope="col">kind</th><th scope="col">kept by</th><th scope="col">dropped by</th><th scope="col"><span class="sr">bar</span></th><th scope="col">mean FLIP without it</th></tr></thead>
      <tbody>${rows.map(({ light, flip }) => html`<tr>
        <th scope="row"><bdi>${light.name}</bdi></th>
        <td>${light.kind}</td>
        <td class="number">${countOf(light.keptBy, "objects")}</td>
        <td class="number">${countOf(light.droppedBy, "objects")}</td>
        <td class="effect"><span class="bar"><i class="fill now" .style=${`width:${(flip / most) * 100}%`}></i></span></td>
        <td class=${material === null ? "" : "number"}>${material === null ? changed(light) : figure(flip, statistic)}</td></tr>`)}</tbody>
    </table></div>`}
    ${dropped.notMeasured.length === 0 ? nothing : html`<details><summary>${dropped.notMeasured.length} more ${dropped.notMeasured.length === 1 ? "was" : "were"} not measured</summary>
      <p class="aside">Their estimated effect is smaller; <code>--dropped-lights</code> sets the number of lights to measure.</p>
      <ul>${dropped.notMeasured.map((name) => html`<li><bdi>${name}</bdi></li>`)}</ul></details>`}
  </section>`;
}

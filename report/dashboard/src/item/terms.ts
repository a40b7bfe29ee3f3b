// Which term makes the two differ: in words first, then what each swap does, the lights that the second path
// drops, then the terms' pictures.
import { html, nothing, type TemplateResult } from "lit";
import { customElement, property } from "lit/decorators.js";
import { repeat } from "lit/directives/repeat.js";

import { pathTitle, pathWord } from "../data/paths";
import type { Row } from "../data/rows";
import { toHash, type State } from "../data/state";
import type { Head } from "../data/page";
import type { Attribution, Material, Scene, View } from "../data/types";
import { PageElement } from "../element";
import { figure, fixed, signed } from "../format";
import { help } from "../help";
import "../viewer/term_image";
import { termLabel } from "../viewer/terms";
import { droppedLights } from "./dropped_lights";
import { describeTerm, effectOf } from "./term_words";

@customElement("parity-terms")
export class ParityTerms extends PageElement {
  @property({ attribute: false }) report!: Head;
  @property({ attribute: false }) scene!: Scene;
  @property({ attribute: false }) row!: Row;
  @property({ attribute: false }) state!: State;

  private get shownView(): View | undefined {
    return this.scene.views[this.row.view];
  }

  private get material(): Material | null {
    return this.shownView?.materials[this.row.material] ?? null;
  }

  protected override render(): TemplateResult {
    const { material, row } = this;
    return html`<section class="terms">
      <p class="bias-words"><b>${row.bias === "" ? "No pixel of this view shows it." : row.bias}</b>${row.bias === "" ? nothing : help("bias")}</p>
      ${material?.attribution ? this.renderAttribution(material.attribution) : this.renderWhyNone(material)}
      ${droppedLights(this.shownView, row.kind === "material" ? row.name : null, this.report)}
      ${this.renderTerms(material)}
    </section>`;
  }

  private renderWhyNone(material: Material | null): TemplateResult {
    if (!material) return html`<p class="aside">Only materials have causes. Open a material of this view.</p>`;
    if (material.external) return html`<p class="aside">A picture of another engine takes part. Its terms of light are not known, so no cause is named.</p>`;
    return html`<p class="aside">The report looks for the cause of materials over budget. <code>--attribution all</code> looks for the cause of all.</p>`;
  }

  private renderAttribution({ flip, terms }: Attribution): TemplateResult {
    const statistic = this.report.statistics["flip.mean"];
    const most = Math.max(flip ?? 0, ...terms.map((each) => each.flip ?? 0), 1e-6);
    const { cause } = this.row;
    const line = (label: TemplateResult | string, value: number | null, kind: string): TemplateResult => html`<tr class=${kind}>
      <th scope="row">${label}</th>
      <td class="swap"><span class="bar"><i class="fill ${kind}" .style=${`width:${((value ?? 0) / most) * 100}%`}></i></span></td>
      <td class="number">${figure(value ?? undefined, statistic)}</td>
      <td class="number">${kind === "now" || flip === null || value === null ? nothing : `${signed(((value - flip) / Math.max(flip, 1e-9)) * 100, 0)} %`}</td></tr>`;
    const sorted = [...terms].sort((a, b) => (a.flip ?? Infinity) - (b.flip ?? Infinity));
    return html`<h3>Mean FLIP with one term from ${pathWord(this.row.reference)} ${help("attribution")}</h3>
      <p>${
        cause
          ? html`The cause is <b>${cause.term}</b> (${termLabel(cause.term)}). With the ${pathWord(this.row.reference)} term, mean FLIP is ${figure(cause.after, statistic)} instead of ${figure(cause.before, statistic)}.`
          : "No single term explains it: no swap lowers FLIP by 10 %."
      }</p>
      <div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table class="attribution">
        <thead><tr><th scope="col">swapped term</th><th scope="col"><span class="sr">bar</span></th><th scope="col">mean FLIP</th><th scope="col">change</th></tr></thead>
        <tbody>${line("none", flip, "now")}${sorted.map((each) => line(html`${each.term} <small>${termLabel(each.term)}</small>`, each.flip, effectOf(each.flip, flip)))}</tbody>
      </table></div>`;
  }

  private renderTerms(material: Material | null): TemplateResult | typeof nothing {
    const view = this.shownView;
    if (!view) return nothing;
    const lights = material?.terms ?? [];
    const names = lights.filter((each) => describeTerm(each, view.test) !== "black in both").map((each) => each.term);
    if (names.length === 0 && view.pixels.terms === "") return nothing;
    const shown = names.length > 0 ? names : [...new Set(view.materials.flatMap((each) => each.terms.filter((term) => describeTerm(term, view.test) !== "black in both").map((term) => term.term)))];
    return html`<h3>Terms of light in both paths ${help("termLight")}</h3>
      <div class="term-grid">${repeat(shown, (term) => [this.row.scene, this.row.view, this.row.material, term].join(" "), (term) => {
        const light = lights.find((each) => each.term === term);
        const hash = toHash({ ...this.state, term, tab: "compare", mode: "side" });
        const image = (path: string, light: number | null | undefined): TemplateResult => html`<figure>
          <parity-term-image .report=${this.report} .view=${view} .material=${this.row.material} .plane=${`${path}.${term}`} .exposure=${this.state.exposure} .label=${`${pathTitle(path)} ${term}`}></parity-term-image>
          <figcaption>${pathTitle(path)} ${light !== undefined ? html`<span class="number">${fixed(light, 4)}</span>` : nothing}</figcaption></figure>`;
        return html`<section class="term"><h4><a href=${hash} title=${termLabel(term)}>${term}</a>${light ? html` <small>${describeTerm(light, view.test)}</small>` : nothing}</h4>
          ${view.pixels.terms === "" ? html`<p class="aside">${light ? `${pathWord(view.reference)} ${fixed(light.reference, 4)}, ${pathWord(view.test)} ${fixed(light.test, 4)}` : ""}</p>` : html`<div class="pair">${image(view.reference, light?.reference)}${image(view.test, light?.test)}</div>`}</section>`;
      })}</div>`;
  }
}

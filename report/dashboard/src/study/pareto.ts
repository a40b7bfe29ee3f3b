// A picture of time against error: the SVG that the program has drawn (study/sweep/pareto_svg.cpp), in the page's colours.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";

import { PageElement } from "../element";

@customElement("parity-pareto")
export class ParityPareto extends PageElement {
  @property({ attribute: false }) svg = "";
  @query(".plot") private place!: HTMLElement;
  @state() private paths: string[] = [];
  @state() private at = ""; // the setting that is pointed at

  protected override updated(changed: PropertyValues): void {
    if (!changed.has("svg")) return;
    const picture = new DOMParser().parseFromString(this.svg, "image/svg+xml").documentElement;
    this.place.replaceChildren(document.importNode(picture, true));
    this.paths = [...picture.querySelectorAll(".key text")].map((each) => each.textContent ?? "").slice(0, -1); // dominated
    this.at = "";
  }

  private showPath(index: number, isShown: boolean): void {
    for (const each of this.place.querySelectorAll<SVGElement>(`.path-${index}`)) each.style.display = isShown ? "" : "none";
  }

  private readonly onMove = (event: PointerEvent): void => {
    const picture = this.place.querySelector("svg");
    const toPicture = picture?.getScreenCTM()?.inverse();
    if (!picture || !toPicture) return;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(toPicture);
    const distance = (dot: SVGCircleElement): number => Math.hypot(dot.cx.baseVal.value - point.x, dot.cy.baseVal.value - point.y);
    const dots = [...picture.querySelectorAll<SVGCircleElement>("circle.dot")].filter((dot) => dot.style.display === "");
    const nearest = dots.reduce<SVGCircleElement | null>((best, dot) => (best && distance(best) <= distance(dot) ? best : dot), null);
    for (const dot of dots) dot.classList.toggle("at", dot === nearest);
    this.at = nearest?.querySelector("title")?.textContent?.trim().replaceAll("\n", " · ") ?? "";
  };

  protected override render(): TemplateResult {
    return html`<div class="pareto-keys">
        ${this.paths.map((path, index) => html`<label><input type="checkbox" checked @change=${(event: Event) => this.showPath(index, (event.target as HTMLInputElement).checked)} /><span class="swatch path-${index}"></span>${path}</label>`)}
        ${this.paths.length > 0 ? html`<span><span class="swatch dominated"></span>dominated; the larger dot is the default of a path</span>` : nothing}
      </div>
      <div class="plot table-scroll" tabindex="0" role="group" aria-label="Picture" @pointermove=${this.onMove}></div>
      <p class="aside plot-hover" aria-hidden="true">${this.at === "" ? "Point at a setting." : this.at}</p>`;
  }
}

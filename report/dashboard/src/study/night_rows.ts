// The rows that changed: found by words, each with its trend; the chosen one beside them.
import { html, nothing, svg, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import type { Nights, Trend } from "../data/history";
import { trendPath } from "../data/night_lines";
import { figuresOf, inOrder, kOrders, rowsWith, type Order } from "../data/nights";
import { countOf } from "../data/wording";
import { PageElement } from "../element";
import { count } from "../format";
import { badge } from "../parts";
import { linkOf, type Shown } from "./night_link";
import "./night_row";

const kStep = 25; // rows that are shown at first; each wish for more brings four times as many
const kWidth = 110, kHeight = 22; // of a small trend

@customElement("parity-night-rows")
export class ParityNightRows extends PageElement {
  @property({ attribute: false }) nights!: Nights;
  @property({ attribute: false }) shown!: Shown;
  @state() private words = "";
  @state() private order: Order = "last change";
  @state() private most = kStep;

  private readonly onSearch = (event: Event): void => {
    this.words = (event.target as HTMLInputElement).value;
    this.most = kStep;
  };

  private readonly onOrder = (event: Event): void => {
    this.order = (event.target as HTMLSelectElement).value as Order;
  };

  private row(name: string, trend: Trend): TemplateResult {
    const verdict = trend.verdicts.at(-1)?.[2];
    const path = trendPath(trend, figuresOf(trend)[0] ?? "", this.nights.runs.length, kWidth, kHeight);
    return html`<li>
      <a href=${linkOf({ ...this.shown, row: name, figure: "" })} aria-current=${name === this.shown.row}><bdi>${name}</bdi></a>
      ${verdict ? badge(verdict, true) : html`<span></span>`}
      <small>${countOf(trend.changes.length, "changes")}</small>
      <svg class="spark" width=${kWidth} height=${kHeight} viewBox=${`0 0 ${kWidth} ${kHeight}`} aria-hidden="true">${svg`<path d=${path} />`}</svg>
    </li>`;
  }

  protected override render(): TemplateResult {
    const found = inOrder(rowsWith(this.nights.rows, this.words), this.order), shown = found.slice(0, this.most);
    const all = Object.keys(this.nights.rows).length;
    return html`<div class="night-filters">
        <input id="search" type="search" placeholder="Find rows" aria-label="Find rows by words of their names" .value=${this.words} @input=${this.onSearch} />
        <label class="select">Order <select @change=${this.onOrder}>${kOrders.map((each) => html`<option ?selected=${each === this.order}>${each}</option>`)}</select></label>
        <span class="shown" role="status">${found.length === all ? countOf(all, "rows") : `${count(found.length)} of ${countOf(all, "rows")}`}</span>
      </div>
      <div class="night-rows ${this.shown.row === "" ? "" : "with-row"}">
        <div class="night-row-list">
          <ul>${shown.map(([name, trend]) => this.row(name, trend))}</ul>
          ${found.length === 0 ? html`<p class="aside">No row has these words.</p>` : nothing}
          ${shown.length < found.length ? html`<button type="button" @click=${() => (this.most += 4 * kStep)}>Show more</button>` : nothing}
        </div>
        ${this.shown.row === "" ? nothing : html`<parity-night-row .nights=${this.nights} .shown=${this.shown}></parity-night-row>`}
      </div>`;
  }
}

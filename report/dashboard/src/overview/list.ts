// The rows, of which only those in sight are in the page: thousands scroll smoothly.
import { VirtualizerController } from "@tanstack/lit-virtual";
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";
import { createRef, ref } from "lit/directives/ref.js";

import { sortsUpAtFirst } from "../data/filter";
import type { Row } from "../data/rows";
import { isSameItem, openItem, toHash, type Item, type State } from "../data/state";
import type { Report } from "../data/types";
import { PageElement } from "../element";
import { help, type Topic } from "../help";
import { compactRow, fullRow } from "./row";

interface Column {
  key: string;
  label: string;
  topic?: Topic;
}

const kColumns: readonly Column[] = [
  { key: "gravity", label: "Verdict" },
  { key: "name", label: "Material" },
  { key: "flip.mean", label: "Mean FLIP", topic: "mean" },
  { key: "flip.p95", label: "p95", topic: "p95" },
  { key: "flip.max", label: "Max", topic: "max" },
  { key: "bias", label: "Bias", topic: "bias" },
  { key: "cause", label: "Cause", topic: "worstTerm" },
  { key: "pixels", label: "Pixels", topic: "pixels" },
];
const kPrintedRows = 500;

/** Heights that style/list.css gives the rows, in px. */
const kRowHeight = { wide: 76, narrow: 132, compact: 58 } as const;

@customElement("parity-list")
export class ParityList extends PageElement {
  @property({ attribute: false }) report!: Report;
  @property({ attribute: false }) rows: readonly Row[] = []; // as sorted and filtered
  @property({ attribute: false }) state!: State;
  @property({ type: Boolean }) compact = false;
  @state() private printing = false;
  @state() private narrow = false;

  private readonly scroller = createRef<HTMLElement>();
  private readonly virtualizer = new VirtualizerController<HTMLElement, HTMLElement>(this, {
    getScrollElement: () => this.scroller.value ?? null,
    count: 0,
    estimateSize: () => kRowHeight.wide,
    overscan: 6,
  });
  private readonly narrowQuery = window.matchMedia("(max-width: 760px)");
  private readonly printQuery = window.matchMedia("print");

  override connectedCallback(): void {
    super.connectedCallback();
    this.narrow = this.narrowQuery.matches;
    this.narrowQuery.addEventListener("change", this.onMedia);
    this.printQuery.addEventListener("change", this.onMedia);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.narrowQuery.removeEventListener("change", this.onMedia);
    this.printQuery.removeEventListener("change", this.onMedia);
  }

  private readonly onMedia = (): void => {
    this.narrow = this.narrowQuery.matches;
    this.printing = this.printQuery.matches;
    if (this.printing) this.performUpdate(); // the browser prints what is there now
  };

  private get rowHeight(): number {
    if (this.compact) return kRowHeight.compact;
    return this.narrow ? kRowHeight.narrow : kRowHeight.wide;
  }

  protected override willUpdate(changed: PropertyValues): void {
    const virtualizer = this.virtualizer.getVirtualizer();
    const height = this.rowHeight;
    const resized = virtualizer.options.estimateSize(0) !== height;
    if (changed.has("rows") || resized)
      virtualizer.setOptions({ ...virtualizer.options, count: this.rows.length, estimateSize: () => height });
    if (resized) virtualizer.measure();
  }

  /** Brings the row of an item into sight, and its link into focus where that is wanted. */
  async reveal(item: Item, withFocus: boolean): Promise<void> {
    const index = this.rows.findIndex((row) => isSameItem(row.link, item));
    if (index < 0) return;
    this.virtualizer.getVirtualizer().scrollToIndex(index, { align: "auto" });
    if (!withFocus) return;
    await new Promise((done) => requestAnimationFrame(done));
    await this.updateComplete;
    this.querySelector<HTMLElement>(`[aria-rowindex="${index + 2}"] a.name`)?.focus({ preventScroll: true });
  }

  private isOpen(row: Row): boolean {
    return isSameItem(row.link, this.state);
  }

  private renderNothing(): TemplateResult {
    const all = toHash({ ...this.state, query: "", verdicts: [], causedBy: "", preset: "" });
    return html`<p class="nothing">${this.report.scenes.length === 0 ? "Nothing was compared." : html`Nothing matches. <a href=${all === "" ? "#" : all}>Show all</a>`}</p>`;
  }

  protected override render(): TemplateResult {
    if (this.rows.length === 0) return this.renderNothing();
    const virtualizer = this.virtualizer.getVirtualizer();
    const height = this.rowHeight;
    const shown = this.printing
      ? this.rows.slice(0, kPrintedRows).map((_row, index) => ({ index, start: index * height }))
      : virtualizer.getVirtualItems();
    const total = this.printing ? shown.length * height : virtualizer.getTotalSize();
    return html`
      <div class="list ${this.compact ? "compact" : ""}" role="table" aria-label=${this.state.list === "views" ? "Views" : "Materials"} aria-rowcount=${this.rows.length + 1}>
        ${this.compact ? nothing : this.renderHead()}
        <div class="list-scroll" role="rowgroup" tabindex="0" ${ref(this.scroller)} aria-label="Rows">
          <div class="list-all" role="presentation" .style=${`height:${total}px`}>
            ${shown.map(({ index, start }) => {
              const row = this.rows[index];
              return row ? this.renderRow(row, index, start) : nothing;
            })}
          </div>
        </div>
        ${this.printing && this.rows.length > kPrintedRows ? html`<p>The first ${kPrintedRows} of ${this.rows.length} rows.</p>` : nothing}
      </div>
    `;
  }

  private renderHead(): TemplateResult {
    const { sort, ascending } = this.state;
    return html`<div class="list-head" role="rowgroup"><div class="row-grid" role="row" aria-rowindex="1">
      <span role="columnheader" class="cell-pictures">Pictures</span>
      ${kColumns.map(({ key, label, topic }) => {
        const order = sort !== key ? "none" : ascending ? "ascending" : "descending";
        return html`<span role="columnheader" class=${"cell-" + key.replace(".", "-")} aria-sort=${order}>
          <button type="button" class="sort" @click=${() => this.sortBy(key)}>
            ${key === "name" && this.state.list === "views" ? "View" : label}<span aria-hidden="true" class="arrow">${order === "none" ? "" : ascending ? " ▲" : " ▼"}</span>
          </button>${topic ? help(topic) : nothing}</span>`;
      })}</div></div>`;
  }

  private sortBy(key: string): void {
    const ascending = this.state.sort === key ? !this.state.ascending : sortsUpAtFirst(key);
    this.dispatchEvent(new CustomEvent("parity-state", { bubbles: true, detail: { sort: key, ascending } }));
  }

  private renderRow(row: Row, index: number, start: number): TemplateResult {
    const open = this.isOpen(row);
    return html`<div
      class="row-grid row ${row.verdict.replace(" ", "-")} ${open ? "open" : ""}"
      role="row"
      aria-rowindex=${index + 2}
      .style=${`transform:translateY(${start}px)`}
    >
      ${this.compact ? compactRow(row, this.report, toHash(openItem(this.state, row.link)), open) : fullRow(row, this.report, toHash(openItem(this.state, row.link)))}
    </div>`;
  }
}

// The rows, of which only those in sight are in the page: thousands scroll smoothly.
import { VirtualizerController } from "@tanstack/lit-virtual";
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";
import { createRef, ref } from "lit/directives/ref.js";

import { entriesOf, type Entry, type Group } from "../data/groups";
import type { Head } from "../data/page";
import type { Row } from "../data/rows";
import { openItem, toHash, type State } from "../data/state";
import { PageElement } from "../element";
import { count } from "../format";
import { kPhone, Media } from "../media";
import { groupHead } from "./group";
import { listHead, listNote } from "./head";
import { layLines } from "./lines";
import { compactRow, fullRow, type RowScene } from "./row";
import { hasBaseline } from "./since";

const kPrintedRows = 500;

/** Heights that style/list.css gives the lines, in px. */
const kRowHeight = { wide: 84, narrow: 172, compact: 58 } as const;
const kGroupHeight = { wide: 40, narrow: 84, compact: 52 } as const;

@customElement("parity-list")
export class ParityList extends PageElement {
  @property({ attribute: false }) report!: Head;
  @property({ attribute: false }) tests: readonly string[] = []; // the paths that are tested
  @property({ type: Boolean }) isEmpty = false; // the report has no row at all
  @property({ attribute: false }) groups: readonly Group[] = []; // as sorted and filtered
  @property({ attribute: false }) scales: Readonly<Record<string, number>> = {}; // of bars, by figure
  @property({ attribute: false }) state!: State;
  @property({ attribute: false }) open: Row | null = null;
  @property({ type: Boolean }) compact = false;
  @state() private toggled: ReadonlySet<string> = new Set(); // groups that are not as state.folded says

  private inputs: readonly unknown[] = []; // that the entries were made of
  private entries: readonly Entry[] = [];
  private left = 0; // lines that have no room
  private starts: readonly number[] = []; // of the entries, in px; one more for the end
  private readonly scroller = createRef<HTMLElement>();
  private readonly virtualizer = new VirtualizerController<HTMLElement, HTMLElement>(this, {
    getScrollElement: () => this.scroller.value ?? null,
    count: 0,
    estimateSize: () => kRowHeight.wide,
    overscan: 6,
  });
  private readonly phone = new Media(this, kPhone);
  private readonly print = new Media(this, "print", () => {
    this.requestUpdate();
    if (this.print.matches) this.performUpdate(); // the browser prints what is there now
  });
  private readonly resizing = new ResizeObserver(() => this.keepInSight());
  private observed: HTMLElement | null = null;

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.resizing.disconnect();
    this.observed = null;
  }

  protected override willUpdate(changed: PropertyValues): void {
    const before = changed.get("state") as State | undefined;
    if (before && (before.folded !== this.state.folded || before.group !== this.state.group)) this.toggled = new Set();
    const inputs = [this.groups, this.toggled, this.state.folded, this.open, this.compact, this.phone.matches];
    if (inputs.every((input, i) => input === this.inputs[i])) return; // it scrolls
    this.inputs = inputs;
    const all = entriesOf(this.groups, (key) => this.state.folded !== this.toggled.has(key), this.open);
    const size = this.compact ? "compact" : this.phone.matches ? "narrow" : "wide";
    const { entries, starts, left } = layLines(all, kGroupHeight[size], kRowHeight[size]);
    this.entries = entries;
    this.left = left;
    const isOther = starts.length !== this.starts.length || starts.some((start, i) => start !== this.starts[i]);
    this.starts = starts;
    if (!isOther) return;
    const virtualizer = this.virtualizer.getVirtualizer();
    virtualizer.setOptions({ ...virtualizer.options, count: entries.length, estimateSize: (i) => starts[i + 1]! - starts[i]! });
    virtualizer.measure();
  }

  protected override updated(): void {
    const scroller = this.scroller.value ?? null;
    if (scroller === this.observed) return;
    this.resizing.disconnect();
    if (scroller) this.resizing.observe(scroller);
    this.observed = scroller;
  }

  private indexOf(row: Row | null): number {
    return row === null ? -1 : this.entries.indexOf(row);
  }

  /** The open row stays in sight when the list gets another size. */
  private keepInSight(): void {
    if (this.open) this.bringIntoSight(this.indexOf(this.open));
  }

  private bringIntoSight(index: number): void {
    const scroller = this.scroller.value;
    if (index < 0 || !scroller) return;
    const start = this.starts[index] ?? 0;
    const end = this.starts[index + 1] ?? start;
    if (start < scroller.scrollTop) scroller.scrollTop = start;
    else if (end > scroller.scrollTop + scroller.clientHeight) scroller.scrollTop = end - scroller.clientHeight;
  }

  /** Brings a row into sight, and its link into focus where that is wanted. */
  async reveal(row: Row | null, withFocus: boolean): Promise<void> {
    this.bringIntoSight(this.indexOf(row));
    await new Promise((done) => requestAnimationFrame(done)); // the list may have got another width and height
    await this.updateComplete;
    const index = this.indexOf(row);
    this.bringIntoSight(index);
    if (!withFocus || index < 0) return;
    await new Promise((done) => requestAnimationFrame(done));
    await this.updateComplete;
    this.querySelector<HTMLElement>(`[aria-rowindex="${index + 2}"] a.name`)?.focus({ preventScroll: true });
  }

  private renderNothing(): TemplateResult {
    const all = toHash({ ...this.state, query: "", verdicts: [], changes: [], causedBy: "", preset: "" });
    return html`<p class="nothing">${this.isEmpty ? "Nothing was compared." : html`Nothing matches. <a href=${all === "" ? "#" : all}>Show all</a>`}</p>`;
  }

  protected override render(): TemplateResult {
    if (this.entries.length === 0) return this.renderNothing();
    const virtualizer = this.virtualizer.getVirtualizer();
    const printing = this.print.matches;
    const shown = printing
      ? this.entries.slice(0, kPrintedRows).map((_entry, index) => ({ index, start: this.starts[index] ?? 0 }))
      : virtualizer.getVirtualItems();
    const total = this.starts[shown.length > 0 && printing ? shown.length : this.entries.length] ?? 0;
    const brief = this.compact || this.phone.matches;
    return html`
      ${brief ? listNote(this.tests, this.scales, this.compact) : nothing}
      <div class="list ${this.compact ? "compact" : ""} ${hasBaseline(this.report) ? "with-change" : ""}" role="table" aria-label=${this.state.list === "views" ? "Views" : "Materials"} aria-rowcount=${this.entries.length + 1}>
        ${this.compact ? nothing : listHead(this.report, this.state, this.scales, (patch) => this.set(patch))}
        <div class="list-scroll" role="rowgroup" tabindex="0" ${ref(this.scroller)} aria-label="Rows">
          <div class="list-all" role="presentation" .style=${`height:${total}px`}>
            ${shown.map(({ index, start }) => {
              const entry = this.entries[index];
              return entry ? this.renderEntry(entry, index, start) : nothing;
            })}
          </div>
        </div>
        ${printing && this.entries.length > kPrintedRows ? html`<p>The first ${kPrintedRows} of ${this.entries.length + this.left} rows.</p>` : nothing}
        ${this.left > 0 && !printing ? html`<p class="list-rest" role="note">${count(this.left)} more rows have no room here. Search or filter to see them.</p>` : nothing}
      </div>
    `;
  }

  private set(patch: Partial<State>): void {
    this.dispatchEvent(new CustomEvent("parity-state", { bubbles: true, detail: patch }));
  }

  private toggle(key: string): void {
    const toggled = new Set(this.toggled);
    if (!toggled.delete(key)) toggled.add(key);
    this.toggled = toggled;
  }

  private renderEntry(entry: Entry, index: number, start: number): TemplateResult {
    const style = `transform:translateY(${start}px)`;
    const hashOf = (row: Row): string => toHash(openItem(this.state, row.link));
    if (entry.kind === "group") {
      const { group, isFolded } = entry;
      return html`<div role="row" class="row group" aria-rowindex=${index + 2} .style=${style}>
        ${groupHead(group, this.state.group, this.report, isFolded, () => this.toggle(group.key), hashOf)}
      </div>`;
    }
    const row = entry;
    const isOpen = row === this.open;
    const scene: RowScene = { report: this.report, hash: hashOf(row), scales: this.scales, withChange: hasBaseline(this.report) };
    return html`<div
      role="row"
      class="row row-grid ${row.verdict.replace(" ", "-")} ${row.verdict === "pass" && row.accepted !== "" ? "accepted" : ""} ${isOpen ? "open" : ""}"
      aria-rowindex=${index + 2}
      .style=${style}
    >
      ${this.compact ? compactRow(row, scene, isOpen) : fullRow(row, scene)}
    </div>`;
  }
}

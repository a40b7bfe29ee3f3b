// One row opened: what was decided and why, and its evidence by tabs.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query } from "lit/decorators.js";

import type { Page } from "../data/page";
import { clippingText } from "../data/clipping";
import { mainApproximation } from "../data/explanation";
import { pathTitle, pathWord } from "../data/paths";
import { rowTrendOf } from "../data/row_trend";
import type { Row } from "../data/rows";
import type { SceneDetails } from "../data/scenes";
import { isSameItem, kTabs, type State, type Tab } from "../data/state";
import type { Judged } from "../data/judged";
import type { Material, Scene, View } from "../data/types";
import { countOf } from "../data/wording";
import { PageElement } from "../element";
import { count, figure, figureIn } from "../format";
import { help } from "../help";
import { kPhone, Media } from "../media";
import { baseLayerBadge, rowBadge, standingNote } from "../parts";
import { isForControl } from "../viewer/keys";
import { termLabel } from "../viewer/terms";
import "../viewer/viewer";
import type { ParityViewer } from "../viewer/viewer";
import { checkTable } from "./checks";
import { describeDropped, lightsOf } from "./dropped_lights";
import { explanationPanel } from "./explanation";
import "./history";
import { materialCard } from "./material_card";
import "./numbers";
import "./terms";

const kTabNames: Record<Tab, string> = { compare: "Compare", terms: "Terms", numbers: "Numbers", history: "History" };

@customElement("parity-item")
export class ParityItem extends PageElement {
  @property({ attribute: false }) page!: Page;
  @property({ attribute: false }) row!: Row;
  @property({ attribute: false }) details: SceneDetails | null = null; // of its scene; null: they are not here yet
  @property() problem = ""; // why they will not come; "": they may
  @property({ attribute: false }) state!: State;
  @property({ attribute: false }) scales: Readonly<Record<string, number>> = {}; // of bars, by figure
  @property() place = "";
  @query("parity-viewer") private viewer!: ParityViewer | null;
  @query("#panel") private panel!: HTMLElement | null;
  private readonly phone = new Media(this, kPhone);

  private get shownView(): View | null {
    return this.details?.scene.views[this.row.view] ?? null;
  }

  private get material(): Material | null {
    return this.row.kind === "material" ? (this.shownView?.materials[this.row.material] ?? null) : null;
  }

  private get judged(): Judged | null {
    return this.row.kind === "material" ? this.material : (this.shownView?.whole ?? null);
  }

  /** Another item, or another tab, is read from its top. */
  protected override updated(changed: PropertyValues<this>): void {
    const row = changed.get("row");
    const before = changed.get("state");
    const isOther = (row && !isSameItem(row.link, this.row.link)) || (before && before.tab !== this.state.tab);
    if (isOther) this.panel?.scrollTo(0, 0);
  }

  /** Whether the key did something here. */
  handleKey(event: KeyboardEvent): boolean {
    return this.scrollByKey(event) || (this.viewer?.handleKey(event) ?? false);
  }

  /** The panel scrolls, not the page: also where the focus is on the title above it, or on nothing. */
  private scrollByKey(event: KeyboardEvent): boolean {
    const { panel } = this;
    const by = event.key === "PageDown" ? 1 : event.key === "PageUp" ? -1 : 0;
    const target = event.target instanceof Element ? event.target : null;
    if (by === 0 || !panel || isForControl(event) || target?.closest("#panel, .list-scroll")) return false;
    panel.scrollBy({ top: by * 0.9 * panel.clientHeight });
    return true;
  }

  handleKeyUp(event: KeyboardEvent): void {
    this.viewer?.handleKeyUp(event);
  }

  /** What there is to see: the runs before this one only where they are known. */
  private get tabs(): readonly Tab[] {
    return this.page.history === null ? kTabs.filter((tab) => tab !== "history") : kTabs;
  }

  private set(patch: Partial<State>): void {
    this.dispatchEvent(new CustomEvent("parity-state", { bubbles: true, detail: patch }));
  }

  protected override render(): TemplateResult {
    const { row, state } = this;
    const scene = this.details?.scene;
    const step = (by: number) => (): boolean => this.dispatchEvent(new CustomEvent("parity-step", { detail: by }));
    const name = row.name === "" ? "(no name)" : row.name;
    return html`<article class="item" aria-labelledby="item-title">
      <nav class="item-nav" aria-label="Items">
        <button type="button" @click=${() => this.dispatchEvent(new CustomEvent("parity-close"))} title="Esc">← Overview</button>
        <span class="place">${this.place}</span>
        <button type="button" @click=${step(-1)} title="Key ↑" aria-label="Previous item">↑</button>
        <button type="button" @click=${step(1)} title="Key ↓" aria-label="Next item">↓</button>
      </nav>
      <header class="item-head">
        <h2 id="item-title" tabindex="-1" title=${name.slice(0, 400)}>${rowBadge(row)} ${baseLayerBadge(row.notModelled)} <bdi>${name}</bdi></h2>
        ${this.renderStanding()}
        ${row.accepted === "" ? nothing : html`<p class="accepted">Accepted: ${row.accepted}</p>`}
        <p class="place"><bdi>${row.place}</bdi>${scene ? html` · <bdi>${scene.environment}</bdi>${scene.sun === "none" ? nothing : html` · sun <bdi>${scene.sun}</bdi>`}` : nothing}</p>
        ${row.reason === "" || !row.isJudged ? nothing : html`<p class="reason">${row.reason}</p>`}
        ${this.renderCause()}
      </header>
      ${row.isJudged ? this.renderTabs(this.tabs.includes(state.tab) ? state.tab : "compare") : html`<p class="notice error" role="alert"><b>Not compared:</b> ${row.reason}</p>`}
    </article>`;
  }

  private renderStanding(): TemplateResult | typeof nothing {
    const note = standingNote(this.row);
    return note === nothing ? nothing : html`<p class="standing-line">${note}</p>`;
  }

  /** What makes it differ, and the preset that would help most: above the pictures on every screen. */
  private renderCause(): TemplateResult {
    const { cause, help: better, reference } = this.row;
    const flip = (value: number | null | undefined): string => figure(value ?? undefined, this.page.report.statistics["flip.mean"]);
    return html`${cause ? html`<p class="cause">Cause: <b>${cause.term}</b> (${termLabel(cause.term)}), FLIP ${flip(cause.before)} → ${flip(cause.after)}<span class="word"> with the ${pathWord(reference)} term</span>${help("worstTerm")}</p>` : nothing}
      ${this.renderApproximation()}
      ${better ? html`<p class="would-help">Would help: preset <b>${better.preset}</b> (FLIP ${flip(better.flip)}, ${better.verdict})</p>` : nothing}`;
  }

  private renderApproximation(): TemplateResult | typeof nothing {
    const explanation = this.material?.explanation;
    const most = explanation ? mainApproximation(explanation) : null;
    if (!explanation || most === null) return nothing;
    const flip = (value: number | undefined): string => figure(value, this.page.report.statistics["flip.mean"]);
    return html`<p class="approximation">Approximation: <b>${most.approximation}</b> (${flip(most.share)} of FLIP ${flip(explanation.sets[0]?.flip)})${help("approximationShare")}</p>`;
  }

  private renderTabs(tab: Tab): TemplateResult {
    const onKey = (event: KeyboardEvent): void => {
      const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
      const { tabs } = this;
      const next = tabs[(tabs.indexOf(tab) + by + tabs.length) % tabs.length];
      if (by === 0 || !next) return;
      event.preventDefault();
      event.stopPropagation();
      this.set({ tab: next });
      void this.updateComplete.then(() => this.querySelector<HTMLElement>(`#tab-${next}`)?.focus());
    };
    return html`
      <div class="tabs" role="tablist" aria-label="Evidence" @keydown=${onKey}>
        ${this.tabs.map((each) => html`<button type="button" role="tab" id="tab-${each}" aria-controls="panel" aria-selected=${each === tab ? "true" : "false"}
          tabindex=${each === tab ? 0 : -1} @click=${() => this.set({ tab: each })}>${kTabNames[each]}</button>`)}
      </div>
      <div role="tabpanel" id="panel" class="item-panel" aria-labelledby="tab-${tab}">${this.renderPanel(tab)}</div>
    `;
  }

  private renderPanel(tab: Tab): TemplateResult {
    const { details, shownView: view, judged } = this;
    if (this.problem !== "") return html`<p class="notice error" role="alert"><b>Its details cannot be shown:</b> <bdi>${this.problem}</bdi></p>`;
    if (details === null) return html`<p class="aside" role="status">Loading …</p>`;
    if (view === null || judged === null) return html`<p class="notice error" role="alert"><b>Its details cannot be shown:</b> the file of its scene does not have it.</p>`;
    if (tab === "history") return this.renderHistory(details, view, judged);
    return tab === "compare" ? this.renderCompare(details.scene, view, judged) : tab === "terms" ? this.renderTerms(details.scene) : this.renderNumbers(details, judged);
  }

  private renderHistory(details: SceneDetails, view: View, judged: Judged): TemplateResult {
    const { row, page } = this;
    const trend = rowTrendOf(details.history, row.view, row.material, view.materials.length);
    return html`<parity-history .report=${page.report} .history=${page.history} .trend=${trend} .judged=${judged} .row=${row} .view=${view.name}></parity-history>`;
  }

  private renderCompare(scene: Scene, view: View, judged: Judged): TemplateResult {
    const { report } = this.page;
    const { row } = this;
    const notes = this.material?.notes ?? [];
    const isPhone = this.phone.matches; // there the pictures come first
    return html`
      <parity-viewer .report=${report} .view=${view} .material=${row.material} .state=${this.state} .lead=${isPhone ? nothing : this.renderFacts(view, judged)}></parity-viewer>
      ${isPhone ? this.renderFacts(view, judged) : nothing}
      ${checkTable(judged, report, this.scales)}
      ${notes.length > 0 ? html`<ul class="notes">${notes.map((note) => html`<li>${note}</li>`)}</ul>` : nothing}
      ${explanationPanel(report, scene, row)}
      ${materialCard(scene, row)}
    `;
  }

  private renderFacts(view: View, judged: Judged): TemplateResult {
    const { report } = this.page;
    const { row } = this;
    const { figures } = judged;
    const value = (name: string): string => figureIn(figures, name, report.statistics);
    const clipped = clippingText(figures);
    return html`<p class="facts">
      <span><b>${row.bias === "" ? "No pixel of this view shows it." : row.bias}</b>${row.bias === "" ? nothing : help("bias")}</span>
      ${figures
        ? html`<span>FLIP${help(row.kind === "material" ? "materialFlip" : "wholeFlip")} mean ${value("flip.mean")}${help("mean")}, p95 ${value("flip.p95")}${help("p95")}, max ${value("flip.max")}${help("max")} over ${countOf(row.pixels, "pixels")}${help("pixels")}</span>`
        : nothing}
      ${figures && figures.nonFinite > 0 ? html`<span class="caution"><b>${count(figures.nonFinite)}</b> of ${countOf(figures.pixels, "pixels")} ${figures.nonFinite === 1 ? "is" : "are"} NaN or infinite</span>` : nothing}
      ${clipped === "" ? nothing : html`<span class="caution">Clipped in both pictures: <b>${clipped}</b>${help("clipping")}</span>`}
      ${row.notModelled.length === 0 ? nothing : html`<span class="caution">No path models these parts: <b><bdi>${row.notModelled.join(", ")}</bdi></b>${help("baseLayer")}</span>`}
      ${this.renderDropped(view)}
      ${this.renderDroppedLobes(view)}
    </p>`;
  }

  /** One light's effect in a line; all of them stand by the terms. */
  private renderDropped({ droppedLights: dropped }: View): TemplateResult | typeof nothing {
    const { report } = this.page;
    const { row } = this;
    if (!dropped) return nothing;
    const flip = (value: number): string => figure(value, report.statistics["flip.mean"]);
    if (row.kind !== "material") return html`<span>${describeDropped(dropped, row.test)}${help("droppedLights")}</span>`;
    const first = lightsOf(dropped, row.name)[0];
    return first ? html`<span>Dropped light: <b><bdi>${first.light.name}</bdi></b>, FLIP ${flip(first.flip)} without it${help("droppedLights")}</span>` : nothing;
  }

  /** What the test path leaves out of the material, and what that is worth. */
  private renderDroppedLobes(view: View): TemplateResult | typeof nothing {
    const { row } = this;
    const lobes = (row.kind === "material" ? view.materials[row.material]?.droppedLobes : undefined) ?? [];
    if (lobes.length === 0) return nothing;
    const flip = (value: number): string => figure(value, this.page.report.statistics["flip.mean"]);
    return html`<span>${pathTitle(view.test)} drops ${lobes.map(({ lobe, flip: without }, i) => html`${i > 0 ? " and " : ""}the <b>${lobe}</b>, FLIP ${flip(without)} without it`)}${help("droppedLobes")}</span>`;
  }

  private renderTerms(scene: Scene): TemplateResult {
    return html`<parity-terms .report=${this.page.report} .scene=${scene} .row=${this.row} .state=${this.state}></parity-terms>`;
  }

  private renderNumbers(details: SceneDetails, judged: Judged): TemplateResult {
    return html`<parity-numbers .page=${this.page} .details=${details} .judged=${judged} .row=${this.row}></parity-numbers>`;
  }
}

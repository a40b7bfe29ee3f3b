// The overview of nightly runs: charts, the chosen night, all nights, rows that changed, machines.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import type { Night, Nights } from "../data/history";
import { costLines, countLines, flipLines, lanesOf, type Lane, type Line } from "../data/night_lines";
import { remarksOf, summaryOf } from "../data/nights";
import { PageElement } from "../element";
import { count, fixed, significant } from "../format";
import { actionOf } from "../keys";
import { machinesPart } from "./machines";
import "./night";
import "./night_chart";
import { linkOf, shownBy, type Shown } from "./night_link";
import "./night_rows";
import { nightTable } from "./night_table";

interface Chart {
  label: string;
  lines: Line[];
  lanes: Lane[];
  readout: (night: Night) => string;
}

/** What is said of a night that has no part in a line. */
const apart = (night: Night): string => (night.isWhole && night.isComplete ? "" : ` (${remarksOf(night).join(", ")})`);

function chartsOf(runs: readonly Night[]): Chart[] {
  const charts: Chart[] = [
    { label: "Rows that fail and warn", lines: countLines(runs), lanes: lanesOf(runs), readout: (night) => `${count(night.failed)} failed, ${count(night.warned)} warned of ${count(night.rows)} rows; ${summaryOf(night)}` },
    {
      label: "Mean FLIP",
      lines: flipLines(runs),
      lanes: [],
      readout: (night) => `worst ${night.worst ? `${significant(night.worst.flip, 4)}, ${night.worst.row}` : "not known"}; mean ${significant(night.meanFlip ?? undefined, 4)}${apart(night)}`,
    },
    {
      label: "CPU time of a night, in seconds",
      lines: costLines(runs),
      lanes: [],
      readout: (night) => `${night.cpuS === null ? "not known" : `${fixed(night.cpuS, 1)} s`}, ${night.machine}${night.scenes > 0 ? `; ${fixed((100 * night.cachedScenes) / night.scenes, 0)} % of ${count(night.scenes)} scenes from the cache` : ""}${apart(night)}`,
    },
  ];
  return charts.filter(({ lines }) => lines.some(({ values }) => values.some((each) => each !== null)));
}

const kNoRow = { row: "", figure: "" };

@customElement("parity-nights")
export class ParityNights extends PageElement {
  @property({ attribute: false }) nights!: Nights;
  @state() private shown: Shown = shownBy(location.hash);
  @state() private isAll = false;
  private charts: Chart[] = [];
  private goTo = ""; // the element to bring into sight once it is drawn

  override connectedCallback(): void {
    super.connectedCallback();
    window.addEventListener("hashchange", this.onHash);
    window.addEventListener("keydown", this.onKey);
    if (this.shown.row !== "") this.goTo = "parity-night-row";
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.removeEventListener("hashchange", this.onHash);
    window.removeEventListener("keydown", this.onKey);
  }

  private readonly onHash = (): void => {
    const before = this.shown;
    this.shown = shownBy(location.hash);
    if (this.shown.row !== "" && this.shown.row !== before.row) this.goTo = "parity-night-row";
    else if (this.shown.night !== before.night) this.goTo = "parity-night";
  };

  private readonly onKey = (event: KeyboardEvent): void => {
    if (actionOf(event)?.kind !== "search") return;
    event.preventDefault();
    this.querySelector<HTMLInputElement>("#search")?.focus();
  };

  /** A click on a chart chooses a night. */
  private readonly onNight = (event: CustomEvent<number>): void => {
    const night = this.nights.runs[event.detail];
    if (night) location.hash = linkOf({ ...this.shown, night: night.name });
  };

  private readonly onFigure = (event: CustomEvent<string>): void => {
    history.replaceState(null, "", linkOf({ ...this.shown, figure: event.detail }));
    this.shown = shownBy(location.hash);
  };

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has("nights")) this.charts = chartsOf(this.nights.runs);
  }

  protected override updated(): void {
    if (this.goTo === "") return;
    const name = this.goTo;
    this.goTo = "";
    requestAnimationFrame(() => this.bringIntoSight(this.querySelector<HTMLElement>(name))); // what is within is drawn by then
  }

  private bringIntoSight(place: HTMLElement | null): void {
    if (!place) return;
    const { top } = place.getBoundingClientRect();
    if (top < 0 || top > 0.7 * window.innerHeight) place.scrollIntoView({ block: "start" });
    place.querySelector<HTMLElement>("[tabindex='-1']")?.focus({ preventScroll: true });
  }

  protected override render(): TemplateResult {
    const { nights, shown } = this, { runs } = nights;
    const chosen = runs.find((each) => each.name === shown.night) ?? runs.at(-1);
    if (!chosen) return html`<section><p>This history has no nights yet. <code>parity history add REPORT</code> adds one.</p></section>`;
    const place = runs.indexOf(chosen);
    return html`<section>${runs.length < 2
        ? html`<p>This is the first night: there is nothing to draw yet, and nothing to compare it with.</p>`
        : html`<div class="night-charts" @night=${this.onNight}>${this.charts.map(({ label, lines, lanes, readout }) => html`<parity-night-chart .label=${label} .runs=${runs} .lines=${lines} .lanes=${lanes} .readout=${readout} .selected=${place}></parity-night-chart>`)}</div>`}</section>
      <section class="night-panel"><parity-night .nights=${nights} .night=${chosen}></parity-night></section>
      <section><h2>Nights</h2>${nightTable(runs, chosen, shown, this.isAll, () => (this.isAll = true))}</section>
      <section @figure=${this.onFigure}><h2>Rows that changed ${shown.row === "" ? nothing : html`<a class="close-row" href=${linkOf({ ...shown, ...kNoRow })}>Show none</a>`}</h2>
        ${Object.keys(nights.rows).length === 0 ? html`<p>None.</p>` : html`<parity-night-rows .nights=${nights} .shown=${shown}></parity-night-rows>`}</section>
      ${machinesPart(nights, shown)}`;
  }
}

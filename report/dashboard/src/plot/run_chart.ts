// Figures over the runs: a step for each run, a gap where a run has no value, a mark where something changed, and lines
// at the limits. A table below it says the same.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";
import uPlot from "uplot";

import type { EarlierRun, TrendChange } from "../data/history";
import { changeWords, dayOf, labelledPlaces, limitLines, placesOf, rangeOfValues, runTitle, stepsOf, valueAt, type ChartLimits, type ChartSeries } from "../data/trends";
import { countOf } from "../data/wording";
import { significant } from "../format";
import { PlotElement } from "./plot_element";

const kLabelWidth = 58; // px that a date takes
const kColors = ["--accent", "--error", "--pass", "--not-judged"]; // of the series, variables of tokens.css
const kDashes = [[], [8, 4], [2, 3], [8, 3, 2, 3]]; // so that colour alone does not tell them apart
const kChangeColors: Readonly<Record<TrendChange["kind"], string>> = {
  regressed: "--fail", crashed: "--error", nondeterministic: "--error", fixed: "--pass", changed: "--muted", new: "--muted", gone: "--muted",
};
const kToday = "this run";

@customElement("parity-run-chart")
export class ParityRunChart extends PlotElement {
  @property({ attribute: false }) runs: readonly EarlierRun[] = []; // oldest first
  @property({ attribute: false }) series: readonly ChartSeries[] = [];
  @property({ attribute: false }) changes: readonly TrendChange[] = [];
  @property({ attribute: false }) limits: ChartLimits | null = null;
  @property() unit = ""; // behind the numbers
  @property({ attribute: false }) format: (value: number | null) => string = (value) => (value === null ? "not a number" : significant(value, 4));
  @query(".plot") private place!: HTMLElement | null;
  @state() private at = -1; // the run that is pointed at; -1: none

  protected readonly plotHeight = 210;

  private get places(): number {
    return placesOf(this.runs.length, this.series);
  }

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has("runs") || changed.has("series")) this.at = -1;
  }

  protected override updated(changed: PropertyValues<this>): void {
    const isOther = (["runs", "series", "changes", "limits", "unit", "format"] as const).some((name) => changed.has(name));
    const { place } = this;
    if (place === null) this.drop();
    else if (isOther || !this.isDrawnIn(place)) this.hold(place, () => this.makePlot(place));
  }

  private text(value: number | null): string {
    return this.unit === "" || value === null ? this.format(value) : `${this.format(value)} ${this.unit}`;
  }

  private makePlot(place: HTMLElement): uPlot {
    const { x, y } = stepsOf(this.runs.length, this.series);
    const lines = limitLines(this.limits, this.series);
    const range = rangeOfValues([...y.flat(), ...lines.map(({ value }) => value)]);
    const axis = { stroke: () => this.color("--muted"), ticks: { stroke: () => this.color("--line"), width: 1, size: 5 }, font: "12px system-ui" };
    return new uPlot(
      {
        ...this.sizeIn(place),
        padding: [10, 30, 0, 0],
        scales: { x: { time: false, range: [-0.6, this.places - 0.4] }, y: { range } },
        axes: [
          {
            ...axis, size: 30, grid: { show: false },
            splits: (plot) => labelledPlaces(this.places, Math.floor(plot.width / kLabelWidth)),
            values: (_, splits) => splits.map((run) => (run === this.runs.length ? kToday : dayOf(this.runs[run]).slice(5))),
          },
          { ...axis, size: 56, grid: { stroke: () => this.color("--line"), width: 1 }, values: (_, splits) => splits.map((value) => significant(value, 3)) },
        ],
        series: [
          {},
          ...this.series.map(({ label }, i) => ({
            label, width: 2, stroke: () => this.color(kColors[i % kColors.length]!), dash: kDashes[i % kDashes.length]!, points: { show: false }, spanGaps: false,
          })),
        ],
        legend: { show: false },
        cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
        hooks: { drawAxes: [(plot) => this.drawMarks(plot, lines)], draw: [(plot) => this.drawToday(plot)], setCursor: [(plot) => this.point(plot)] },
      },
      [x, ...y],
      place,
    );
  }

  /** Limits as lines across, changes as lines down with a triangle on top. */
  private drawMarks(plot: uPlot, limits: readonly { kind: "warn" | "fail"; value: number }[]): void {
    const { ctx, bbox } = plot;
    const scale = devicePixelRatio;
    const line = (x0: number, y0: number, x1: number, y1: number, color: string, dash: number[]): void => {
      ctx.strokeStyle = this.color(color);
      ctx.setLineDash(dash.map((n) => n * scale));
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x1, y1);
      ctx.stroke();
    };
    ctx.save();
    ctx.lineWidth = 1.5 * scale;
    for (const { kind, value } of limits) {
      const y = plot.valToPos(value, "y", true);
      line(bbox.left, y, bbox.left + bbox.width, y, `--${kind}`, kind === "warn" ? [6, 4] : [2, 3]);
    }
    for (const { run, kind } of this.changes) {
      const x = plot.valToPos(run - 0.5, "x", true);
      line(x, bbox.top, x, bbox.top + bbox.height, kChangeColors[kind], [1, 3]);
      ctx.fillStyle = this.color(kChangeColors[kind]);
      ctx.beginPath();
      ctx.moveTo(x - 5 * scale, bbox.top - 8 * scale);
      ctx.lineTo(x + 5 * scale, bbox.top - 8 * scale);
      ctx.lineTo(x, bbox.top);
      ctx.fill();
    }
    ctx.restore();
  }

  /** A dot for today's value, which is a step like others besides. */
  private drawToday(plot: uPlot): void {
    const { ctx } = plot;
    ctx.save();
    this.series.forEach(({ today }, i) => {
      if (today === undefined || today === null) return;
      ctx.fillStyle = this.color(kColors[i % kColors.length]!);
      ctx.beginPath();
      ctx.arc(plot.valToPos(this.runs.length, "x", true), plot.valToPos(today, "y", true), 4.5 * devicePixelRatio, 0, 2 * Math.PI);
      ctx.fill();
    });
    ctx.restore();
  }

  private point(plot: uPlot): void {
    const { left } = plot.cursor;
    const at = left === undefined || left < 0 ? -1 : Math.round(plot.posToVal(left, "x"));
    this.at = at >= 0 && at < this.places ? at : -1;
  }

  private readonly onKey = (event: KeyboardEvent): void => {
    const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (by === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const next = this.at < 0 ? this.places - 1 : Math.min(Math.max(this.at + by, 0), this.places - 1);
    this.plot?.setCursor({ left: this.plot.valToPos(next, "x"), top: 0 });
  };

  /** "2026-11-21, 010e2b14a553: 0.1713; regressed, cause: asset" */
  private readout(run: number): string {
    const values = this.series.map(({ label, spans, today }) => {
      const value = run === this.runs.length ? today : valueAt(spans, run);
      const text = value === undefined ? "no value" : this.text(value);
      return this.series.length > 1 ? `${label} ${text}` : text;
    });
    const changes = this.changes.filter((change) => change.run === run).map(changeWords);
    return `${run === this.runs.length ? kToday : runTitle(this.runs[run])}: ${[values.join(", "), ...changes].join("; ")}`;
  }

  private renderTable(): TemplateResult {
    const day = (run: number): string => runTitle(this.runs[run]);
    const rows = this.series.map(({ label, spans, today }) => {
      const name = this.series.length > 1 ? html`<td>${label}</td>` : nothing;
      return html`${spans.map(([first, last, value]) => html`<tr><th scope="row">${day(first)}</th><td>${first === last ? "" : day(last)}</td>${name}<td class="number">${last - first + 1}</td><td class="number">${this.text(value)}</td></tr>`)}
        ${today === undefined ? nothing : html`<tr><th scope="row">${kToday}</th><td></td>${name}<td class="number">1</td><td class="number">${this.text(today)}</td></tr>`}`;
    });
    return html`<details class="chart-table"><summary>The chart as a table</summary><div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
      <thead><tr><th scope="col">from</th><th scope="col">to</th>${this.series.length > 1 ? html`<th scope="col">figure</th>` : nothing}<th scope="col">runs</th><th scope="col">value</th></tr></thead>
      <tbody>${rows}</tbody></table></div></details>`;
  }

  protected override render(): TemplateResult {
    if (this.places === 0 || this.series.length === 0) return html`<p class="aside">There is no value to draw.</p>`;
    const { limits } = this;
    const limit = (kind: "warn" | "fail", verb: string): TemplateResult | typeof nothing => {
      const value = limits?.[kind] ?? null;
      return value === null ? nothing : html`<li><i class="line ${kind}" aria-hidden="true"></i>${verb} ${limits?.isAbsolute === true ? "±" : ""}${this.text(value).replace(/^\+/, "")}</li>`;
    };
    const names = this.series.map(({ label }) => label).join(", ");
    return html`<div class="run-chart">
      <div class="plot" role="img" tabindex="0" @keydown=${this.onKey}
        aria-label=${`${names} over ${countOf(this.runs.length, "runs")}, ${countOf(this.changes.length, "changes")}. The table below has all values.`}></div>
      <p class="aside chart-at" role="status">${this.at < 0 ? "Point at a run." : this.readout(this.at)}</p>
      <ul class="marks">
        ${this.series.length > 1 ? this.series.map(({ label }, i) => html`<li><i class="line series-${i % kColors.length}" aria-hidden="true"></i>${label}</li>`) : nothing}
        ${limit("warn", "warns")}${limit("fail", "fails")}
        ${this.changes.length > 0 ? html`<li><i class="change" aria-hidden="true">▼</i> something changed</li>` : nothing}
      </ul>
      ${this.renderTable()}
    </div>`;
  }
}

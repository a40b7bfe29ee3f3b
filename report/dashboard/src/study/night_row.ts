// One row over the nights: a figure, its verdicts, and its changes with their causes.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import type { Nights, Trend, TrendChange, VerdictSpan } from "../data/history";
import { figuresOf } from "../data/nights";
import { dayOf } from "../data/trends";
import type { ChartSeries } from "../data/trends";
import { countOf } from "../data/wording";
import { PageElement } from "../element";
import "../plot/run_chart";
import { badge } from "../parts";
import { causeOf, figureChange, kindBadge, otherFigures } from "./change_words";
import { linkOf, type Shown } from "./night_link";
import { table } from "./table";

const kFirstSpans = 12; // the newest verdicts that are shown at first

/** Fires "figure" with the name of a figure that was chosen. */
@customElement("parity-night-row")
export class ParityNightRow extends PageElement {
  @property({ attribute: false }) nights!: Nights;
  @property({ attribute: false }) shown!: Shown;
  @state() private isAll = false;
  private trend: Trend | undefined;
  private figure = "";
  private series: readonly ChartSeries[] = [];

  protected override willUpdate(changed: PropertyValues<this>): void {
    const { row, figure } = this.shown;
    const trend = Object.hasOwn(this.nights.rows, row) ? this.nights.rows[row] : undefined; // a link may name anything
    if (changed.has("nights") || trend !== this.trend) this.isAll = false;
    const figures = trend ? figuresOf(trend) : [];
    const chosen = figures.includes(figure) ? figure : (figures[0] ?? "");
    if (trend === this.trend && chosen === this.figure) return; // the chart is made anew only for other values
    this.trend = trend;
    this.figure = chosen;
    this.series = trend && chosen !== "" ? [{ label: chosen, spans: trend.figures[chosen] ?? [] }] : [];
  }

  private readonly onFigure = (event: Event): void => {
    this.dispatchEvent(new CustomEvent("figure", { detail: (event.target as HTMLSelectElement).value, bubbles: true }));
  };

  /** A link to a night, by its place in the runs. */
  private night(run: number): TemplateResult {
    const night = this.nights.runs[run];
    return night ? html`<a class="whole" href=${linkOf({ ...this.shown, night: night.name })}>${dayOf(night)}</a>` : html`–`;
  }

  private verdicts(spans: readonly VerdictSpan[]): TemplateResult | typeof nothing {
    if (spans.length === 0) return nothing;
    const newest = [...spans].reverse(), shown = this.isAll ? newest : newest.slice(0, kFirstSpans);
    return html`<h3>Verdicts</h3>
      <ul class="verdict-spans">
        ${shown.map(([first, last, verdict]) => html`<li>${badge(verdict)} <span>${this.night(first)}${first === last ? nothing : html` to ${this.night(last)}`}</span> <small>${countOf(last - first + 1, "nights")}</small></li>`)}
        ${shown.length < newest.length ? html`<li><button type="button" @click=${() => (this.isAll = true)}>Show all ${newest.length}</button></li>` : nothing}
      </ul>`;
  }

  private changes(changes: readonly TrendChange[]): TemplateResult {
    const { runs, statistics } = this.nights;
    return html`<h3>Changes</h3>
      ${table<TrendChange>("Changes of the row", [...changes].reverse(), [
        { label: "night", isText: true, value: (each) => each.run, show: (each) => this.night(each.run) },
        { label: "what happened", isText: true, value: (each) => each.kind, show: (each) => kindBadge(each.kind) },
        { label: "figure that changed most", isText: true, value: (each) => each.metric, show: (each) => figureChange(each, statistics) },
        { label: "others", isText: true, value: (each) => each.figures, show: (each) => html`<span class="whole">${otherFigures(each)}</span>` },
        { label: "cause", isText: true, value: causeOf },
        { label: "commit", isText: true, value: (each) => runs[each.run]?.commit, show: (each) => html`<code>${runs[each.run]?.commit.slice(0, 12) ?? ""}</code>` },
      ])}`;
  }

  protected override render(): TemplateResult {
    const { trend, nights } = this, { row } = this.shown;
    if (!trend) return html`<h3 tabindex="-1"><bdi>${row}</bdi></h3><p>This page knows no changes of this row.</p>`;
    const verdict = trend.verdicts.at(-1)?.[2];
    return html`<h3 tabindex="-1"><bdi>${row}</bdi> ${verdict ? badge(verdict) : nothing}</h3>
      ${this.series.length === 0 ? html`<p class="aside">No figure of it is known.</p>` : html`
        <label class="select">Figure <select @change=${this.onFigure}>${figuresOf(trend).map((each) => html`<option value=${each} ?selected=${each === this.figure}>${each}</option>`)}</select></label>
        ${nights.runs.length < 2 ? nothing : html`<parity-run-chart .runs=${nights.runs} .series=${this.series} .changes=${trend.changes}></parity-run-chart>`}`}
      ${this.verdicts(trend.verdicts)}${this.changes(trend.changes)}`;
  }
}

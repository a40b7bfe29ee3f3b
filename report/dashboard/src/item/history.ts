// What the runs before this one say of a row: since when it is as it is and why, its figures as a chart, all changes, its
// verdicts, and the pictures of the state that was approved.
import { html, nothing, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import type { EarlierRuns, RowTrend, TrendChange } from "../data/history";
import { imageSource } from "../data/images";
import type { Judged } from "../data/judged";
import type { Head } from "../data/page";
import { pathTitle } from "../data/paths";
import { figuresOf, trendSentence } from "../data/row_trend";
import type { Row } from "../data/rows";
import { runTitle, type ChartLimits } from "../data/trends";
import type { Images, Verdict } from "../data/types";
import { PageElement } from "../element";
import { figure } from "../format";
import { help } from "../help";
import { badge } from "../parts";
import "../plot/run_chart";
import { approvePart } from "./approve";

const kMostChanges = 200; // of thousands nobody reads more

@customElement("parity-history")
export class ParityHistory extends PageElement {
  @property({ attribute: false }) report!: Head;
  @property({ attribute: false }) history!: EarlierRuns;
  @property({ attribute: false }) trend: RowTrend | null = null; // null: no earlier run has the row
  @property({ attribute: false }) judged!: Judged;
  @property({ attribute: false }) row!: Row;
  @property() view = ""; // its name
  @state() private metric = ""; // that is drawn; "" or unknown: the first

  private run(place: number): string {
    return runTitle(this.history.runs[place]);
  }

  private text(metric: string, value: number | null): string {
    const { statistics } = this.report;
    return value === null && statistics[metric]?.better !== "higher" ? "not a number" : figure(value, statistics[metric]);
  }

  private label(metric: string): string {
    return this.report.statistics[metric]?.label ?? metric;
  }

  private limits(metric: string): ChartLimits | null {
    const check = this.judged.checks.find((each) => each.metric === metric && !each.regress);
    return check ? { warn: check.warn, fail: check.fail, isAbsolute: this.report.statistics[metric]?.better === "near zero" } : null;
  }

  private renderChart(trend: RowTrend): TemplateResult {
    const figures = figuresOf(trend);
    const metric = figures.includes(this.metric) ? this.metric : (figures[0] ?? "");
    if (metric === "") return html`<p class="aside">The runs have no figure of it.</p>`;
    const today = this.judged.figures?.metrics[metric];
    const series = [{ label: this.label(metric), spans: trend.figures[metric] ?? [], ...(today === undefined ? {} : { today }) }];
    return html`<section>
      <h3>Figures over the runs ${help("overRuns")}</h3>
      <label class="select">Figure
        <select @change=${(event: Event) => (this.metric = (event.target as HTMLSelectElement).value)}>
          ${figures.map((each) => html`<option value=${each} ?selected=${each === metric}>${this.label(each)}</option>`)}
        </select></label>
      <parity-run-chart .runs=${this.history.runs} .series=${series} .changes=${trend.changes} .limits=${this.limits(metric)}
        .format=${(value: number | null) => this.text(metric, value)}></parity-run-chart>
    </section>`;
  }

  private renderChanges({ changes }: RowTrend): TemplateResult {
    if (changes.length === 0) return html`<section><h3>Changes</h3><p class="aside">Nothing has changed in the runs that are known.</p></section>`;
    const line = ({ run, kind, cause, metric, before, after, figures }: TrendChange): TemplateResult => {
      const values = metric === "" ? nothing : html`${this.label(metric)} <span class="number">${before === null ? "–" : this.text(metric, before)} → ${after === null ? "–" : this.text(metric, after)}</span>${figures > 1 ? html` <small>and ${figures - 1} more</small>` : nothing}`;
      return html`<tr><th scope="row">${this.run(run)}</th><td class="kind ${kind}">${kind}</td><td>${values}</td><td><bdi>${cause === "" ? "not known" : cause}</bdi></td></tr>`;
    };
    const newest = [...changes].reverse();
    return html`<section><h3>Changes</h3><div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
      <thead><tr><th scope="col">run, commit</th><th scope="col">what</th><th scope="col">figure that changed most</th><th scope="col">cause</th></tr></thead>
      <tbody>${newest.slice(0, kMostChanges).map(line)}</tbody></table></div>
      ${newest.length > kMostChanges ? html`<p class="aside">and ${newest.length - kMostChanges} older ones</p>` : nothing}</section>`;
  }

  private renderVerdicts({ verdicts }: RowTrend): TemplateResult {
    const today = this.row.verdict;
    const runs = this.history.runs.length;
    const blocks: { length: number; verdict: Verdict | "" }[] = [];
    let next = 0;
    for (const [first, last, verdict] of verdicts) {
      if (first > next) blocks.push({ length: first - next, verdict: "" });
      blocks.push({ length: last - first + 1, verdict });
      next = last + 1;
    }
    if (next < runs) blocks.push({ length: runs - next, verdict: "" });
    blocks.push({ length: 1, verdict: today });
    const line = (title: string, end: string, count: number, verdict: Verdict): TemplateResult =>
      html`<tr><th scope="row">${title}</th><td>${end}</td><td class="number">${count}</td><td>${badge(verdict)}</td></tr>`;
    return html`<section><h3>Verdicts</h3>
      <div class="verdict-strip" aria-hidden="true">${blocks.map(({ length, verdict }) => html`<i class=${verdict === "" ? "none" : verdict.replace(" ", "-")} .style=${`flex-grow:${length}`}></i>`)}</div>
      <div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
        <thead><tr><th scope="col">from</th><th scope="col">to</th><th scope="col">runs</th><th scope="col">verdict</th></tr></thead>
        <tbody>${line("this run", "", 1, today)}
          ${[...verdicts].reverse().slice(0, kMostChanges).map(([first, last, verdict]) => line(this.run(first), first === last ? "" : this.run(last), last - first + 1, verdict))}</tbody>
      </table></div></section>`;
  }

  /** "Approved as in the run of 2026-11-02, 010e2b14a553, by characters: refit in sprint 12" */
  private renderApproved({ approved }: RowTrend): TemplateResult | typeof nothing {
    const now = this.row.images;
    if (!approved || now === null) return nothing;
    const approval = this.judged.checks.find((check) => check.approval)?.approval;
    const by = approval ? html`, by <bdi>${approval.owner}</bdi>: <bdi>${approval.reason}</bdi>` : nothing;
    const pictures = (images: Images, when: string): TemplateResult => {
      const picture = (path: string, what: string): TemplateResult =>
        path === "" ? html`<span></span>` : html`<figure><a href=${imageSource(path)}><img src=${imageSource(path)} alt=${`${what}, ${when}`} loading="lazy" decoding="async" /></a><figcaption>${what}</figcaption></figure>`;
      return html`${picture(images.reference, pathTitle(this.row.reference))}${picture(images.test, pathTitle(this.row.test))}${picture(images.flip, "FLIP map")}`;
    };
    return html`<section class="approved"><h3>The approved state</h3>
      <div class="pictures"><p>Approved as in the run of ${this.run(approved.run)}${by}</p>${pictures(approved.images, "approved")}
        <p>This run</p>${pictures(now, "this run")}</div></section>`;
  }

  protected override render(): TemplateResult {
    const { trend, row, judged } = this;
    const approve = approvePart(row, judged, this.view);
    if (trend === null) return html`<div class="runs"><p class="trend-head">No earlier run has this row.</p>${approve}</div>`;
    return html`<div class="runs">
      <p class="trend-head">${trendSentence(row, trend, this.history.runs)}</p>
      ${this.renderChart(trend)}${this.renderApproved(trend)}${this.renderChanges(trend)}${this.renderVerdicts(trend)}${approve}
    </div>`;
  }
}

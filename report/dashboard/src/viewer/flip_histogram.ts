// How FLIP is spread over the pixels of the view or the material, with the budget of its mean.
import { html, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query } from "lit/decorators.js";
import uPlot from "uplot";

import type { Plane } from "../data/chunk";
import { makeHistogram, type Histogram } from "../data/histogram";
import type { Check } from "../data/types";
import { countOf } from "../data/wording";
import { count, fixed } from "../format";
import { help } from "../help";
import { PlotElement } from "../plot/plot_element";

const kBins = 100;

interface Mark {
  value: number;
  label: string;
  color: string; // a variable of tokens.css
  dash: number[];
}

/** Where the mean is, and where its budget warns and fails. */
export function marksOf(histogram: Histogram, checks: readonly Check[], threshold: number): Mark[] {
  const marks: Mark[] = [];
  const add = (value: number | null, label: string, color: string, dash: number[]): void => {
    const isKnown = marks.some((mark) => mark.value === value && mark.label.startsWith(label));
    if (value !== null && value >= 0 && value <= 1 && !isKnown)
      marks.push({ value, label: `${label} ${fixed(value, 3)}`, color, dash });
  };
  if (histogram.total > 0) add(histogram.mean, "mean", "--accent", []);
  for (const check of checks) {
    if (check.metric !== "flip.mean" || check.regress) continue;
    add(check.warn, "warns", "--warn", [6, 4]);
    add(check.fail, "fails", "--fail", [2, 3]);
  }
  if (threshold > 0) add(threshold, "threshold", "--muted", [8, 3, 2, 3]);
  return marks;
}

@customElement("parity-flip-histogram")
export class ParityFlipHistogram extends PlotElement {
  @property({ attribute: false }) flip: Plane | null = null;
  @property({ attribute: false }) materials: Plane | null = null;
  @property({ attribute: false }) material = -1;
  @property({ attribute: false }) checks: Check[] = [];
  @property({ attribute: false }) threshold = 0;
  @property({ attribute: false }) message = "";
  @query(".plot") private place!: HTMLElement | null;

  private histogram: Histogram | null = null;
  private marks: Mark[] = [];
  protected readonly plotHeight = 190;

  protected override willUpdate(changed: PropertyValues<this>): void {
    const isOther = changed.has("flip") || changed.has("materials") || changed.has("material");
    if (isOther)
      this.histogram =
        this.flip && makeHistogram(this.flip.values, this.materials?.values ?? null, this.material, kBins);
    if (this.histogram) this.marks = marksOf(this.histogram, this.checks, this.threshold);
  }

  protected override updated(): void {
    const { place } = this;
    if (place === null || this.histogram === null) {
      this.drop();
      return;
    }
    const data = this.dataOf(this.histogram);
    if (this.isDrawnIn(place)) this.plot?.setData(data);
    else this.hold(place, () => this.makePlot(data, place));
  }

  /** A bin without pixels has no place on a logarithmic axis. */
  private dataOf({ counts }: Histogram): uPlot.AlignedData {
    return [counts.map((_, i) => (i + 0.5) / counts.length), counts.map((n) => (n === 0 ? null : n))];
  }

  private makePlot(data: uPlot.AlignedData, place: HTMLElement): uPlot {
    const axis = {
      stroke: () => this.color("--muted"),
      grid: { stroke: () => this.color("--line"), width: 1 },
      ticks: { stroke: () => this.color("--line"), width: 1 },
      font: "12px system-ui",
    };
    const bars = uPlot.paths.bars?.({ size: [1, Infinity], gap: 0 });
    return new uPlot(
      {
        ...this.sizeIn(place),
        scales: {
          x: { time: false, range: [0, 1] },
          y: { distr: 3, range: (_, __, most) => [0.7, Math.max(most, 10) * 1.4] },
        },
        axes: [
          { ...axis, size: 28 },
          {
            ...axis,
            size: 56,
            values: (_, splits) =>
              splits.map((n) => (n !== null && n >= 1 && Number.isInteger(Math.log10(n)) ? count(n) : "")),
          },
        ],
        series: [
          {},
          {
            label: "pixels",
            fill: () => this.color("--muted"),
            width: 0,
            points: { show: false },
            ...(bars ? { paths: bars } : {}),
          },
        ],
        legend: { show: false },
        cursor: { show: false },
        hooks: { draw: [(plot) => this.drawMarks(plot)] },
      },
      data,
      place,
    );
  }

  private drawMarks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.lineWidth = 2 * devicePixelRatio;
    for (const mark of this.marks) {
      const x = plot.valToPos(mark.value, "x", true);
      ctx.strokeStyle = this.color(mark.color);
      ctx.setLineDash(mark.dash.map((n) => n * devicePixelRatio));
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
    ctx.restore();
  }

  /** The same in a sentence, for whoever does not see the plot. */
  private get summary(): string {
    const h = this.histogram;
    if (h === null || h.total === 0) return "No pixel counts.";
    return `${countOf(h.total, "pixels")}: median ${fixed(h.median, 3)}, p95 ${fixed(h.p95, 3)}, max ${fixed(h.max, 3)}, mean ${fixed(h.mean, 3)}.`;
  }

  protected override render(): TemplateResult {
    return html`<section class="histogram">
      <h3>FLIP of the pixels${help("histogram")}</h3>
      ${this.flip === null
        ? html`<p class="aside">${this.message === "" ? "Loading…" : this.message}</p>`
        : html`<div
              class="plot"
              role="img"
              aria-label=${`Histogram of FLIP, logarithmic counts. ${this.summary}`}
            ></div>
            <ul class="marks">
              ${this.marks.map(
                (mark) =>
                  html`<li><i class="line ${mark.label.split(" ")[0]}" aria-hidden="true"></i>${mark.label}</li>`,
              )}
            </ul>
            <p class="aside">${this.summary}</p>`}
    </section>`;
  }
}

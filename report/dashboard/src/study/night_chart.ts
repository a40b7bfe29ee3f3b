// Lines over the nights, with lanes of what happened above them. All charts of a page share one cursor and one selected night.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";
import uPlot from "uplot";

import type { Night } from "../data/history";
import type { Lane, Line } from "../data/night_lines";
import { dayOf } from "../data/trends";
import { PlotElement } from "../plot/plot_element";

const kLaneHeight = 9;

/** How many digits a label of the axis needs to differ from its neighbours. */
const digitsOf = (step: number): number => Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));

/** Fires "night" with the place of a run that was clicked. */
@customElement("parity-night-chart")
export class ParityNightChart extends PlotElement {
  @property() label = "";
  @property({ attribute: false }) runs: readonly Night[] = [];
  @property({ attribute: false }) lines: readonly Line[] = [];
  @property({ attribute: false }) lanes: readonly Lane[] = [];
  @property({ attribute: false }) selected = -1;
  @property({ attribute: false }) readout: (night: Night) => string = () => "";
  @query(".plot") private place!: HTMLElement;
  @state() private at: number | null = null; // the run that is pointed at

  protected readonly plotHeight = 170;

  protected override updated(changed: PropertyValues<this>): void {
    if (this.plot === null || changed.has("lines") || changed.has("runs") || changed.has("lanes")) {
      this.hold(this.place, () => this.makePlot());
    } else if (changed.has("selected")) {
      this.redraw();
    }
  }

  private seriesOf({ label, color, dash, isScattered }: Line): uPlot.Series {
    const stroke = (): string => this.color(color);
    return {
      label,
      stroke,
      width: isScattered ? 0 : 1.5,
      ...(dash ? { dash: [...dash] } : {}),
      spanGaps: true,
      points: { show: isScattered === true || this.runs.length < 40, size: isScattered ? 5 : 4, width: 0, stroke, fill: stroke },
    };
  }

  private makePlot(): uPlot {
    const axis = {
      stroke: () => this.color("--muted"),
      grid: { stroke: () => this.color("--line"), width: 1 },
      ticks: { stroke: () => this.color("--line"), width: 1, size: 4 },
      font: "12px system-ui",
    };
    const plot = new uPlot(
      {
        ...this.sizeIn(this.place),
        padding: [8 + kLaneHeight * this.lanes.length, 12, 0, 0],
        scales: {
          x: { time: false, range: [-0.5, this.runs.length - 0.5] },
          y: { range: (_, __, most) => [0, most > 0 ? most * 1.06 : 1] },
        },
        axes: [
          { ...axis, size: 26, space: 56, incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000], values: (_, splits) => splits.map((run) => this.runs[run]?.started.slice(5, 10) ?? "") },
          { ...axis, size: 56, space: 34, values: (_, splits, __, ___, step) => splits.map((value) => value.toFixed(digitsOf(step))) },
        ],
        series: [{}, ...this.lines.map((each) => this.seriesOf(each))],
        legend: { show: false },
        cursor: { y: false, drag: { x: false, y: false }, points: { show: false }, sync: { key: "nights", setSeries: false } },
        hooks: { setCursor: [({ cursor }) => (this.at = cursor.idx ?? null)], draw: [(drawn) => this.drawMarks(drawn)] },
      },
      [this.runs.map((_, run) => run), ...this.lines.map((each) => each.values)],
      this.place,
    );
    plot.over.addEventListener("click", () => {
      const { idx } = plot.cursor;
      if (typeof idx === "number") this.dispatchEvent(new CustomEvent("night", { detail: idx, bubbles: true }));
    });
    return plot;
  }

  private drawMarks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const pixel = devicePixelRatio;
    const width = Math.max(1.5 * pixel, Math.min(7 * pixel, (bbox.width / Math.max(1, this.runs.length)) * 0.8));
    const x = (run: number): number => plot.valToPos(run, "x", true);
    ctx.save();
    this.lanes.forEach((lane, place) => {
      ctx.fillStyle = this.color(lane.color);
      const top = bbox.top - (this.lanes.length - place) * kLaneHeight * pixel;
      for (const run of lane.runs) ctx.fillRect(x(run) - width / 2, top, width, (kLaneHeight - 3) * pixel);
    });
    if (this.selected >= 0) {
      ctx.strokeStyle = this.color("--text");
      ctx.lineWidth = pixel;
      ctx.setLineDash([3 * pixel, 3 * pixel]);
      ctx.beginPath();
      ctx.moveTo(x(this.selected), bbox.top);
      ctx.lineTo(x(this.selected), bbox.top + bbox.height);
      ctx.stroke();
    }
    ctx.restore();
  }

  protected override render(): TemplateResult {
    const night = this.runs[this.at ?? this.selected] ?? this.runs.at(-1);
    const text = night ? `${dayOf(night)}: ${this.readout(night)}` : "";
    return html`<section class="night-chart">
      <h3>${this.label}</h3>
      <ul class="night-keys">
        ${this.lines.map((each) => html`<li><i class="key ${each.isScattered ? "dot" : each.dash ? "dashed" : "line"} color${each.color}" aria-hidden="true"></i>${each.label}</li>`)}
        ${this.lanes.length === 0 ? nothing : html`<li class="lanes">above, from the top:</li>`}
        ${this.lanes.map((each) => html`<li><i class="key mark color${each.color}" aria-hidden="true"></i>${each.kind}</li>`)}
      </ul>
      <div class="plot" role="img" aria-label=${`${this.label} over ${this.runs.length} nights. ${text}`}></div>
      <p class="aside night-readout" aria-hidden="true">${text}</p>
    </section>`;
  }
}

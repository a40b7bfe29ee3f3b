// Time against error of every setting of a bench, by scene; the settings that none beats are joined by a line.
import { html, LitElement, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import type { Bench, BenchPoint, BenchScene } from "../data/bench";
import { fixed } from "../format";

/** The points that none beats in both, by time. */
export function frontOf(points: readonly BenchPoint[]): BenchPoint[] {
  const sorted = [...points].sort((a, b) => a.timeMs - b.timeMs || a.error - b.error);
  let least = Infinity;
  return sorted.filter((point) => {
    if (point.error >= least) return false;
    least = point.error;
    return true;
  });
}

/** uPlot wants one list of x: each path's points at their places in it, null elsewhere; the front as a series of its own. */
export function seriesOf(points: readonly BenchPoint[], paths: readonly string[]): { x: number[]; ys: (number | null)[][]; sorted: BenchPoint[] } {
  const sorted = [...points].sort((a, b) => a.timeMs - b.timeMs);
  const front = new Set(paths.flatMap((path) => frontOf(points.filter((point) => point.path === path))));
  const ys = paths.flatMap((path) => [
    sorted.map((point) => (point.path === path ? point.error : null)),
    sorted.map((point) => (point.path === path && front.has(point) ? point.error : null)),
  ]);
  return { x: sorted.map((point) => point.timeMs), ys, sorted };
}

@customElement("parity-bench-plot")
export class ParityBenchPlot extends LitElement {
  @property({ attribute: false }) bench!: Bench;
  @property() scene = "";
  @query(".plot") private place!: HTMLElement | null;
  @state() private hovered: BenchPoint | null = null;
  private plot: uPlot | null = null;

  protected override createRenderRoot(): this {
    return this;
  }

  private get data(): BenchScene | undefined {
    return this.bench.scenes.find((each) => each.name === this.scene);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.plot?.destroy();
    this.plot = null;
  }

  protected override willUpdate(changed: PropertyValues): void {
    if (changed.has("bench") || changed.has("scene")) this.hovered = null;
  }

  protected override updated(changed: PropertyValues): void {
    if (!changed.has("bench") && !changed.has("scene")) return;
    this.plot?.destroy();
    this.plot = null;
    const data = this.data;
    if (data && this.place) this.draw(data, this.place);
  }

  private draw(data: BenchScene, place: HTMLElement): void {
    const paths = [...new Set(data.points.map((point) => point.path))];
    const { x, ys, sorted } = seriesOf(data.points, paths);
    const style = getComputedStyle(this);
    const colors = [style.getPropertyValue("--accent"), style.getPropertyValue("--warn"), style.getPropertyValue("--error")];
    const axis = { stroke: style.getPropertyValue("--muted"), grid: { stroke: style.getPropertyValue("--line"), width: 1 } };
    const series: uPlot.Series[] = paths.flatMap((path, index) => {
      const stroke = colors[index % colors.length] ?? "";
      return [
        { label: path, stroke, paths: () => null, points: { show: true, size: 7, fill: stroke } },
        { label: `${path}, unbeaten`, stroke, width: 1.5, dash: [4, 3], spanGaps: true, points: { show: false } },
      ];
    });
    this.plot = new uPlot(
      {
        width: Math.max(280, place.clientWidth),
        height: 320,
        scales: { x: { time: false, distr: 3, range: (_plot, least, most) => [least * 0.9, most * 1.1] }, y: { auto: true } },
        axes: [{ ...axis, label: "device time, ms" }, { ...axis, label: `${this.bench.figure} against the ${this.bench.against}` }],
        series: [{ label: "ms" }, ...series],
        cursor: { drag: { setScale: false } },
        legend: { live: false },
        hooks: { setCursor: [(plot) => (this.hovered = plot.cursor.idx == null ? null : (sorted[plot.cursor.idx] ?? null))] },
      },
      [x, ...ys] as uPlot.AlignedData,
      place,
    );
  }

  protected override render(): TemplateResult {
    const data = this.data;
    if (!data)
      return html`<p class="aside">This bench does not have the scene <bdi>${this.scene}</bdi>; it has ${this.bench.scenes.map((each, index) => html`${index > 0 ? ", " : ""}<bdi>${each.name}</bdi>`)}.</p>`;
    const at = this.hovered;
    return html`<div class="plot" role="img" aria-label=${`${data.points.length} settings of ${data.name}: the table below has their figures`}></div>
      <p class="aside plot-hover" aria-hidden="true">${at ? `${at.name}: ${fixed(at.timeMs, 2)} ms (${fixed(at.low, 2)} to ${fixed(at.high, 2)}), ${fixed(at.error, 4)}` : "Point at a setting."}</p>
      <details><summary>All settings</summary><div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table>
        <thead><tr><th scope="col">setting</th><th scope="col">ms</th><th scope="col">${this.bench.figure}</th><th scope="col">beaten</th></tr></thead>
        <tbody>${data.points.map((point) => html`<tr><th scope="row">${point.name}</th><td class="number">${fixed(point.timeMs, 2)}</td><td class="number">${fixed(point.error, 4)}</td><td>${point.dominated ? "yes" : ""}</td></tr>`)}</tbody>
      </table></div></details>`;
  }
}

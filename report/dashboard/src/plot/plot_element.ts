// What elements with a chart of uPlot share: the chart follows the theme and the width of its place, and goes with the element.
import type uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { PageElement } from "../element";

/** px */
const kLeastWidth = 200;

export abstract class PlotElement extends PageElement {
  protected plot: uPlot | null = null;
  protected abstract readonly plotHeight: number; // px
  private readonly resizing = new ResizeObserver(() => this.resize());
  private readonly dark = matchMedia("(prefers-color-scheme: dark)");
  protected readonly redraw = (): void => this.plot?.redraw(false);
  private readonly theme = new MutationObserver(this.redraw);

  override connectedCallback(): void {
    super.connectedCallback();
    this.dark.addEventListener("change", this.redraw);
    this.theme.observe(document.documentElement, { attributeFilter: ["data-theme"] });
    this.requestUpdate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.dark.removeEventListener("change", this.redraw);
    this.theme.disconnect();
    this.drop();
  }

  /** The chart's size at first. */
  protected sizeIn(place: HTMLElement): { width: number; height: number } {
    return { width: Math.max(place.clientWidth, kLeastWidth), height: this.plotHeight };
  }

  /** Whether its chart is drawn in that very element of the page. */
  protected isDrawnIn(place: HTMLElement): boolean {
    return this.plot?.root.parentElement === place;
  }

  /** Takes a chart in the place of the one before. */
  protected hold(place: HTMLElement, make: () => uPlot): void {
    this.drop();
    this.plot = make();
    this.resizing.observe(place);
  }

  protected drop(): void {
    this.resizing.disconnect();
    this.plot?.destroy();
    this.plot = null;
  }

  /** The value of a variable of tokens.css. */
  protected color(name: string): string {
    return getComputedStyle(this).getPropertyValue(name).trim();
  }

  private resize(): void {
    const width = this.plot?.root.parentElement?.clientWidth ?? 0;
    if (this.plot !== null && width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: this.plotHeight });
  }
}

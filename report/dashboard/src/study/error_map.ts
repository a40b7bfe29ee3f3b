// Greatest errors of a function over roughness and cosine: from 1e-8 (black) to 1 and more (light).
import { html, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";

import { magmaColor } from "../data/magma";
import { PageElement } from "../element";
import { significant } from "../format";

/** The place of an error in the colours of difference maps, 0..255, by its logarithm. */
export function colorIndex(error: number): number {
  return Math.round(255 * Math.min(Math.max((Math.log10(Math.max(error, 1e-8)) + 8) / 8, 0), 1));
}

@customElement("parity-error-map")
export class ParityErrorMap extends PageElement {
  @property({ attribute: false }) map: readonly (number | null)[] = [];
  @property() label = "";
  @property({ attribute: false }) axes = { roughness: "", cosine: "" };
  @query("canvas") private canvas!: HTMLCanvasElement;
  @state() private at = "";

  private get side(): number {
    return Math.round(Math.sqrt(this.map.length));
  }

  protected override updated(): void {
    const side = this.side;
    const context = this.canvas.getContext("2d");
    if (!context || side === 0) return;
    const image = context.createImageData(side, side);
    this.map.forEach((error, index) => {
      if (error === null) return; // no row: nothing is drawn
      const color = magmaColor(colorIndex(error));
      const row = side - 1 - Math.floor(index / side); // roughness grows upwards
      image.data.set([color >> 16, (color >> 8) & 255, color & 255, 255], 4 * (row * side + (index % side)));
    });
    context.putImageData(image, 0, 0);
  }

  private readonly onMove = (event: PointerEvent): void => {
    const side = this.side;
    const box = this.canvas.getBoundingClientRect();
    const cell = (share: number): number => Math.min(side - 1, Math.max(0, Math.floor(share * side)));
    const column = cell((event.clientX - box.left) / box.width), row = cell((box.bottom - event.clientY) / box.height);
    const error = this.map[row * side + column] ?? null;
    const middle = (index: number): string => ((index + 0.5) / side).toFixed(2);
    this.at = `${middle(row)}, ${middle(column)}: ${error === null ? "no row" : significant(error, 2)}`;
  };

  protected override render(): TemplateResult {
    const { roughness, cosine } = this.axes;
    return html`<div class="error-map">
      <span class="map-y" title=${roughness}>${roughness}</span>
      <canvas width=${this.side} height=${this.side} role="img" aria-label=${this.label} @pointermove=${this.onMove} @pointerleave=${() => (this.at = "")}></canvas>
      <span class="map-x">${this.at === "" ? `${cosine}, 0 to 1` : this.at}</span>
    </div>`;
  }
}

// A small picture of one term of one path, from the view's terms file: around the chosen material.
import { html, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";

import { reasonOf } from "../data/reason";
import { loadChunk, loadPlane } from "../data/pixels";
import type { Head } from "../data/page";
import type { View } from "../data/types";
import { PageElement } from "../element";
import { paintCanvas, type Job } from "./paint";
import { loadDisplay } from "./source";
import { boundsOf, type Box } from "./transform";

const kLongest = 320; // pixels of its longer side: twice what is usually seen

let turn = Promise.resolve(); // one at a time: a view has up to 18 planes, and all at once would fill the memory
const whole = document.createElement("canvas"); // where each is painted before it is made small

/** Around the material's pixels with a rim, as the report's crops; all of the view for none. */
async function boxOf(view: View, material: number): Promise<Box> {
  const all = { x: 0, y: 0, width: view.width, height: view.height };
  if (material < 0 || view.pixels.color === "") return all;
  const plane = await loadPlane(view.pixels.color, "material");
  const box = boundsOf(plane.values, plane.width, material + 1);
  if (box === null) return all;
  const rim = Math.max(8, Math.floor(Math.max(box.width, box.height) / 16));
  const x = Math.max(box.x - rim, 0);
  const y = Math.max(box.y - rim, 0);
  const width = Math.min(box.x + box.width + rim, view.width) - x;
  return { x, y, width, height: Math.min(box.y + box.height + rim, view.height) - y };
}

@customElement("parity-term-image")
export class ParityTermImage extends PageElement {
  @property({ attribute: false }) report!: Head;
  @property({ attribute: false }) view!: View;
  @property({ attribute: false }) material = -1; // -1: the whole view
  @property({ attribute: false }) plane = ""; // "highend.skySpecular"
  @property({ attribute: false }) exposure = 0; // EV, on top of the scene's
  @property({ attribute: false }) label = "";
  @state() private message = "";
  @query("canvas") private canvas!: HTMLCanvasElement | null;
  private isSeen = false;
  private wanted = 0; // the last painting that was asked for
  private readonly seeing = new IntersectionObserver(
    (entries) => {
      if (this.isSeen || !entries.some((entry) => entry.isIntersecting)) return;
      this.isSeen = true;
      this.requestUpdate("plane");
    },
    { rootMargin: "200px" },
  );

  override connectedCallback(): void {
    super.connectedCallback();
    this.seeing.observe(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.seeing.disconnect();
    ++this.wanted;
  }

  protected override updated(changed: PropertyValues): void {
    const isOther = ["report", "view", "material", "plane", "exposure"].some((key) => changed.has(key));
    if (!this.isSeen || !isOther) return;
    const ask = ++this.wanted;
    turn = turn.then(() => (ask === this.wanted ? this.paint(ask) : undefined));
  }

  private async paint(ask: number): Promise<void> {
    const { view } = this;
    try {
      const chunk = await loadChunk(view.pixels.terms);
      if (!chunk.planes.some((plane) => plane.name === this.plane)) throw new Error("Black in both paths.");
      const exposureEv = view.exposureEv + this.exposure;
      const plane = await loadPlane(view.pixels.terms, this.plane);
      const job: Job = { kind: "display", plane, display: await loadDisplay(this.report), exposureEv };
      const box = await boxOf(view, this.material);
      if (ask !== this.wanted || this.canvas === null) return;
      paintCanvas(whole, job);
      const shrink = Math.min(kLongest / Math.max(box.width, box.height), 1);
      this.canvas.width = Math.max(Math.round(box.width * shrink), 1);
      this.canvas.height = Math.max(Math.round(box.height * shrink), 1);
      const context = this.canvas.getContext("2d");
      if (context === null) return;
      context.imageSmoothingQuality = "high";
      context.drawImage(whole, box.x, box.y, box.width, box.height, 0, 0, this.canvas.width, this.canvas.height);
      this.message = "";
    } catch (error) {
      if (ask === this.wanted) this.message = reasonOf(error);
    }
  }

  protected override render(): TemplateResult {
    return html`<canvas
        role="img"
        aria-label=${this.label}
        width="1"
        height="1"
        ?hidden=${this.message !== ""}
      ></canvas>
      ${this.message === "" ? "" : html`<p class="message">${this.message}</p>`}`;
  }
}

// One picture of a pane: the report's image file, or a canvas once it depends on values.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";

import { imageSource } from "../data/images";
import { PageElement } from "../element";
import { isSameJob, paintCanvas, type Job } from "./paint";

function isOtherJob(now: Job | null, before: Job | null | undefined): boolean {
  return !isSameJob(now, before ?? null);
}

@customElement("parity-picture")
export class ParityPicture extends PageElement {
  /** Path of the report; shown while there is no job, or until it is painted. "": none. */
  @property({ attribute: false }) image = "";
  @property({ attribute: false, hasChanged: isOtherJob }) job: Job | null = null;
  @property({ attribute: false }) label = "";
  @state() private isPainted = false;
  @query("canvas") private canvas!: HTMLCanvasElement | null;
  private frame = 0;
  private painted: Job | null = null;

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (!changed.has("job")) return;
    if (this.job === null) this.painted = null; // its canvas goes
    const before = changed.get("job") ?? null;
    // The last picture stays until the next is painted, unless it was of something else.
    if (this.job === null || before === null || before.kind !== this.job.kind)
      this.isPainted = this.job !== null && isSameJob(this.painted, this.job);
  }

  protected override updated(): void {
    if (this.job === null || this.frame !== 0 || isSameJob(this.painted, this.job)) return;
    this.frame = requestAnimationFrame(() => this.paint());
  }

  private paint(): void {
    this.frame = 0;
    if (this.job === null || this.canvas === null) return;
    paintCanvas(this.canvas, this.job);
    this.painted = this.job;
    this.isPainted = true;
  }

  private readonly onError = (): void => {
    this.dispatchEvent(new CustomEvent("picture-missing", { detail: this.image, bubbles: true }));
  };

  protected override render(): TemplateResult {
    const showsCanvas = this.job !== null && this.isPainted;
    return html`${this.image === "" || showsCanvas
      ? nothing
      : html`<img src=${imageSource(this.image)} alt=${this.label} draggable="false" @error=${this.onError} />`}
    ${this.job === null ? nothing : html`<canvas role="img" aria-label=${this.label} ?hidden=${!showsCanvas}></canvas>`}`;
  }
}

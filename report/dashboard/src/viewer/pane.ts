// One pane of the comparison: pictures above one another, moved and zoomed together with the other panes.
import { select } from "d3-selection";
import { zoom, zoomIdentity, type D3ZoomEvent, type ZoomBehavior, type ZoomTransform } from "d3-zoom";
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";
import { repeat } from "lit/directives/repeat.js";

import { PageElement } from "../element";
import type { Job } from "./paint";
import "./picture";
import {
  fitScale,
  kLeastZoom,
  kMostZoom,
  lookAt,
  lookOf,
  pixelAt,
  place,
  type Box,
  type Look,
  type Placement,
  type Size,
} from "./transform";
import { styleText } from "./style_text";

export interface Point {
  x: number;
  y: number;
}

/** Of the pictures in a pane, the lowest first. */
export interface Layer {
  key: string;
  label: string;
  image: string; // path in the report; "": none
  job: Job | null; // not null: painted from values
  opacity?: number;
  isRight?: boolean; // only what is right of the divider
  filter?: string;
}

const kUsual: Look = { zoom: 1, panX: 0.5, panY: 0.5 };

/** Nobody has moved or zoomed it: what is chosen fits its pane. */
export function isUsual(look: Look): boolean {
  return look.zoom === kUsual.zoom && look.panX === kUsual.panX && look.panY === kUsual.panY;
}

function isTouch(event: Event): event is TouchEvent {
  return event.type.startsWith("touch");
}

/** Events: "pane-size" (Size), "pane-look" (Look), "pane-hover" (Point or null), "pane-pick" (Point), "pane-split" (0..1). */
@customElement("parity-pane")
export class ParityPane extends PageElement {
  @property({ attribute: false }) label = "";
  @property({ attribute: false }) right = ""; // of what is right of the divider
  @property({ attribute: false }) note = "";
  @property({ attribute: false }) message = ""; // instead of pictures
  @property({ attribute: false }) isWaiting = false;
  @property({ attribute: false }) layers: Layer[] = [];
  @property({ attribute: false }) cover: Job | null = null; // over all layers: what is not the chosen material
  @property({ attribute: false }) filter = ""; // of all layers together
  @property({ attribute: false }) picture: Size = { width: 1, height: 1 };
  @property({ attribute: false }) look: Look = kUsual;
  @property({ attribute: false }) subject: Box | null = null; // what the usual look fits into the pane; null: all
  @property({ attribute: false }) mark: Point | null = null;
  @property({ attribute: false }) split: number | null = null; // where the divider is, 0..1 of the pane; null: none
  @state() private size: Size = { width: 0, height: 0 };
  @query(".stage") private stage!: HTMLElement;

  private readonly resizing = new ResizeObserver(([entry]) => {
    if (!entry) return;
    this.size = { width: entry.contentRect.width, height: entry.contentRect.height };
    this.send("pane-size", this.size);
  });
  private behavior: ZoomBehavior<HTMLElement, unknown> | null = null;

  /** What is really looked at. */
  private get shownLook(): Look {
    return this.subject !== null && isUsual(this.look) ? lookAt(this.subject, this.size, this.picture) : this.look;
  }

  private get placement(): Placement {
    return place(this.shownLook, this.size, this.picture);
  }

  override connectedCallback(): void {
    super.connectedCallback();
    if (this.hasUpdated) this.resizing.observe(this.stage);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.resizing.disconnect();
  }

  protected override firstUpdated(): void {
    this.resizing.observe(this.stage);
    const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.behavior = zoom<HTMLElement, unknown>()
      .scaleExtent([kLeastZoom, kMostZoom])
      .clickDistance(4)
      .duration(isCalm ? 0 : 200)
      .filter((event: Event) => this.isForZoom(event))
      .on("zoom", (event: D3ZoomEvent<HTMLElement, unknown>) => this.onZoom(event.transform));
    select<HTMLElement, unknown>(this.stage).call(this.behavior);
  }

  protected override updated(changed: PropertyValues): void {
    if (!["look", "subject", "size", "picture"].some((key) => changed.has(key))) return;
    const { x, y, scale } = this.placement;
    // Set as d3-zoom keeps it: its own call would end a gesture that is under way.
    const k = scale / fitScale(this.size, this.picture);
    (this.stage as HTMLElement & { __zoom?: ZoomTransform }).__zoom = zoomIdentity.translate(x, y).scale(k);
  }

  /** One finger scrolls the page while all of the picture is seen anyway. */
  private isForZoom(event: Event): boolean {
    if (isTouch(event)) return event.touches.length > 1 || !isUsual(this.look);
    if (event instanceof WheelEvent) return true;
    return !(event instanceof MouseEvent) || (event.button === 0 && !event.ctrlKey);
  }

  private onZoom({ x, y, k }: ZoomTransform): void {
    const look = lookOf({ x, y, scale: k * fitScale(this.size, this.picture) }, this.size, this.picture);
    this.send("pane-look", look);
  }

  private send(name: string, detail: unknown): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  private pixelOf(event: MouseEvent): Point | null {
    const box = this.stage.getBoundingClientRect();
    return pixelAt(this.placement, event.clientX - box.left, event.clientY - box.top, this.picture);
  }

  private readonly onMove = (event: PointerEvent): void => {
    if (event.pointerType !== "touch") this.send("pane-hover", event.buttons === 0 ? this.pixelOf(event) : null);
  };
  private readonly onLeave = (): void => this.send("pane-hover", null);
  private readonly onClick = (event: MouseEvent): void => {
    const pixel = this.pixelOf(event);
    if (pixel !== null) this.send("pane-pick", pixel);
  };

  private readonly onGrip = (event: PointerEvent): void => {
    const grip = event.currentTarget as HTMLElement;
    if (event.type === "pointerdown") grip.setPointerCapture(event.pointerId);
    else if (!grip.hasPointerCapture(event.pointerId)) return;
    const at = event.clientX - this.stage.getBoundingClientRect().left;
    this.send("pane-split", Math.min(Math.max(at / Math.max(this.size.width, 1), 0), 1));
  };

  /** The divider's place as a share of the picture's width: it stays where it is in the pane, whatever is looked at. */
  private get splitInPicture(): number {
    const { x, scale } = this.placement;
    const at = ((this.split ?? 0) * this.size.width - x) / Math.max(scale * this.picture.width, 1e-6);
    return Math.min(Math.max(at, 0), 1);
  }

  private renderLayer(layer: Layer): TemplateResult {
    const styles = {
      opacity: String(layer.opacity ?? 1),
      "clip-path": layer.isRight ? `inset(0 0 0 ${100 * this.splitInPicture}%)` : "none",
      filter: layer.filter ?? "none",
    };
    return html`<parity-picture
      .style=${styleText(styles)}
      .image=${layer.image}
      .job=${layer.job}
      .label=${layer.label}
    ></parity-picture>`;
  }

  private renderWorld(placement: Placement): TemplateResult {
    const { x, y, scale } = placement;
    const styles = {
      width: `${this.picture.width}px`,
      height: `${this.picture.height}px`,
      transform: `translate(${x}px, ${y}px) scale(${scale})`,
      filter: this.filter === "" ? "none" : this.filter,
    };
    return html`<div class="world ${scale * devicePixelRatio > 2 ? "magnified" : ""}" .style=${styleText(styles)}>
      ${repeat(
        this.layers,
        (layer) => layer.key,
        (layer) => this.renderLayer(layer),
      )}
      ${this.cover === null
        ? nothing
        : html`<parity-picture class="cover" .job=${this.cover} aria-hidden="true"></parity-picture>`}
    </div>`;
  }

  private renderMark({ x, y, scale }: Placement): TemplateResult | typeof nothing {
    if (this.mark === null) return nothing;
    const size = Math.max(scale, 9);
    const styles = {
      left: `${x + (this.mark.x + 0.5) * scale - size / 2}px`,
      top: `${y + (this.mark.y + 0.5) * scale - size / 2}px`,
      width: `${size}px`,
      height: `${size}px`,
    };
    return html`<div class="mark" .style=${styleText(styles)}></div>`;
  }

  private renderGrip(): TemplateResult | typeof nothing {
    if (this.split === null) return nothing;
    const left = this.split * this.size.width;
    const stop = (event: Event): void => event.stopPropagation();
    return html`<div
      class="grip"
      aria-hidden="true"
      .style=${styleText({ left: `${left}px` })}
      @pointerdown=${this.onGrip}
      @pointermove=${this.onGrip}
      @mousedown=${stop}
      @touchstart=${stop}
      @dblclick=${stop}
      @click=${stop}
    ></div>`;
  }

  protected override render(): TemplateResult {
    const placement = this.placement;
    return html`<figure class="pane">
      <figcaption>
        <strong>${this.label}</strong>
        ${this.note === "" ? nothing : html`<span class="note" title=${this.note}>${this.note}</span>`}
        ${this.isWaiting ? html`<span class="note" role="status">loading values…</span>` : nothing}
        ${this.right === "" ? nothing : html`<strong class="right">${this.right}</strong>`}
      </figcaption>
      <div
        class="stage"
        tabindex="0"
        role="application"
        data-keys="own"
        ?data-free=${isUsual(this.look)}
        aria-label=${`${this.label}${this.right === "" ? "" : ` left, ${this.right} right`}: plus and minus zoom, Shift and arrows move the picture, arrows move the inspected pixel`}
        @pointermove=${this.onMove}
        @pointerleave=${this.onLeave}
        @click=${this.onClick}
      >
        ${this.message === "" ? this.renderWorld(placement) : html`<p class="message">${this.message}</p>`}
        ${this.message === "" ? this.renderGrip() : nothing}
        ${this.message === "" ? this.renderMark(placement) : nothing}
      </div>
    </figure>`;
  }
}

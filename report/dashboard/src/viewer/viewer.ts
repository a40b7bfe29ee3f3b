// The comparison of one view or one of its materials: panes, controls, the pixel's values and how FLIP is spread.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, query, state } from "lit/decorators.js";

import type { Plane } from "../data/chunk";
import { countFrom } from "../data/histogram";
import { kDefaultState, type ViewerState } from "../data/state";
import type { Judged } from "../data/judged";
import type { Head } from "../data/page";
import type { View } from "../data/types";
import { PageElement } from "../element";
import { kPhone, Media } from "../media";
import { arrange, baselinePictures, flipPlaneOf, type PaneModel } from "./arrange";
import { controls } from "./controls";
import "./flip_histogram";
import { inspect } from "./inspect";
import "./inspector";
import { changeOf, isForControl } from "./keys";
import { bestColumns } from "./layout";
import { legendsOf, legendView } from "./legend";
import type { Job } from "./paint";
import "./pane";
import { isUsual, type Point } from "./pane";
import { readout } from "./readout";
import { messageOf, PixelSource, valueOf } from "./source";
import { styleText } from "./style_text";
import { boundsOf, clampLook, fitScale, lookAt, type Box, type Look, type Size } from "./transform";
import "./values.css";
import "./viewer.css";

const kRestMs = 150; // a view that is only passed by loads no values
const kHoldMs = 350; // a press that is longer shows the second picture only as long as it lasts

/** Event: "parity-state" (Partial<ViewerState>), bubbling. */
@customElement("parity-viewer")
export class ParityViewer extends PageElement {
  @property({ attribute: false }) report!: Head;
  @property({ attribute: false }) view!: View;
  @property({ attribute: false }) material = -1; // -1: the whole view
  @property({ attribute: false }) state: ViewerState = kDefaultState;
  /** Stands above the tool bar; pictures and legends get the height that is left. */
  @property({ attribute: false }) lead: TemplateResult | typeof nothing = nothing;
  @state() private hover: Point | null = null;
  @state() private showsTest = false;
  @state() private isAtRest = false;
  @state() private paneSize: Size = { width: 0, height: 0 };
  @state() private area: Size = { width: 0, height: 0 }; // of all panes
  @state() private isFolded: boolean | null = null; // the tool bar; null: as suits the screen
  @query(".panes") private panes!: HTMLElement | null;
  private readonly phone = new Media(this, kPhone);
  private readonly resizing = new ResizeObserver(([entry]) => {
    if (entry) this.area = { width: entry.contentRect.width, height: entry.contentRect.height };
  });
  private readonly source = new PixelSource(this);
  private missing: ReadonlySet<string> = new Set();
  private restTimer = 0;
  private pressedAt = 0;
  private bounds: { plane: Plane; material: number; box: Box | null } | null = null;

  constructor() {
    super();
    this.addEventListener("picture-missing", (event) => {
      this.missing = new Set([...this.missing, (event as CustomEvent<string>).detail]);
      this.requestUpdate();
    });
  }

  override connectedCallback(): void {
    super.connectedCallback();
    window.addEventListener("blur", this.onBlur);
    this.rest();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.removeEventListener("blur", this.onBlur);
    this.resizing.disconnect();
    clearTimeout(this.restTimer);
  }

  /** Whether the key did something here. */
  handleKey(event: KeyboardEvent): boolean {
    const shown = this.view;
    if (isForControl(event) || event.ctrlKey || event.metaKey || event.altKey) return false;
    if (event.key.toLowerCase() === "f") {
      if (!event.repeat) this.flick(true);
      return true;
    }
    const isOnPicture = event.target instanceof HTMLElement && event.target.dataset["keys"] === "own";
    const change = changeOf(event, {
      state: this.state,
      look: this.look(shown),
      pane: this.paneSize,
      picture: shown,
      isOnPicture,
    });
    if (change !== null) this.set(change);
    else if (event.key === "ArrowLeft" || event.key === "ArrowRight") this.flick(event.key === "ArrowRight");
    else return false;
    return true;
  }

  handleKeyUp(event: KeyboardEvent): void {
    if (event.key.toLowerCase() === "f") this.showsTest = false;
  }

  private flick(showsTest: boolean): void {
    this.showsTest = showsTest;
    if (this.state.mode !== "flicker") this.set({ mode: "flicker" });
  }

  private readonly onBlur = (): void => void (this.showsTest = false);

  private readonly holdTest = (event: Event): void => {
    const flip = (): void => void (this.showsTest = !this.showsTest);
    if (event instanceof PointerEvent && event.type === "pointerdown") {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
      this.pressedAt = event.timeStamp;
      flip();
    } else if (event.type === "pointerup" || event.type === "pointercancel") {
      if (event.timeStamp - this.pressedAt > kHoldMs) flip();
    } else if (event instanceof MouseEvent && event.detail === 0) {
      flip(); // by keyboard
    }
  };

  private set(change: Partial<ViewerState>): void {
    this.state = { ...this.state, ...change };
    this.dispatchEvent(new CustomEvent("parity-state", { detail: change, bubbles: true }));
  }

  private rest(): void {
    this.isAtRest = false;
    clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => (this.isAtRest = true), kRestMs);
  }

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has("report") || changed.has("view")) {
      this.hover = null;
      this.missing = new Set();
      this.rest();
    }
    this.source.show(this.report, this.view);
  }

  protected override updated(): void {
    if (this.panes) this.resizing.observe(this.panes);
    this.source.dropUnused();
  }

  /** Around the chosen material; null: all is looked at. */
  private subjectIn(plane: Plane | null): Box | null {
    if (plane === null || this.material < 0) return null;
    if (this.bounds?.plane !== plane || this.bounds.material !== this.material)
      this.bounds = { plane, material: this.material, box: boundsOf(plane.values, plane.width, this.material + 1) };
    return this.bounds.box;
  }

  private materialPlane(): Plane | null {
    return this.isAtRest ? valueOf(this.source.color("material")) : null;
  }

  private look(view: View): Look {
    const subject = this.subjectIn(this.materialPlane());
    return subject !== null && isUsual(this.state) ? lookAt(subject, this.paneSize, view) : this.state;
  }

  private zoomBy(factor: number, view: View): void {
    const look = this.look(view);
    this.set(clampLook({ ...look, zoom: look.zoom * factor }));
  }

  private get pinned(): Point | null {
    const { pixelX: x, pixelY: y } = this.state;
    const { view } = this;
    return x >= 0 && y >= 0 && x < view.width && y < view.height ? { x, y } : null;
  }

  /** Whether the run was asked for some materials only: nothing is known of the other pixels. */
  private get isRestricted(): boolean {
    return this.report.settings.some(({ name, value }) => name === "materials" && value !== "all");
  }

  /** Over what is not looked at, or was not compared. */
  private coverOf(plane: Plane): Job | null {
    const dims = this.material >= 0 && this.state.dimOthers;
    return dims || this.isRestricted ? { kind: "others", plane, material: dims ? this.material : -1 } : null;
  }

  /** "12.3 % at or above", once the map's values are there. */
  private aboveText(flip: Plane | null, materials: Plane | null): string {
    if (flip === null || this.state.threshold === 0) return "";
    const count = (threshold: number): number =>
      countFrom(flip.values, materials?.values ?? null, this.material, threshold);
    const all = count(0);
    return all === 0 ? "" : `${((100 * count(this.state.threshold)) / all).toFixed(1)} % at or above`;
  }

  private renderPane(model: PaneModel, view: View, subject: Box | null, cover: Job | null): TemplateResult {
    return html`<parity-pane
      .label=${model.label}
      .right=${model.right}
      .note=${model.note}
      .message=${model.message}
      .isWaiting=${model.isWaiting}
      .layers=${model.layers}
      .filter=${model.filter}
      .split=${model.split}
      .cover=${cover}
      .picture=${view}
      .subject=${subject}
      .look=${this.state}
      .mark=${this.pinned}
      @pane-size=${(event: CustomEvent<Size>) => (this.paneSize = event.detail)}
      @pane-look=${(event: CustomEvent<Look>) => this.set(event.detail)}
      @pane-hover=${(event: CustomEvent<Point | null>) => (this.hover = event.detail)}
      @pane-pick=${(event: CustomEvent<Point>) => this.set({ pixelX: event.detail.x, pixelY: event.detail.y })}
      @pane-split=${(event: CustomEvent<number>) => this.set({ split: event.detail })}
    ></parity-pane>`;
  }

  protected override render(): TemplateResult {
    const { view, source, state } = this;
    const row: Judged = view.materials[this.material] ?? view.whole;
    const materials = this.materialPlane();
    const flip = this.isAtRest ? source.color(flipPlaneOf(this.material)) : null;
    const flipPlane = flip && valueOf(flip);
    const subject = this.subjectIn(materials);
    const cover = materials && this.coverOf(materials);
    const { material, isAtRest, missing, showsTest } = this;
    const panes = arrange({ view, material, materials, state, source, isAtRest, missing, showsTest });
    const { inspected, message } = inspect({
      view,
      source,
      pixel: this.hover ?? this.pinned,
      isPinned: this.hover === null,
      material,
      exposure: state.exposure,
      isRestricted: this.isRestricted,
    });
    const zoom = `${Math.round(100 * fitScale(this.paneSize, view) * this.look(view).zoom)} %`;
    const columns = bestColumns(panes.length, this.area, view);
    const rows = Math.ceil(panes.length / columns);
    return html`<div class="viewer">
      <div class="first-screen">
        ${this.lead}
        ${controls({
          state,
          hasTruth: view.whole.truth !== undefined,
          hasBaseline: baselinePictures(view).length > 0,
          hasTerms: view.pixels.terms !== "",
          material: view.materials[this.material]?.name ?? null,
          above: this.aboveText(flipPlane, materials),
          zoom,
          showsTest: this.showsTest,
          test: view.test,
          set: (change) => this.set(change),
          zoomBy: (factor) => this.zoomBy(factor, view),
          holdTest: this.holdTest,
          isPhone: this.phone.matches,
          isFolded: this.isFolded ?? this.phone.matches,
          fold: (isFolded) => (this.isFolded = isFolded),
        })}
        <div class="panes" .style=${styleText({ "--columns": String(columns), "--rows": String(rows) })}>
          ${panes.map((model) => this.renderPane(model, view, subject, cover))}
        </div>
        <div class="legends">${readout(inspected, state.falseColor)} ${legendsOf(panes).map(legendView)}</div>
      </div>
      <div class="values">
        <parity-inspector
          .inspected=${inspected}
          .message=${message}
          @inspector-unpin=${() => this.set({ pixelX: -1, pixelY: -1 })}
        ></parity-inspector>
        <parity-flip-histogram
          .flip=${flipPlane}
          .materials=${materials}
          .material=${this.material}
          .checks=${row.checks}
          .threshold=${state.threshold}
          .message=${flip === null ? "" : messageOf(flip)}
        ></parity-flip-histogram>
      </div>
    </div>`;
  }
}

// The comparison of one view or one of its materials: panes, controls, the pixel's values and how FLIP is spread.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import type { Plane } from "../data/chunk";
import { countFrom } from "../data/histogram";
import { pathTitle } from "../data/paths";
import { kDefaultState, type ViewerState } from "../data/state";
import type { Judged } from "../data/judged";
import type { Report, View } from "../data/types";
import { PageElement } from "../element";
import { arrange, baselinePictures, flipPlaneOf, type PaneModel } from "./arrange";
import { controls } from "./controls";
import "./flip_histogram";
import "./inspector";
import type { Inspected } from "./inspector";
import { changeOf, isForControl } from "./keys";
import { legend } from "./legend";
import type { Job } from "./paint";
import "./pane";
import { isUsual, type Point } from "./pane";
import { messageOf, PixelSource, valueOf } from "./source";
import { boundsOf, clampLook, fitScale, lookAt, type Box, type Look, type Size } from "./transform";
import "./values.css";
import "./viewer.css";

const kRestMs = 150; // a view that is only passed by loads no values
const kHoldMs = 350; // a press that is longer shows the second picture only as long as it lasts

/** Event: "parity-state" (Partial<ViewerState>), bubbling. */
@customElement("parity-viewer")
export class ParityViewer extends PageElement {
  @property({ attribute: false }) report!: Report;
  @property({ attribute: false }) scene = -1; // places in the report
  @property({ attribute: false }) view = -1;
  @property({ attribute: false }) material = -1; // -1: the whole view
  @property({ attribute: false }) state: ViewerState = kDefaultState;
  @state() private hover: Point | null = null;
  @state() private showsTest = false;
  @state() private isAtRest = false;
  @state() private paneSize: Size = { width: 0, height: 0 };
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
    clearTimeout(this.restTimer);
  }

  /** Whether the key did something here. */
  handleKey(event: KeyboardEvent): boolean {
    const shown = this.shownView;
    if (shown === null || isForControl(event) || event.ctrlKey || event.metaKey || event.altKey) return false;
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

  private get shownView(): View | null {
    return this.report.scenes[this.scene]?.views[this.view] ?? null;
  }

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
    const shown = this.shownView;
    if (shown === null) return;
    if (changed.has("report") || changed.has("scene") || changed.has("view")) {
      this.hover = null;
      this.missing = new Set();
      this.rest();
    }
    this.source.show(this.report, shown);
  }

  protected override updated(): void {
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
    const view = this.shownView;
    return view !== null && x >= 0 && y >= 0 && x < view.width && y < view.height ? { x, y } : null;
  }

  /** What the inspector shows, once its planes are there; a message where they will not be. */
  private inspect(view: View): { inspected: Inspected | null; message: string } {
    const pixel = this.hover ?? this.pinned;
    if (pixel === null) return { inspected: null, message: "" };
    const { source } = this;
    const names = [
      [view.reference, pathTitle(view.reference)],
      [view.test, pathTitle(view.test)],
      ...(view.whole.truth ? [["truth", "Truth"]] : []),
    ] as const;
    const loaded = names.map(([plane, name]) => ({ name, loaded: source.color(plane) }));
    const pictures = loaded.flatMap(({ name, loaded: each }) => {
      const plane = valueOf(each);
      return plane === null ? [] : [{ name, plane }];
    });
    if (pictures.length === 0) return { inspected: null, message: messageOf(loaded[0]!.loaded) || "Loading values…" };
    const at = pixel.y * view.width + pixel.x;
    const flip = valueOf(source.color(flipPlaneOf(this.material)))?.values[at];
    const material = valueOf(source.color("material"))?.values[at] ?? 0;
    const inspected: Inspected = {
      pixel,
      isPinned: this.hover === null,
      pictures,
      flip: flip === undefined || (material === 0 && (this.material >= 0 || this.isRestricted)) ? null : flip / 65535,
      material: material === 0 ? null : (view.materials[material - 1]?.name ?? null),
      display: valueOf(source.display),
      exposureEv: view.exposureEv + this.state.exposure,
      termsFile: view.pixels.terms,
      paths: [view.reference, view.test],
    };
    return { inspected, message: "" };
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

  protected override render(): TemplateResult | typeof nothing {
    const view = this.shownView;
    if (view === null) return nothing;
    const { source, state } = this;
    const row: Judged = view.materials[this.material] ?? view.whole;
    const materials = this.materialPlane();
    const flip = this.isAtRest ? source.color(flipPlaneOf(this.material)) : null;
    const flipPlane = flip && valueOf(flip);
    const subject = this.subjectIn(materials);
    const cover = materials && this.coverOf(materials);
    const { material, isAtRest, missing, showsTest } = this;
    const panes = arrange({ view, material, state, source, isAtRest, missing, showsTest });
    const { inspected, message } = this.inspect(view);
    const zoom = `${Math.round(100 * fitScale(this.paneSize, view) * this.look(view).zoom)} %`;
    return html`<div class="viewer">
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
      })}
      <div class="panes" data-count=${panes.length}>
        ${panes.map((model) => this.renderPane(model, view, subject, cover))}
      </div>
      ${panes.some((pane) => pane.layers.some((layer) => layer.key === "flip")) ? legend(state.threshold) : nothing}
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

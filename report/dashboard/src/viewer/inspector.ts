// The values of one pixel: both paths (and the truth), FLIP, the material, and what each term adds.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { customElement, property, state } from "lit/decorators.js";

import { reasonOf } from "../data/reason";
import type { Plane } from "../data/chunk";
import type { Display } from "../data/display";
import { pathWord } from "../data/paths";
import { loadChunk, loadPlane } from "../data/pixels";
import { PageElement } from "../element";
import { fixed } from "../format";
import { help } from "../help";
import type { Point } from "./pane";
import { cssColor, linearText, samplePlane, type Rgb, type Sample } from "./sample";
import { termLabel } from "./terms";
import { styleText } from "./style_text";

export interface Inspected {
  pixel: Point;
  isPinned: boolean;
  pictures: { name: string; plane: Plane }[];
  flip: number | null;
  material: string | null; // null: none of the view's
  display: Display | null;
  exposureEv: number;
  termsFile: string;
  paths: readonly [string, string]; // the view's reference and test
}

interface TermRow {
  term: string;
  reference: Rgb;
  test: Rgb;
}

/** Events: "inspector-unpin". */
@customElement("parity-inspector")
export class ParityInspector extends PageElement {
  @property({ attribute: false }) inspected: Inspected | null = null;
  @property({ attribute: false }) message = "";
  @state() private terms: TermRow[] = [];
  @state() private termsMessage = "";
  @state() private isOpen = false; // of the terms: loaded on first use, then with each pixel
  @state() private copied = "";
  private termsKey = ""; // of the pixel whose terms were asked for last
  private shownKey = ""; // of the pixel that `terms` are of

  protected override willUpdate(changed: PropertyValues): void {
    if (changed.has("inspected")) this.copied = "";
    const at = this.inspected;
    if (!this.isOpen || at === null || at.termsFile === "") return;
    const key = `${at.termsFile} ${at.pixel.x} ${at.pixel.y}`;
    if (key !== this.termsKey) void this.readTerms(key, at);
  }

  /** Plane by plane, so that a large view's need not all be in memory. */
  private async readTerms(key: string, { termsFile, pixel, paths }: Inspected): Promise<void> {
    this.termsKey = key;
    this.termsMessage = "Loading…";
    const rows: TermRow[] = [];
    try {
      const chunk = await loadChunk(termsFile);
      const names = chunk.planes
        .filter((plane) => plane.name.startsWith(`${paths[0]}.`))
        .map((plane) => plane.name.slice(paths[0].length + 1));
      const index = pixel.y * chunk.width + pixel.x;
      for (const term of names) {
        const reference = samplePlane(await loadPlane(termsFile, `${paths[0]}.${term}`), index, null, 0).linear;
        const test = samplePlane(await loadPlane(termsFile, `${paths[1]}.${term}`), index, null, 0).linear;
        if (key !== this.termsKey) return;
        rows.push({ term, reference, test });
      }
      this.termsMessage = rows.length === 0 ? "All terms are black here." : "";
    } catch (error) {
      if (key !== this.termsKey) return;
      this.termsMessage = reasonOf(error);
    }
    this.terms = rows;
    this.shownKey = key;
  }

  /** The terms of the inspected pixel; none while they are read. */
  private get termsHere(): TermRow[] {
    return this.shownKey === this.termsKey ? this.terms : [];
  }

  /** All that is shown, in lines with tabs: a table where it is pasted. */
  private get text(): string {
    const at = this.inspected;
    if (at === null) return "";
    const lines = [
      `pixel\t${at.pixel.x}\t${at.pixel.y}`,
      `material\t${at.material ?? "none"}`,
      `FLIP\t${at.flip === null ? "" : at.flip.toFixed(4)}`,
      ...this.samples(at).map(
        ({ name, linear, display }) => `${name}\tlinear\t${linear.join("\t")}\tdisplay\t${display?.join("\t") ?? ""}`,
      ),
      ...(this.isOpen
        ? this.terms.flatMap(({ term, reference, test }) => [
            `${pathWord(at.paths[0])} ${term}\tlinear\t${reference.join("\t")}`,
            `${pathWord(at.paths[1])} ${term}\tlinear\t${test.join("\t")}`,
          ])
        : []),
    ];
    return lines.join("\n");
  }

  private readonly copy = (): void => {
    const fail = (): void => void (this.copied = "Not allowed");
    if (navigator.clipboard) navigator.clipboard.writeText(this.text).then(() => (this.copied = "Copied"), fail);
    else fail();
  };

  private samples(at: Inspected): (Sample & { name: string })[] {
    const index = (plane: Plane): number => at.pixel.y * plane.width + at.pixel.x;
    return at.pictures.map(({ name, plane }) => ({
      name,
      ...samplePlane(plane, index(plane), at.display, at.exposureEv),
    }));
  }

  private renderSample({ name, linear, display }: Sample & { name: string }): TemplateResult {
    const swatch = display ? styleText({ background: cssColor(display) }) : "";
    return html`<tr>
      <th scope="row">
        ${display ? html`<i class="swatch" .style=${swatch} aria-hidden="true"></i>` : nothing}${name}
      </th>
      <td class="number">${linear.map((value) => html`<span>${linearText(value)}</span> `)}</td>
      <td class="number">${display?.map((value) => html`<span>${value}</span> `) ?? "–"}</td>
    </tr>`;
  }

  private renderTerms(at: Inspected): TemplateResult | typeof nothing {
    if (at.termsFile === "") return nothing;
    const onToggle = (event: Event): void => void (this.isOpen = (event.target as HTMLDetailsElement).open);
    return html`<details @toggle=${onToggle} ?open=${this.isOpen}>
      <summary>Terms, linear</summary>
      ${this.termsMessage === "" ? nothing : html`<p class="aside">${this.termsMessage}</p>`}
      ${this.termsHere.length === 0
        ? nothing
        : html`<div class="table-scroll" tabindex="0" role="group" aria-label="Table">
            <table>
              <thead>
                <tr>
                  <th scope="col">term</th>
                  ${at.paths.map((path) => html`<th scope="col">${pathWord(path)}</th>`)}
                </tr>
              </thead>
              <tbody>
                ${this.terms.map(
                  ({ term, reference, test }) =>
                    html`<tr>
                      <th scope="row" title=${term}>${termLabel(term)}</th>
                      ${[reference, test].map(
                        (rgb) =>
                          html`<td class="number">${rgb.map((value) => html`<span>${linearText(value)}</span> `)}</td>`,
                      )}
                    </tr>`,
                )}
              </tbody>
            </table>
          </div>`}
    </details>`;
  }

  private renderPixel(at: Inspected): TemplateResult {
    return html`<p class="pixel-head" aria-live=${at.isPinned ? "polite" : "off"}>
        <b class="number">${at.pixel.x}, ${at.pixel.y}</b>
        <span>FLIP <b class="number">${fixed(at.flip, 3)}</b></span>
        <span class="material"
          >${at.material === null
            ? "no material of this list"
            : html`<bdi>${at.material === "" ? "(no name)" : at.material}</bdi>`}</span
        >
      </p>
      <div class="table-scroll" tabindex="0" role="group" aria-label="Table">
        <table>
          <thead>
            <tr>
              <th scope="col">picture</th>
              <th scope="col">linear${help("linear")}</th>
              <th scope="col">display${help("display")}</th>
            </tr>
          </thead>
          <tbody>
            ${this.samples(at).map((sample) => this.renderSample(sample))}
          </tbody>
        </table>
      </div>
      ${this.renderTerms(at)}
      <p class="pixel-tools">
        <button type="button" @click=${this.copy}>${this.copied === "" ? "Copy values" : this.copied}</button>
        <button
          type="button"
          ?disabled=${!at.isPinned}
          @click=${() => this.dispatchEvent(new CustomEvent("inspector-unpin"))}
        >
          Unpin
        </button>
        <span class="aside"
          >${at.isPinned ? "Pinned. Arrow keys move it while a picture has the focus." : "Click to pin it."}</span
        >
      </p>`;
  }

  protected override render(): TemplateResult {
    const at = this.inspected;
    return html`<section class="inspector">
      <h3>Pixel${help("inspector")}</h3>
      ${at === null
        ? html`<p class="aside">
            ${this.message === ""
              ? "Point at a picture and click to pin a pixel, or press an arrow key while a picture has the focus."
              : this.message}
          </p>`
        : this.renderPixel(at)}
    </section>`;
  }
}

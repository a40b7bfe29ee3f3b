// What would help a material: advice with its picture, the sets of changes, what each approximation adds, and where the
// error lies.
import { html, nothing, type TemplateResult } from "lit";

import { cardOf, titleOf } from "../data/card";
import {
  advisedSet, barsOfRange, costChange, describeRanges, groupRanges, isOtherWay, limitAt, maskedTextures, nameOfSet, percent, rangeName, signedScale, topOfRanges,
  type MaskedTexture, type RangeGroup, type SignedScale, type Span,
} from "../data/explanation";
import { imageSource } from "../data/images";
import type { Head } from "../data/page";
import { pathTitle } from "../data/paths";
import type { Row } from "../data/rows";
import type { ErrorRange, Explanation, Material, Scene, View } from "../data/types";
import { typeset } from "../data/wording";
import { change, count, figure, signed } from "../format";
import { help } from "../help";
import { bar } from "../overview/row";

const kQuantities: Record<ErrorRange["quantity"], { title: string; ends: string }> = {
  roughness: { title: "Roughness", ends: "0: smooth, 1: rough" },
  metallic: { title: "Metallic", ends: "0: dielectric, 1: metal" },
  "N.V": { title: "N.V", ends: "0: silhouette, 1: head-on" },
};

const placeOf = ({ left, width }: Span): string => `left:${left}%;width:${width}%`;

/** A line may break behind "formulas=". */
function breakable(name: string): TemplateResult {
  return html`<bdi>${name.split(/(?<==)/).map((part, i) => html`${i > 0 ? html`<wbr />` : nothing}${part}`)}</bdi>`;
}

/** Small pictures show their pixels, as magnified ones in the viewer do. */
function onPicture(event: Event): void {
  const picture = event.currentTarget as HTMLImageElement;
  const scale = Math.min(picture.clientWidth / picture.naturalWidth, picture.clientHeight / picture.naturalHeight);
  picture.classList.toggle("magnified", scale > 1);
}

function pictures(explanation: Explanation, material: Material, view: View, flip: (value: number) => string): TemplateResult | typeof nothing {
  const set = advisedSet(explanation);
  const [today] = explanation.sets;
  if (explanation.picture === "" || set === null) return nothing;
  const name = nameOfSet(set);
  const shown: [string, string, string][] = [
    [material.crops.reference, pathTitle(view.reference), ""],
    [material.crops.test, pathTitle(view.test), today ? `today, FLIP ${flip(today.flip)}` : "today"],
    [explanation.picture, name, `FLIP ${flip(set.flip)}`],
  ];
  return html`<div class="explained-pictures">${shown.map(([path, title, words]) => path === "" ? nothing : html`<figure>
    <img src=${imageSource(path)} alt=${`${material.name}: ${title}${words === "" ? "" : `, ${words}`}`} decoding="async" @load=${onPicture} />
    <figcaption>${breakable(title)}${words === "" ? nothing : html`<small>${words}</small>`}</figcaption></figure>`)}</div>`;
}

function setTable({ sets, advised }: Explanation, { checks }: Material, flip: (value: number) => string): TemplateResult | typeof nothing {
  const [today] = sets;
  if (!today) return nothing;
  const mostFlip = Math.max(...sets.map((set) => set.flip));
  const mostOperations = Math.max(1, ...sets.map((set) => set.operations));
  const share = (operations: number): number => (100 * operations) / mostOperations;
  return html`<h4>Best set of each size ${help("explainedSets")}</h4>
    <div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table class="explained-sets">
      <thead><tr><th scope="col">changes</th><th scope="col">mean FLIP</th><th scope="col">operations</th><th scope="col">fetches</th></tr></thead>
      <tbody>${sets.map((set, i) => html`<tr class=${i === advised && i > 0 ? "advised" : ""}>
        <th scope="row">${breakable(nameOfSet(set))}${i === advised && i > 0 ? html` <span class="badge">advised</span>` : nothing}</th>
        <td class="number">${flip(set.flip)}${bar(set.flip, limitAt(set.flip, checks), mostFlip)}</td>
        <td class="number">${count(set.operations)}${i === 0 ? nothing : html` <small>${costChange(set.operations, today.operations)}</small>`}
          <span class="bar" aria-hidden="true"><i class="fill" .style=${`width:${share(set.operations)}%`}></i><i class="mark today" .style=${`left:${share(today.operations)}%`}></i></span></td>
        <td class="number">${count(set.fetches)}${i === 0 || set.fetches === today.fetches ? nothing : html` <small>${signed(set.fetches - today.fetches, 0)}</small>`}</td></tr>`)}</tbody>
    </table></div>`;
}

function signedBar(value: number, scale: SignedScale): TemplateResult {
  return html`<span class="bar signed" aria-hidden="true"><i class="fill ${value < 0 ? "below" : ""}" .style=${placeOf(scale.spanOf(value))}></i><i class="mark zero" .style=${`left:${scale.zero}%`}></i></span>`;
}

function approximationTable({ approximations }: Explanation, text: (value: number) => string): TemplateResult | typeof nothing {
  if (approximations.length === 0) return nothing;
  const scale = signedScale(approximations.flatMap(({ share, alone }) => [share, alone]));
  return html`<h4>What each approximation adds ${help("approximationShare")}</h4>
    <div class="table-scroll" tabindex="0" role="group" aria-label="Table"><table class="approximations">
      <thead><tr><th scope="col">approximation</th><th scope="col">share of FLIP</th><th scope="col">alone</th></tr></thead>
      <tbody>${approximations.map((each) => html`<tr>
        <th scope="row">${each.approximation}<small>${breakable(each.change)}</small></th>
        <td class="number">${text(each.share)}${signedBar(each.share, scale)}</td>
        <td class="number">${text(each.alone)}${isOtherWay(each) ? html` <small class="caution">alone the other way</small>` : nothing}${signedBar(each.alone, scale)}</td></tr>`)}</tbody>
    </table></div>`;
}

function rangePlot(group: RangeGroup): TemplateResult {
  const top = topOfRanges(group);
  const { title, ends } = kQuantities[group.quantity] ?? { title: group.quantity, ends: "" };
  const words = describeRanges(group);
  const height = (share: number): string => `;height:${(100 * share) / top}%`;
  return html`<figure class="error-range">
    <figcaption><b>${title}</b> <small>${ends}</small></figcaption>
    <div class="range-plot" role="img" aria-label=${`Shares of pixels and of FLIP by ${title}. ${words} The table below has all of them.`}>
      <span class="range-top">${percent(top)}</span>
      <div class="range-bars">${group.ranges.map((range) => {
        const { pixels, flip } = barsOfRange(range);
        return html`<i class="pixels" .style=${placeOf(pixels) + height(range.pixels)}></i><i class="flip" .style=${placeOf(flip) + height(range.flip)}></i>`;
      })}</div>
      <div class="range-ends"><span>0</span><span>0.5</span><span>1</span></div>
    </div>
    <p class="aside">${words}</p>
    <details class="chart-table"><summary>The plot as a table</summary><table>
      <thead><tr><th scope="col">${title}</th><th scope="col">pixels</th><th scope="col">FLIP</th></tr></thead>
      <tbody>${group.ranges.map((range) => html`<tr><th scope="row">${rangeName(range)}</th><td class="number">${percent(range.pixels)}</td><td class="number">${percent(range.flip)}</td></tr>`)}</tbody>
    </table></details></figure>`;
}

function maskedPicture({ mask, input, picture }: MaskedTexture): TemplateResult {
  const title = titleOf(input);
  return html`<figure class="error-mask">
    <figcaption><b>${title}</b> <small>texture</small></figcaption>
    <div class="masked"><img src=${imageSource(picture)} alt=${`Texture of ${title}`} decoding="async" /><img class="mask" src=${imageSource(mask.picture)} alt="Marks where half of the FLIP lies" decoding="async" /></div>
    <p class="aside">marked: ${percent(mask.texels)} of the texels hold half of the FLIP</p></figure>`;
}

function errorPlaces({ ranges, masks }: Explanation, scene: Scene, row: Row): TemplateResult | typeof nothing {
  const groups = groupRanges(ranges);
  const masked = maskedTextures(masks, cardOf(scene, row.name));
  if (groups.length === 0 && masked.length === 0) return nothing;
  const isOf = (group: RangeGroup, { mask }: MaskedTexture): boolean => mask.input === group.quantity;
  const others = masked.filter((each) => !groups.some((group) => isOf(group, each)));
  return html`<h4>Where the error lies ${help("errorRanges")}</h4>
    ${groups.length === 0 ? nothing : html`<ul class="range-keys"><li><i class="pixels" aria-hidden="true"></i>share of the pixels</li><li><i class="flip" aria-hidden="true"></i>share of the FLIP</li></ul>`}
    <div class="error-places">${groups.map((group) => html`${rangePlot(group)}${masked.filter((each) => isOf(group, each)).map(maskedPicture)}`)}${others.map(maskedPicture)}</div>`;
}

/** Nothing for what is no material, and for materials that were not explained (--explain). */
export function explanationPanel(report: Head, scene: Scene, row: Row): TemplateResult | typeof nothing {
  const view = scene.views[row.view];
  const material = row.kind === "material" ? view?.materials[row.material] : undefined;
  const explanation = material?.explanation;
  if (!view || !material || !explanation) return nothing;
  const { failure = "", advice } = explanation;
  const statistic = report.statistics["flip.mean"];
  const flip = (value: number): string => figure(value, statistic);
  return html`<section class="explanation"><h3>What would help</h3>${
    failure !== ""
      ? html`<p>Not explained: ${typeset(failure)}</p>`
      : html`<ul class="advice">${advice.map((sentence) => html`<li>${typeset(sentence)}</li>`)}</ul>
        ${pictures(explanation, material, view, flip)}
        ${setTable(explanation, material, flip)}
        ${approximationTable(explanation, (value) => change(value, statistic))}
        ${errorPlaces(explanation, scene, row)}`
  }</section>`;
}

// The card of a material: what it is made of, with small pictures of its textures, and what other presets would give.
import { html, nothing, type TemplateResult } from "lit";

import { cardOf, colorOf, flagsOf, hexOf, inputLines, partsOfName, textureFacts, textureFile, titleOf } from "../data/card";
import { imageSource } from "../data/images";
import type { Row } from "../data/rows";
import type { CardInput, CardTexture, Material, MaterialCard, Scene } from "../data/types";
import { wordsWithoutVerdict } from "../data/what_if";
import { typeset } from "../data/wording";
import { badge } from "../parts";

function sample(input: CardInput): TemplateResult {
  const picture = input.texture?.picture ?? "";
  if (picture !== "") return html`<img class="card-sample" src=${imageSource(picture)} alt="" loading="lazy" decoding="async" />`;
  const color = colorOf(input);
  if (color !== null) return html`<span class="card-sample" aria-hidden="true" .style=${`background:${hexOf(color)}`}></span>`;
  const [value] = input.value;
  const isShare = !input.texture && value !== undefined && value >= 0 && value <= 1;
  return html`<span class="card-sample level" aria-hidden="true">${isShare ? html`<i .style=${`height:${value * 100}%`}></i>` : nothing}</span>`;
}

function textureLines(texture: CardTexture, source: string): TemplateResult {
  const name = partsOfName(textureFile(texture, source)).map((part, i) => html`${i > 0 ? html`<wbr />` : nothing}${part}`);
  return html`<p class="aside"><bdi>${name}</bdi></p>
    <p class="aside">${textureFacts(texture)}</p>`;
}

function inputCell(input: CardInput, source: string): TemplateResult {
  return html`<li>
    ${sample(input)}
    <div>
      <h4>${titleOf(input)}</h4>
      ${inputLines(input).map((line) => html`<p>${line}</p>`)}
      ${input.texture ? textureLines(input.texture, source) : nothing}
    </div>
  </li>`;
}

function inputs(card: MaterialCard, source: string): TemplateResult {
  const flags = flagsOf(card);
  return html`<ul class="card-inputs">${card.inputs.map((input) => inputCell(input, source))}</ul>
    <p class="card-flags">${flags.length === 0 ? nothing : html`${flags.join(" · ")} · `}from <bdi>${source}</bdi></p>
    ${card.notModelled.length === 0 ? nothing : html`<p class="caution">No path models: <b><bdi>${card.notModelled.join(", ")}</bdi></b></p>`}`;
}

function whatIfs(material: Material): TemplateResult | typeof nothing {
  if (!material.whatIf) return nothing;
  return html`<section class="what-ifs"><h3>With another preset</h3>
    <ul>${material.whatIf.map((each) => html`<li>${badge(each.verdict)} ${typeset(wordsWithoutVerdict(each))}${each.reason === "" ? nothing : html`<br /><small>${typeset(each.reason)}</small>`}</li>`)}</ul></section>`;
}

/** Nothing for what is no material, and in reports that do not know what it is made of. */
export function materialCard(scene: Scene, row: Row): TemplateResult | typeof nothing {
  if (row.kind !== "material") return nothing;
  const material = scene.views[row.view]?.materials[row.material];
  const card = cardOf(scene, row.name);
  return html`${material ? whatIfs(material) : nothing}
    ${card === null ? nothing : html`<section class="material-card"><h3>Material</h3>${inputs(card, scene.source)}</section>`}`;
}

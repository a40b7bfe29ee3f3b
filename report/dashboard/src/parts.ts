// Small pieces that every part of the page uses.
import { html, nothing, type TemplateResult } from "lit";

import { standingWords } from "./data/changes";
import { baseLayerText, type Row } from "./data/rows";
import type { Verdict } from "./data/types";

const kSigns: Record<Verdict, string> = { pass: "✓", "not seen": "○", "too small": "▫", "not judged": "–", warn: "!", fail: "✕", "not run": "…", error: "⚠" };

/** A row's verdict; one that passes only because its budget accepts something says so. */
export function rowBadge({ verdict, accepted }: Pick<Row, "verdict" | "accepted">, short = false): TemplateResult {
  if (verdict !== "pass" || accepted === "") return badge(verdict, short);
  return html`<span class="badge accepted" title=${`accepted: ${accepted}`}
    ><span aria-hidden="true">✓</span>${short ? html`<span class="sr">pass (accepted)</span>` : " pass (accepted)"}</span
  >`;
}

/** A verdict as a sign and its name: never colour alone. */
export function badge(verdict: Verdict, short = false): TemplateResult {
  return html`<span class="badge ${verdict.replace(" ", "-")}"
    ><span aria-hidden="true">${kSigns[verdict] ?? "?"}</span>${short ? html`<span class="sr">${verdict}</span>` : html` ${verdict}`}</span
  >`;
}

/** Beside the verdict of a material of which no path models every part; nothing of others. */
export function baseLayerBadge(notModelled: readonly string[]): TemplateResult | typeof nothing {
  return notModelled.length === 0
    ? nothing
    : html`<span class="badge base-layer" title=${baseLayerText(notModelled)}>base layer only</span>`;
}

/** Where a row stands among the runs, and whom to ask: "failing for 12 nights", "owner characters"; nothing of rows that are as before. */
export function standingNote({ standing, nights, owner, verdict, accepted }: Pick<Row, "standing" | "nights" | "owner" | "verdict" | "accepted">): TemplateResult | typeof nothing {
  if (standing === "") return nothing;
  const isSaid = standing === "accepted" && verdict === "pass" && accepted !== ""; // by its badge
  const words = isSaid ? "" : standingWords(standing, nights);
  const asks = owner !== "" && standing !== "fixed";
  return html`${words === "" ? nothing : html`<small class="standing ${standing}"><span class="word-long">${words.startsWith("failing for ") ? "failing for " : nothing}</span>${words.replace("failing for ", "")}</small>`}
    ${asks ? html`<small class="owner" title=${`owner ${owner}`}><span class="word-long">owner </span><bdi>${owner}</bdi></small>` : nothing}`;
}

/** A definition list of what is not empty. */
export function definitions(entries: readonly (readonly [string, string])[]): TemplateResult {
  return html`<dl class="definitions">${entries.map(([name, value]) => (value === "" ? nothing : html`<div><dt>${name}</dt><dd><bdi>${value}</bdi></dd></div>`))}</dl>`;
}

/** A text that a click copies. */
export function copyable(text: string, label: string): TemplateResult {
  const copy = (event: Event): void => {
    const button = event.currentTarget as HTMLButtonElement;
    const done = (what: string): void => {
      button.textContent = what;
      setTimeout(() => (button.textContent = "Copy"), 1500);
    };
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(() => done("Copied"), () => done("Not allowed"));
    else done("Not allowed");
  };
  return html`<div class="command"><code>${text}</code><button type="button" @click=${copy} aria-label=${"Copy: " + label}>Copy</button></div>`;
}

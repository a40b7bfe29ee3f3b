// Changes of rows as the page of nights sets them.
import { html, nothing, type TemplateResult } from "lit";

import type { Nights, TrendChange } from "../data/history";
import { directionOf } from "../data/nights";
import { countOf } from "../data/wording";
import { significant } from "../format";

const kSigns: Readonly<Record<string, string>> = { nondeterministic: "≠", crashed: "⚠", regressed: "✕", fixed: "✓", changed: "~", new: "+", gone: "−" };

/** A kind as a sign and its name, with how often it happened. */
export function kindBadge(kind: string, count?: number): TemplateResult {
  return html`<span class="badge kind-${kind}"><span aria-hidden="true">${kSigns[kind] ?? "?"}</span> ${count === undefined ? "" : `${count} `}${kind}</span>`;
}

const valueOf = (value: number | null, metric: string, statistics: Nights["statistics"]): string =>
  value === null && statistics[metric]?.better === "higher" ? "identical" : significant(value, 4); // as the PSNR of equal pictures

/** "flip.mean 0.1763 → 0.1654 better"; nothing where no figure changed. */
export function figureChange(change: TrendChange, statistics: Nights["statistics"]): TemplateResult | typeof nothing {
  const { metric, before, after } = change;
  if (metric === "") return nothing;
  const direction = directionOf(change, statistics);
  return html`<span class="whole">${metric} ${valueOf(before, metric, statistics)} → ${valueOf(after, metric, statistics)}${direction === "" ? nothing : html` <small class=${direction}>${direction}</small>`}</span>`;
}

/** "10 figures": how many others changed. */
export function otherFigures({ figures, metric }: TrendChange): string {
  const others = metric === "" ? figures : figures - 1;
  return others > 0 ? countOf(others, "figures") : "";
}

export const causeOf = ({ cause }: TrendChange): string => (cause === "" ? "not known" : cause);

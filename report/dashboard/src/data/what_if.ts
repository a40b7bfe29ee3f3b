// Other presets of the test path: which of them would help a material.
import { gravityOf } from "./gravity";
import type { Material, Verdict, WhatIf } from "./types";

const kLeastShare = 0.1; // of FLIP, as of a cause (data/rows.ts)
const kJudged: readonly Verdict[] = ["pass", "warn", "fail"]; // another verdict is no help, because it judges less

/** Mean FLIP of these figures; infinity where it is not known. */
function flipOf({ figures }: Pick<Material, "figures">): number {
  return figures?.metrics["flip.mean"] ?? Infinity;
}

/** The best verdict, then the least FLIP, where it improves the verdict, or FLIP by a tenth at least; null: none does. */
export function bestWhatIf(material: Material): WhatIf | null {
  const now = gravityOf(material.verdict);
  const helps = (each: WhatIf): boolean => {
    const then = gravityOf(each.verdict);
    return kJudged.includes(each.verdict) && (then < now || (then === now && flipOf(each) <= flipOf(material) * (1 - kLeastShare)));
  };
  const helpful = (material.whatIf ?? []).filter(helps);
  return helpful.sort((a, b) => gravityOf(a.verdict) - gravityOf(b.verdict) || flipOf(a) - flipOf(b))[0] ?? null;
}

/** "with refit: FLIP 0.072 instead of 0.134": the words without the verdict, which a badge says. */
export function wordsWithoutVerdict({ words, verdict }: WhatIf): string {
  const end = `, ${verdict}`;
  return words.endsWith(end) ? words.slice(0, -end.length) : words;
}

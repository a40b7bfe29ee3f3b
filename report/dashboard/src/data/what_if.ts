// Other presets of the test path: what each would give a material. Which of them helps most is in the list (overview).
import type { WhatIf } from "./types";

/** "with refit: FLIP 0.072 instead of 0.134": the words without the verdict, which a badge says. */
export function wordsWithoutVerdict({ words, verdict }: WhatIf): string {
  const end = `, ${verdict}`;
  return words.endsWith(end) ? words.slice(0, -end.length) : words;
}

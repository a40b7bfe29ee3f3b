// The terms that a path's colour is the sum of, in words.
import { kTermWords } from "../data/types";

/** In the order of the report. */
export const kTermNames: readonly string[] = Object.keys(kTermWords);

/** "reflections of the environment"; the name of a term that has no words. */
export function termLabel(term: string): string {
  return kTermWords[term] ?? term;
}

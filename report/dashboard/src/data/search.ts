// Finding rows by words. Whether a text has a word is asked once for each text, not for each row.
import type { Overview } from "./overview";
import type { Row } from "./rows";

/** Whether a row has every word of the query, in any of its texts, which have plain minus signs. */
export function finderOf(all: Overview, query: string): (row: Row) => boolean {
  const words = query.toLowerCase().replaceAll("\u2212", "-").split(/\s+/).filter((word) => word !== "");
  if (words.length === 0) return () => true;
  const finders = words.map((word) => {
    const hits = all.textsWith(word);
    return (row: Row): boolean => row.searched.some((place) => hits[place] === 1) || row.searchedWords.includes(word);
  });
  return (row) => finders.every((finds) => finds(row));
}

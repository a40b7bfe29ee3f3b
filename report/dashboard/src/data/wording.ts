// Texts of the report as the page sets them: numbers with a real minus, and one of a thing.

/** "mean exposure difference -0.28 EV" with a real minus; a zero has no sign. Names, ranges and options keep their hyphens. */
export function typeset(text: string): string {
  return text.replace(/(^|[\s(])[-\u2212](?=\.?\d)/g, "$1\u2212").replace(/(^|[\s(])[+\u2212](0(?:\.0+)?)(?![\d.]*\d)/g, "$1$2");
}

/** "1 row", "1,234 rows", "1 mesh": the number and the plural's word for it. */
export function countOf(number: number, plural: string): string {
  const one = /(?:sh|ch|ss|x)es$/.test(plural) ? plural.slice(0, -2) : plural.replace(/s$/, "");
  return `${number.toLocaleString("en-US")} ${number === 1 ? one : plural}`;
}

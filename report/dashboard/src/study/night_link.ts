// What the page of nights shows, as the URL's hash: a link shows what its sender saw.

export interface Shown {
  night: string; // name of a run; "": the last one
  row: string; // "": none
  figure: string; // of the row; "": its first
}

/** Only what is chosen, in a fixed order. */
export function linkOf({ night, row, figure }: Shown): string {
  const parameters = new URLSearchParams();
  if (night !== "") parameters.set("night", night);
  if (row !== "") parameters.set("row", row);
  if (row !== "" && figure !== "") parameters.set("figure", figure);
  return `#${parameters.toString()}`;
}

export function shownBy(hash: string): Shown {
  const parameters = new URLSearchParams(hash.replace(/^#/, ""));
  const text = (key: string): string => parameters.get(key) ?? "";
  return { night: text("night"), row: text("row"), figure: text("figure") };
}

// Where the picture of a path in the report is to be had: in its file, or in the page itself (a report in one file).
import { embeddedText } from "./embedded";

/** What an <img> takes as its source; "" for no path. */
export function imageSource(path: string): string {
  if (path === "") return "";
  const text = embeddedText(path, "text/plain");
  return text === null ? path : "data:image/png;base64," + text.trim();
}

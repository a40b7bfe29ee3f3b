// Where the picture of a path in the report is to be had: in its file, or in the page itself (a report in one file).

/** What an <img> takes as its source; "" for no path. */
export function imageSource(path: string): string {
  if (path === "") return "";
  const block = document.querySelector(`script[type="text/plain"][data-file="${CSS.escape(path)}"]`);
  return block ? "data:image/png;base64," + (block.textContent ?? "").trim() : path;
}

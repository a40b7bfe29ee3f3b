// Files that the single-file form of the report carries in script elements instead of in folders beside it.

type Form = "text/plain" | "application/json";

/** The text of the file in that form, or null: then it lies in the report's folder. */
export function embeddedText(file: string, form: Form): string | null {
  const element = document.querySelector(`script[type="${form}"][data-file="${CSS.escape(file)}"]`);
  return element?.textContent ?? null;
}

/** Whether this page is a report in one file: nothing lies beside it. */
export function isWhole(): boolean {
  return document.querySelector("script[src]") === null;
}

/** The address of a file of the report's folder: each part escaped, so that a name is never a query or a scheme. */
export function relativeUrl(file: string): string {
  return file
    .split("/")
    .map((part) => encodeURIComponent(part))
    .join("/");
}

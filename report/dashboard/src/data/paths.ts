// What the paths are called on the page. The name of another engine stays as its user wrote it.

const kTitles: Record<string, string> = { highend: "High-end", mobile: "Mobile", truth: "Truth" };

/** "High-end" for "highend", as a title has it. */
export function pathTitle(path: string): string {
  return kTitles[path] ?? path;
}

/** The same within a sentence. */
export function pathWord(path: string): string {
  return path === "highend" ? "high-end" : path;
}

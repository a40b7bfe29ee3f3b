// What the paths are called on the page.

/** "High-end" for "highend"; others with a capital. */
export function pathTitle(path: string): string {
  return path === "highend" ? "High-end" : path.charAt(0).toUpperCase() + path.slice(1);
}

/** The same within a sentence. */
export function pathWord(path: string): string {
  return path === "highend" ? "high-end" : path;
}

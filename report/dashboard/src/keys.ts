// Keys that work everywhere; those of the comparison view are the view's own (viewer/keys).
import { html, type TemplateResult } from "lit";

import type { Tab } from "./data/state";
import { isForControl } from "./viewer/keys";

export type Action =
  | { kind: "help" | "search" | "close" | "theme" }
  | { kind: "step"; by: number }
  | { kind: "category"; index: number }
  | { kind: "tab"; tab: Tab };

/** Whether keys belong to what has the focus: text is typed there, or a control moves. */
function isTaken(event: KeyboardEvent): boolean {
  const { target } = event;
  const ownsArrows = target instanceof HTMLElement && target.dataset["keys"] === "own";
  return isForControl(event) || (ownsArrows && event.key.startsWith("Arrow"));
}

/** What a key asks for, whatever is shown; null: nothing of these. */
export function actionOf(event: KeyboardEvent): Action | null {
  if (event.ctrlKey || event.metaKey || event.altKey) return null;
  if (event.key === "Escape") {
    if (event.target instanceof HTMLInputElement && event.target.type === "search") {
      event.target.blur();
      return null;
    }
    return { kind: "close" };
  }
  if (isTaken(event)) return null;
  if (event.shiftKey && event.key !== "?") return null;
  if (event.key >= "1" && event.key <= "9") return { kind: "category", index: Number(event.key) - 1 };
  switch (event.key) {
    case "?": return { kind: "help" };
    case "/": return { kind: "search" };
    case "ArrowUp": case "k": return { kind: "step", by: -1 };
    case "ArrowDown": case "j": return { kind: "step", by: 1 };
    case "c": return { kind: "tab", tab: "compare" };
    case "t": return { kind: "tab", tab: "terms" };
    case "n": return { kind: "tab", tab: "numbers" };
    case "r": return { kind: "tab", tab: "history" };
    case "l": return { kind: "theme" };
    default: return null;
  }
}

const kShortcuts: readonly (readonly [string, string])[] = [
  ["↑ ↓ or k j", "previous, next item"],
  ["1 – 9", "all, failed, warned, errors, not judged, too small, not seen, passed, not run"],
  ["/", "search"],
  ["C T N R", "compare, terms, numbers, history of the runs"],
  ["S", "side by side or slider"],
  ["O", "onion skin"],
  ["D", "difference"],
  ["H", "FLIP map"],
  ["V", "luminance in false colours"],
  ["A", "automatic or fixed range of maps"],
  ["F, held", "flicker: show the test path while held"],
  ["← →", "only the reference path, only the test path"],
  ["+ −, Shift + arrows", "zoom, move"],
  ["W", "fit the width"],
  ["0", "fit all, exposure 0"],
  ["[ ]", "exposure down, up"],
  ["L", "dark, light, as in the system"],
  ["Esc", "back to the overview"],
  ["?", "this list"],
];

export function shortcutsDialog(): TemplateResult {
  return html`<dialog id="shortcuts" aria-labelledby="shortcuts-title">
    <form method="dialog">
      <h2 id="shortcuts-title">Keys</h2>
      <dl class="keys">${kShortcuts.map(([keys, what]) => html`<div><dt><kbd>${keys}</kbd></dt><dd>${what}</dd></div>`)}</dl>
      <h2>How to read this page</h2>
      <p>
        Two paths shade every material at the same surface points: the reference path (high-end) and the test path (mobile). FLIP
        measures how different the two look if you flip between them. 0: identical, 1: largest difference. On an even mid grey, .03 is one step
        of 8 bits, .10 is 10 % more or less light (visible side by side), .20 is about 25 % (visible at a glance), .50 is twice or a third of the light.
      </p>
      <p>
        A material is judged by its own contribution. FLIP compares the reference path's picture with a copy in which only this material
        has the test path's colours. So its figures, its FLIP map and its histogram do not depend on its neighbours. For a whole view, FLIP
        compares the pictures of the two paths.
      </p>
      <p>
        Too small: the material has fewer pixels than its budget requires. Not judged: most of its pixels are black in both pictures, or
        white in both. Base layer only: it has parts that no path models. None of these is a pass.
      </p>
      <button autofocus>Close</button>
    </form>
  </dialog>`;
}

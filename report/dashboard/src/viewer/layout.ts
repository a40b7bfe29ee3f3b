// How panes share the space that is left for them.
import type { Size } from "./transform";

const kGap = 8; // of values in viewer.css
const kCaption = 26;

/** In how many columns the pictures get largest. */
export function bestColumns(count: number, area: Size, picture: Size): number {
  let best = 1;
  let largest = -1;
  for (let columns = 1; columns <= count; ++columns) {
    const rows = Math.ceil(count / columns);
    const width = (area.width - (columns - 1) * kGap) / columns;
    const height = (area.height - (rows - 1) * kGap) / rows - kCaption;
    const scale = Math.min(width / picture.width, height / picture.height);
    if (scale > largest * 1.001) [best, largest] = [columns, scale];
  }
  return best;
}

// Where the lines of the list stand, and how many of them have room.
import type { Entry } from "../data/groups";

/** px: browsers end a page at 33 million. */
export const kHighest = 30e6;

export interface Lines {
  entries: readonly Entry[]; // those that have room
  starts: readonly number[]; // of each, in px; one more for the end
  left: number; // lines that have none
}

export function layLines(all: readonly Entry[], groupHeight: number, rowHeight: number, highest = kHighest): Lines {
  const starts = [0];
  let end = 0;
  for (const entry of all) {
    end += entry.kind === "group" ? groupHeight : rowHeight;
    if (end > highest) break;
    starts.push(end);
  }
  const count = starts.length - 1;
  return { entries: count < all.length ? all.slice(0, count) : all, starts, left: all.length - count };
}

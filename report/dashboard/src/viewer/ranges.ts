// The automatic ranges of maps: found from the pixels that are looked at, and kept while these stay.
import type { Plane } from "../data/chunk";
import { paintDisplay, type Display } from "../data/display";
import { differenceRange, flipRange, kFullSteps } from "../data/range";

const kKept = 4; // a few panes' at once

/** Of a function of these very arguments: the last few results. */
class Recent<T> {
  private items: { key: readonly unknown[]; value: T }[] = [];

  get(key: readonly unknown[], make: () => T): T {
    const found = this.items.find((item) => item.key.every((each, i) => each === key[i]));
    if (found) return found.value;
    const value = make();
    this.items = [{ key, value }, ...this.items].slice(0, kKept);
    return value;
  }
}

const flips = new Recent<number>();
const gains = new Recent<number>();

/** The FLIP of the map's brightest colour. material: its place in the view; -1: all pixels that show one. */
export function autoMost(flip: Plane, materials: Plane | null, material: number): number {
  return flips.get([flip, materials, material], () => flipRange(flip.values, materials?.values ?? null, material));
}

export interface Pair {
  reference: Plane;
  test: Plane;
  display: Display;
  exposureEv: number;
}

/** The gain with which the difference of two pictures fills its map. */
export function autoGain({ reference, test, display, exposureEv }: Pair, materials: Plane | null, material: number): number {
  return gains.get([reference, test, display, exposureEv, materials, material], () => {
    const shown = [reference, test].map((plane) => {
      const out = new Uint32Array(plane.width * plane.height);
      paintDisplay(plane, display, exposureEv, out);
      return out;
    });
    return kFullSteps / differenceRange(shown[0]!, shown[1]!, materials?.values ?? null, material);
  });
}

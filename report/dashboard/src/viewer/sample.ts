// One pixel's values by name, as the inspector shows and copies them.
import type { Plane } from "../data/chunk";
import { displayPixel, type Display } from "../data/display";
import { halfToNumber } from "../data/half";

export type Rgb = readonly [number, number, number];

export interface Sample {
  linear: Rgb; // scene-referred, before exposure
  display: Rgb | null; // 0..255; null: the display transform is not there
}

/** Of an rgb16f plane at y*width+x. */
export function samplePlane(plane: Plane, index: number, display: Display | null, exposureEv: number): Sample {
  const count = plane.width * plane.height;
  const bits: Rgb = [plane.values[index]!, plane.values[count + index]!, plane.values[2 * count + index]!];
  const linear: Rgb = [halfToNumber(bits[0]), halfToNumber(bits[1]), halfToNumber(bits[2])];
  return { linear, display: display && displayPixel(bits, display, exposureEv) };
}

/** As many digits as a half has; NaN and infinities in words. */
export function linearText(value: number): string {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const digits = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : size >= 1 ? 3 : 4;
  if (size !== 0 && size < 0.001) return value.toExponential(1);
  return value.toFixed(digits);
}

export function cssColor(rgb: Rgb): string {
  return `rgb(${rgb.join(" ")})`;
}

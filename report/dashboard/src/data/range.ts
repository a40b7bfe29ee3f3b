// The range that a map of differences is shown with: what most of the pixels that are looked at need.
import { roundUp } from "./scale";

const kShare = 0.995; // of the pixels that lie within; single outliers must not make the rest black
const kLeastFlip = 0.02; // half a step of 8 bits on mid grey: below it a map would show rounding
export const kFullSteps = 127; // of 255, on either side of the grey of no difference

/** Whether a pixel is looked at: of the material (its place), or of any for -1. */
function isWanted(materials: Uint16Array | null, i: number, wanted: number): boolean {
  return materials === null || (wanted < 0 ? materials[i] !== 0 : materials[i] === wanted + 1);
}

/** The value that this share of a histogram's counts does not exceed; 0 without counts. */
function quantile(counts: Uint32Array): number {
  let total = 0;
  for (const count of counts) total += count;
  let seen = 0;
  for (let value = 0; value < counts.length; ++value) {
    seen += counts[value]!;
    if (total > 0 && seen >= kShare * total) return value;
  }
  return 0;
}

/** What the brightest colour of a FLIP map means: a round number, 1 at most. flip: 0..65535 for 0..1. */
export function flipRange(flip: Uint16Array, materials: Uint16Array | null, wanted: number): number {
  const counts = new Uint32Array(65536);
  for (let i = 0; i < flip.length; ++i) {
    if (!isWanted(materials, i, wanted)) continue;
    const value = flip[i]!;
    counts[value] = counts[value]! + 1;
  }
  return Math.min(Math.max(roundUp(quantile(counts) / 65535), kLeastFlip), 1);
}

/** The steps of 255 that a signed difference map spans on either side. a, b: displayed pixels, 0xffBBGGRR. */
export function differenceRange(
  a: Uint32Array,
  b: Uint32Array,
  materials: Uint16Array | null,
  wanted: number,
): number {
  const counts = new Uint32Array(256);
  for (let i = 0; i < a.length; ++i) {
    if (!isWanted(materials, i, wanted)) continue;
    const [x, y] = [a[i]!, b[i]!];
    const most = Math.max(
      Math.abs((x & 255) - (y & 255)),
      Math.abs(((x >> 8) & 255) - ((y >> 8) & 255)),
      Math.abs(((x >> 16) & 255) - ((y >> 16) & 255)),
    );
    counts[most] = counts[most]! + 1;
  }
  return Math.min(Math.max(Math.ceil(roundUp(quantile(counts))), 2), kFullSteps);
}

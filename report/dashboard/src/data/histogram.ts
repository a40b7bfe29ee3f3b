// How many pixels have which FLIP, of a whole view or of one material.

export interface Histogram {
  counts: number[]; // of equal bins over 0..1; a FLIP of 1 falls into the last
  total: number; // pixels
  mean: number; // NaN without pixels, as are the others
  median: number;
  p95: number;
  max: number;
}

const kSteps = 65536; // values that a plane can hold

/**
 * flip: 0..65535 for 0..1. material: 1 + the material's place, 0 for none; null: not known, then every pixel counts.
 * wanted: a material's place, or -1 for all pixels of any material.
 */
export function makeHistogram(
  flip: Uint16Array,
  material: Uint16Array | null,
  wanted: number,
  bins: number,
): Histogram {
  const steps = new Uint32Array(kSteps);
  let total = 0;
  for (let i = 0; i < flip.length; ++i) {
    if (material !== null && (wanted < 0 ? material[i] === 0 : material[i] !== wanted + 1)) continue;
    const step = flip[i]!;
    steps[step] = steps[step]! + 1;
    ++total;
  }
  const counts = new Array<number>(bins).fill(0);
  let sum = 0;
  let seen = 0;
  let median = NaN;
  let p95 = NaN;
  let max = NaN;
  for (let step = 0; step < kSteps; ++step) {
    const count = steps[step]!;
    if (count === 0) continue;
    const value = step / 65535;
    const bin = Math.min(Math.floor(value * bins), bins - 1);
    counts[bin] = counts[bin]! + count;
    sum += value * count;
    seen += count;
    if (Number.isNaN(median) && 2 * seen >= total) median = value;
    if (Number.isNaN(p95) && seen >= 0.95 * total) p95 = value;
    max = value;
  }
  return { counts, total, mean: total === 0 ? NaN : sum / total, median, p95, max };
}

/** The least stored value that is not below a threshold 0..1: stored values are rounded, so this is too. */
export function leastAt(threshold: number): number {
  return Math.round(threshold * 65535);
}

/** How many pixels have at least this FLIP, of those that makeHistogram counts. */
export function countFrom(flip: Uint16Array, material: Uint16Array | null, wanted: number, threshold: number): number {
  const least = leastAt(threshold);
  let count = 0;
  for (let i = 0; i < flip.length; ++i) {
    if (material !== null && (wanted < 0 ? material[i] === 0 : material[i] !== wanted + 1)) continue;
    if (flip[i]! >= least) ++count;
  }
  return count;
}

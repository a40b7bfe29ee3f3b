// Luminance in false colours: EV steps around middle grey, which is 18 % of white as exposed.
import type { Plane } from "./chunk";
import { halfValues } from "./half";

export const kMiddleGrey = 0.18; // linear luminance at 0 EV; white, 1, is at +2.47 EV
export const kLeastEv = -6;
export const kMostEv = 6;
const kBands = 2; // of one colour each EV
const kBlack = 0xff000000;
const kWhite = 0xffffffff;

/** EV above middle grey of a linear luminance as exposed: log2(Y / 0.18). */
export function evOf(luminance: number): number {
  return Math.log2(luminance / kMiddleGrey);
}

/** Rec.709 luminance, Y = 0.2126 R + 0.7152 G + 0.0722 B. */
export function luminanceOf(r: number, g: number, b: number): number {
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/** The polynomials that approximate Turbo (A. Mikhailov 2019, "Turbo, an improved rainbow colormap"); t in 0..1. */
function turbo(t: number): [number, number, number] {
  const sum = (c: readonly number[]): number => c.reduceRight((value, each) => value * t + each, 0);
  return [
    sum([0.13572138, 4.6153926, -42.66032258, 132.13108234, -152.94239396, 59.28637943]),
    sum([0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604]),
    sum([0.1066733, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973]),
  ];
}

/** Colours of the bands from the least EV up, 0xffBBGGRR. */
const kColors = Uint32Array.from({ length: (kMostEv - kLeastEv) * kBands }, (_, i, n = (kMostEv - kLeastEv) * kBands) => {
  const [r, g, b] = turbo((i + 0.5) / n).map((c) => Math.round(255 * Math.min(Math.max(c, 0), 1)));
  return kBlack | (b! << 16) | (g! << 8) | r!;
});

/** The colour of a luminance as exposed, 0xffBBGGRR: black below the range and for NaN, white above it. */
export function falseColor(luminance: number): number {
  const ev = evOf(luminance);
  if (!(ev >= kLeastEv)) return kBlack >>> 0;
  if (ev >= kMostEv) return kWhite >>> 0;
  return kColors[Math.floor((ev - kLeastEv) * kBands)]!;
}

/** An rgb16f plane in false colours; out: a value a pixel, the bytes of ImageData. */
export function paintLuminance(plane: Plane, exposureEv: number, out: Uint32Array): void {
  const halves = halfValues();
  const scale = 2 ** exposureEv;
  const count = plane.width * plane.height;
  const { values } = plane;
  for (let i = 0; i < count; ++i)
    out[i] = falseColor(
      scale * luminanceOf(halves[values[i]!]!, halves[values[count + i]!]!, halves[values[2 * count + i]!]!),
    );
}

/** "#rrggbb" of each band, from the least EV up: what the legend shows. */
export function bandColors(): string[] {
  return [...kColors].map((c) => "#" + (((c & 255) << 16) | (c & 0xff00) | ((c >> 16) & 255)).toString(16).padStart(6, "0"));
}

// What canvases show: planes of values turned into screen pixels. Images in files cannot be read back from a page that
// was opened from a folder, so whatever depends on values is painted from pixel files.
import type { Plane } from "../data/chunk";
import { paintDisplay, type Display } from "../data/display";
import { paintLuminance } from "../data/false_color";
import { leastAt } from "../data/histogram";
import { magmaColor } from "../data/magma";

export type Job =
  | { kind: "display"; plane: Plane; display: Display; exposureEv: number }
  | { kind: "difference"; reference: Plane; test: Plane; display: Display; exposureEv: number; gain: number }
  | { kind: "luminance"; plane: Plane; exposureEv: number }
  | { kind: "flip"; plane: Plane; threshold: number; most: number } // most: of the brightest colour
  | { kind: "others"; plane: Plane; material: number }; // -1: all that is none of the view's materials

const kAlike = 0xff3a3a3a; // below the threshold: a grey that magma does not have
const kDimmed = 0xc82e2e2e; // over what is not the chosen material: the pane's own grey, nearly opaque

/** The size of what a job paints. */
export function sizeOf(job: Job): { width: number; height: number } {
  return job.kind === "difference" ? job.reference : job.plane;
}

/** 0..65535 of FLIP 0..1 to screen colours, 0xffBBGGRR; `most` and what is above it are the brightest. */
function heatTable(threshold: number, most: number): Uint32Array {
  const colors = new Uint32Array(65536);
  const least = leastAt(threshold);
  for (let value = 0; value < 65536; ++value) {
    const rgb = magmaColor(Math.floor((255 * value) / (65535 * most) + 0.5));
    colors[value] = value < least ? kAlike : 0xff000000 | ((rgb & 255) << 16) | (rgb & 0xff00) | (rgb >> 16);
  }
  return colors;
}

let scratch = new Uint32Array(0); // the other picture of a difference

/** 128 + gain * (test - reference) of the displayed values, clamped; in place of out, which holds the reference's. */
function subtract(test: Uint32Array, gain: number, out: Uint32Array): void {
  const levels = new Uint8ClampedArray(511);
  for (let d = -255; d <= 255; ++d) levels[d + 255] = 128 + gain * d;
  for (let i = 0; i < out.length; ++i) {
    const a = out[i]!;
    const b = test[i]!;
    const red = levels[(b & 255) - (a & 255) + 255]!;
    const green = levels[((b >> 8) & 255) - ((a >> 8) & 255) + 255]!;
    const blue = levels[((b >> 16) & 255) - ((a >> 16) & 255) + 255]!;
    out[i] = 0xff000000 | (blue << 16) | (green << 8) | red;
  }
}

/** Fills `out`, a value a pixel: 0xAABBGGRR, which are the bytes of ImageData. */
export function paintJob(job: Job, out: Uint32Array): void {
  switch (job.kind) {
    case "display":
      paintDisplay(job.plane, job.display, job.exposureEv, out);
      break;
    case "difference":
      if (scratch.length !== out.length) scratch = new Uint32Array(out.length);
      paintDisplay(job.reference, job.display, job.exposureEv, out);
      paintDisplay(job.test, job.display, job.exposureEv, scratch);
      subtract(scratch, job.gain, out);
      break;
    case "luminance":
      paintLuminance(job.plane, job.exposureEv, out);
      break;
    case "flip": {
      const colors = heatTable(job.threshold, job.most);
      const { values } = job.plane;
      for (let i = 0; i < out.length; ++i) out[i] = colors[values[i]!]!;
      break;
    }
    case "others": {
      const { values } = job.plane;
      const wanted = job.material + 1; // 0: any material
      for (let i = 0; i < out.length; ++i) out[i] = (wanted === 0 ? values[i] !== 0 : values[i] === wanted) ? 0 : kDimmed;
      break;
    }
  }
}

let image: ImageData | undefined; // of the last size: pictures of a view are alike, and the canvas copies it

/** Paints onto a canvas, whose size becomes the picture's. */
export function paintCanvas(canvas: HTMLCanvasElement, job: Job): void {
  const { width, height } = sizeOf(job);
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  if (image?.width !== width || image.height !== height) image = new ImageData(width, height);
  paintJob(job, new Uint32Array(image.data.buffer));
  canvas.getContext("2d")?.putImageData(image, 0, 0);
}

/** Whether two jobs paint the same. */
export function isSameJob(a: Job | null, b: Job | null): boolean {
  if (a === null || b === null) return a === b;
  const x = a as unknown as Record<string, unknown>;
  const y = b as unknown as Record<string, unknown>;
  const keys = Object.keys(x);
  return keys.length === Object.keys(y).length && keys.every((key) => x[key] === y[key]);
}

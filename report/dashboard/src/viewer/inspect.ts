// What is known of one pixel of a view: gathered from the planes that are there.
import { evOf, luminanceOf } from "../data/false_color";
import { pathTitle } from "../data/paths";
import type { View } from "../data/types";
import { flipPlaneOf } from "./arrange";
import type { Inspected } from "./inspector";
import type { Point } from "./pane";
import { samplePlane } from "./sample";
import { messageOf, valueOf, type PixelSource } from "./source";

export interface Inspection {
  view: View;
  source: PixelSource;
  pixel: Point | null;
  isPinned: boolean;
  material: number; // that is looked at; -1: the whole view
  exposure: number; // EV on top of the scene's
  isRestricted: boolean; // to some materials: nothing is known of the other pixels
}

/** What the inspector shows, once its planes are there; a message where they will not be. */
export function inspect(of: Inspection): { inspected: Inspected | null; message: string } {
  const { view, source, pixel } = of;
  if (pixel === null) return { inspected: null, message: "" };
  const names = [
    [view.reference, pathTitle(view.reference)],
    [view.test, pathTitle(view.test)],
    ...(view.whole.truth ? [["truth", "Truth"]] : []),
  ] as const;
  const loaded = names.map(([plane, name]) => ({ name, loaded: source.color(plane) }));
  const pictures = loaded.flatMap(({ name, loaded: each }) => {
    const plane = valueOf(each);
    return plane === null ? [] : [{ name, plane }];
  });
  if (pictures.length === 0) return { inspected: null, message: messageOf(loaded[0]!.loaded) || "Loading values…" };
  const at = pixel.y * view.width + pixel.x;
  const flip = valueOf(source.color(flipPlaneOf(of.material)))?.values[at];
  const material = valueOf(source.color("material"))?.values[at] ?? 0;
  const inspected: Inspected = {
    pixel,
    isPinned: of.isPinned,
    pictures,
    flip: flip === undefined || (material === 0 && (of.material >= 0 || of.isRestricted)) ? null : flip / 65535,
    material: material === 0 ? null : (view.materials[material - 1]?.name ?? null),
    display: valueOf(source.display),
    exposureEv: view.exposureEv + of.exposure,
    termsFile: view.pixels.terms,
    paths: [view.reference, view.test],
  };
  return { inspected, message: "" };
}

/** "High-end +0.4 EV, Mobile −0.2 EV": luminance from middle grey, as the false colours count it. */
export function luminanceTexts({ pictures, pixel, exposureEv }: Inspected): string[] {
  return pictures.map(({ name, plane }) => {
    const { linear } = samplePlane(plane, pixel.y * plane.width + pixel.x, null, 0);
    const ev = evOf(luminanceOf(...linear) * 2 ** exposureEv);
    if (Number.isNaN(ev)) return `${name} no luminance`;
    if (ev < -16) return `${name} black`;
    return `${name} ${ev < 0 ? "\u2212" : "+"}${Math.abs(ev).toFixed(1)} EV`;
  });
}

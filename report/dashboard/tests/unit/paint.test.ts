import { describe, expect, it } from "vitest";

import type { Plane, PlaneKind } from "../../src/data/chunk";
import { magmaColor } from "../../src/data/magma";
import { isSameJob, paintJob, type Job } from "../../src/viewer/paint";
import { halfBits } from "./pack";

function makePlane(kind: PlaneKind, values: number[]): Plane {
  const count = values.length / (kind === "rgb16f" ? 3 : 1);
  return { name: "p", kind, width: count, height: 1, values: Uint16Array.from(values) };
}

function paint(job: Job, count: number): number[][] {
  const out = new Uint32Array(count);
  paintJob(job, out);
  const bytes = new Uint8Array(out.buffer);
  return Array.from({ length: count }, (_, i) => [...bytes.slice(4 * i, 4 * i + 4)]);
}

const linear = (...values: number[]): Plane => makePlane("rgb16f", values.map(halfBits));

describe("painting", () => {
  it("shows a difference about mid grey, with its sign and gain", () => {
    const reference = linear(0.5, 0.5, 0.5); // raw: 128
    const test = linear(0.5625, 0.5, 0.25); // raw: 143, 128, 64
    const job = { kind: "difference", reference, test, display: { kind: "raw" }, exposureEv: 0 } as const;
    expect(paint({ ...job, gain: 1 }, 1)).toEqual([[143, 128, 64, 255]]);
    expect(paint({ ...job, gain: 4 }, 1)).toEqual([[188, 128, 0, 255]]);
    expect(paint({ ...job, reference: test, test: reference, gain: 4 }, 1)).toEqual([[68, 128, 255, 255]]);
  });

  it("shows FLIP as the report's maps do, and grey below the threshold", () => {
    const plane = makePlane(
      "unorm16",
      [0, 0.3, 0.5, 1].map((v) => Math.round(v * 65535)),
    );
    const rgb = (index: number): number[] => [
      magmaColor(index) >> 16,
      (magmaColor(index) >> 8) & 255,
      magmaColor(index) & 255,
      255,
    ];
    expect(paint({ kind: "flip", plane, threshold: 0, most: 1 }, 4)).toEqual([rgb(0), rgb(77), rgb(128), rgb(255)]);
    const cut = paint({ kind: "flip", plane, threshold: 0.4, most: 1 }, 4);
    expect(cut.slice(2)).toEqual([rgb(128), rgb(255)]);
    expect(cut[0]).toEqual(cut[1]);
    expect(new Set(cut[0]!.slice(0, 3)).size).toBe(1);
    expect(paint({ kind: "flip", plane, threshold: 0, most: 0.5 }, 4)).toEqual([rgb(0), rgb(153), rgb(255), rgb(255)]);
  });

  it("shows luminance by its distance from middle grey, whatever its colour", () => {
    const shown = (r: number, g: number, b: number, exposureEv = 0): number[] =>
      paint({ kind: "luminance", plane: linear(r, g, b), exposureEv }, 1)[0]!;
    expect(shown(0, 0.36 / 0.7152, 0)).toEqual(shown(0.36, 0.36, 0.36));
    expect(shown(0.18, 0.18, 0.18, 1)).toEqual(shown(0.36, 0.36, 0.36));
    expect(shown(0.18, 0.18, 0.18)).not.toEqual(shown(0.36, 0.36, 0.36));
    expect(shown(0, 0, 0)).toEqual([0, 0, 0, 255]);
    expect(shown(NaN, 1, 1)).toEqual([0, 0, 0, 255]);
    expect(shown(100, 100, 100)).toEqual([255, 255, 255, 255]);
  });

  it("covers all but the chosen material", () => {
    const plane = makePlane("uint16", [0, 1, 2, 3]);
    const alphas = paint({ kind: "others", plane, material: 1 }, 4).map((pixel) => pixel[3]);
    expect(alphas[2]).toBe(0);
    expect(alphas.filter((alpha) => alpha !== undefined && alpha > 128)).toHaveLength(3);
  });

  it("knows jobs apart by what they paint", () => {
    const plane = makePlane("unorm16", [0]);
    const job = { kind: "flip", plane, threshold: 0.1, most: 1 } as const;
    expect(isSameJob(job, { ...job })).toBe(true);
    expect(isSameJob(job, { ...job, threshold: 0.2 })).toBe(false);
    expect(isSameJob(job, { ...job, plane: { ...plane } })).toBe(false);
    expect(isSameJob(job, null)).toBe(false);
    expect(isSameJob(null, null)).toBe(true);
  });
});

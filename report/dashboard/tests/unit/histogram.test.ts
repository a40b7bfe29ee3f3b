import { describe, expect, it } from "vitest";

import { countFrom, makeHistogram } from "../../src/data/histogram";

const unorm = (value: number): number => Math.round(value * 65535);
const kFlip = Uint16Array.from([0, 0.05, 0.15, 0.15, 0.95, 1].map(unorm));
const kMaterial = Uint16Array.from([0, 1, 1, 2, 2, 2]);

describe("histogram of FLIP", () => {
  it("counts the pixels of any material, or of one", () => {
    expect(makeHistogram(kFlip, kMaterial, -1, 10).counts).toEqual([1, 2, 0, 0, 0, 0, 0, 0, 0, 2]);
    expect(makeHistogram(kFlip, kMaterial, 0, 10).counts).toEqual([1, 1, 0, 0, 0, 0, 0, 0, 0, 0]);
    expect(makeHistogram(kFlip, null, -1, 10).counts).toEqual([2, 2, 0, 0, 0, 0, 0, 0, 0, 2]);
  });

  it("says the mean and the worst", () => {
    const { total, mean, max, median, p95 } = makeHistogram(kFlip, kMaterial, 1, 10);
    expect(total).toBe(3);
    expect(mean).toBeCloseTo((0.15 + 0.95 + 1) / 3, 4);
    expect(median).toBeCloseTo(0.95, 4);
    expect(p95).toBe(1);
    expect(max).toBe(1);
  });

  it("says what half of the pixels and a twentieth of them reach", () => {
    const flip = Uint16Array.from({ length: 100 }, (_, i) => unorm((99 - i) / 100)); // 0, .01, ... .99 in some order
    const { median, p95 } = makeHistogram(flip, null, -1, 10);
    expect(median).toBeCloseTo(0.49, 4); // the 50th value
    expect(p95).toBeCloseTo(0.94, 4); // the 95th
  });

  it("has no figures without pixels", () => {
    const { total, mean, max, counts } = makeHistogram(kFlip, kMaterial, 7, 4);
    expect([total, ...counts]).toEqual([0, 0, 0, 0, 0]);
    expect(mean).toBeNaN();
    expect(max).toBeNaN();
  });

  it("counts what is at or above a threshold", () => {
    expect(countFrom(kFlip, kMaterial, -1, 0)).toBe(5);
    expect(countFrom(kFlip, kMaterial, -1, 0.15)).toBe(4);
    expect(countFrom(kFlip, kMaterial, 1, 0.5)).toBe(2);
    expect(countFrom(kFlip, null, -1, 1)).toBe(1);
  });
});

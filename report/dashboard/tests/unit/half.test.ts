import { describe, expect, it } from "vitest";

import { halfToNumber, halfValues } from "../../src/data/half";
import { halfBits, isFiniteHalf } from "./pack";

describe("half floats", () => {
  it("has the values of IEEE 754-2008", () => {
    expect(halfToNumber(0x3c00)).toBe(1);
    expect(halfToNumber(0xc000)).toBe(-2);
    expect(halfToNumber(0x7bff)).toBe(65504);
    expect(halfToNumber(0x0400)).toBe(2 ** -14);
    expect(halfToNumber(0x0001)).toBe(2 ** -24);
    expect(halfToNumber(0x3555)).toBe(1365 / 4096); // the nearest to 1/3
    expect(Object.is(halfToNumber(0x8000), -0)).toBe(true);
  });

  it("keeps NaN and infinities", () => {
    expect(halfToNumber(0x7c00)).toBe(Infinity);
    expect(halfToNumber(0xfc00)).toBe(-Infinity);
    expect(halfToNumber(0x7e00)).toBeNaN();
    expect([0x7c00, 0xfc00, 0x7e00, 0xffff].some(isFiniteHalf)).toBe(false);
    expect([0, 0x8000, 0x7bff, 0x3c00].every(isFiniteHalf)).toBe(true);
  });

  it("comes back to the same bits for every finite value", () => {
    const values = halfValues();
    const isKept = (bits: number): boolean =>
      !isFiniteHalf(bits) || bits === 0x8000 || halfBits(values[bits]!) === bits;
    expect(Array.from(values.keys()).filter((bits) => !isKept(bits))).toEqual([]);
  });
});

import { describe, expect, it } from "vitest";

import { columnsOf, realOf, unpack } from "../../src/data/columns";

const base64 = (...bytes: number[]): string => Buffer.from(bytes).toString("base64");

describe("a packed column", () => {
  it("is of little-endian values", () => {
    expect([...unpack({ u8: base64(1, 255) }, 2)]).toEqual([1, 255]);
    expect([...unpack({ u16: base64(1, 2, 3, 0) }, 2)]).toEqual([0x201, 3]);
    expect([...unpack({ u32: base64(1, 0, 1, 0) }, 1)]).toEqual([0x10001]);
    expect([...unpack({ f32: base64(0, 0, 0x80, 0x3f, 0, 0, 0xc0, 0x7f) }, 2)]).toEqual([1, NaN]);
  });

  it("is the one value of all rows", () => {
    expect([...unpack(3, 2)]).toEqual([3, 3]);
    expect([...unpack(0.25, 2)]).toEqual([0.25, 0.25]);
    expect([...unpack(-1, 1)]).toEqual([-1]);
    expect([...unpack(null, 2)]).toEqual([NaN, NaN]);
    expect([...unpack(0, 0)]).toEqual([]);
  });

  it("that lacks values, or is not there, is refused in words", () => {
    expect(() => unpack({ u8: base64(1) }, 2)).toThrow("a column has 1 values for 2 rows");
    expect(() => unpack(undefined, 2)).toThrow("a column is missing");
  });

  it("is unpacked once, when it is read", () => {
    const columns = columnsOf({ count: 1, columns: { good: { u8: base64(7) } } }, ["good", "missing"]);
    expect(columns.good).toBe(columns.good);
    expect(() => columns.missing).toThrow("missing");
  });
});

describe("a real of a column", () => {
  it("reads as it did before it was packed, with up to six digits", () => {
    for (const value of [0.0025, 0.1, 0.28, 12.3456, 1e-5, 0]) expect(realOf(Math.fround(value))).toBe(value);
    expect([realOf(NaN), realOf(undefined)]).toEqual([null, null]);
  });
});

import { describe, expect, it } from "vitest";

import { checkChunk, decodePlane, type Plane } from "../../src/data/chunk";
import { displayPixel, paintDisplay, readDisplayTable, type Display } from "../../src/data/display";
import { halfToNumber } from "../../src/data/half";
import { halfBits, packValues, isFiniteHalf } from "./pack";

/** Every half as the red of a pixel; green and blue are 0 and 1. */
function allHalves(): Plane {
  const values = new Uint16Array(3 * 65536);
  for (let bits = 0; bits < 65536; ++bits) {
    values[bits] = bits;
    values[2 * 65536 + bits] = halfBits(1);
  }
  return { name: "", kind: "rgb16f", width: 256, height: 256, values };
}

function paint(plane: Plane, display: Display, exposureEv: number): Uint8Array {
  const out = new Uint32Array(plane.width * plane.height);
  paintDisplay(plane, display, exposureEv, out);
  return new Uint8Array(out.buffer);
}

async function makeTable(
  node: (r: number, g: number, b: number) => number[],
  size: number,
  minLog2: number,
  maxLog2: number,
): Promise<Display> {
  const count = size ** 3;
  const values = new Uint16Array(3 * count);
  for (let b = 0, i = 0; b < size; ++b)
    for (let g = 0; g < size; ++g)
      for (let r = 0; r < size; ++r, ++i) node(r, g, b).forEach((v, c) => (values[c * count + i] = halfBits(v)));
  const width = size * size;
  const planes = [{ name: "table", kind: "rgb16f", data: packValues(values, width, size) }];
  const value = { file: "pixels/display.js", format: 2, width, height: size, planes, minLog2, maxLog2 };
  const chunk = checkChunk(value, "pixels/display.js");
  return { kind: "table", table: readDisplayTable(chunk, await decodePlane(chunk, "table")) };
}

describe("display transform", () => {
  for (const exposureEv of [0, 1.25, -3])
    it(`is IEC 61966-2-1, rounded, for every half at ${exposureEv} EV`, () => {
      const bytes = paint(allHalves(), { kind: "sRGB" }, exposureEv);
      const encode = (value: number): number => {
        const linear = Math.min(Math.max(value * 2 ** exposureEv, 0), 1);
        const encoded = linear <= 0.0031308 ? linear * 12.92 : 1.055 * Math.pow(linear, 1 / 2.4) - 0.055;
        return Math.floor(encoded * 255 + 0.5);
      };
      const expected = (bits: number): number[] =>
        isFiniteHalf(bits) ? [encode(halfToNumber(bits)), 0, encode(1), 255] : [0, 0, 0, 255]; // black as a whole
      const isRight = (bits: number): boolean => expected(bits).every((value, i) => bytes[4 * bits + i] === value);
      expect(Array.from({ length: 65536 }, (_, bits) => bits).filter((bits) => !isRight(bits))).toEqual([]);
    });

  it("only clamps when raw", () => {
    const pixel = displayPixel([halfBits(0.5), halfBits(2), halfBits(-1)], { kind: "raw" }, 0);
    expect(pixel).toEqual([128, 255, 0]);
    expect(displayPixel([halfBits(0.5), halfBits(0.25), halfBits(0.125)], { kind: "raw" }, 1)).toEqual([255, 128, 64]);
  });

  it("has known sRGB values", () => {
    // 18 % grey is 118 of 255 in sRGB; 0.5 is 188.
    expect(displayPixel([halfBits(0.1800537109375), halfBits(0.5), halfBits(1)], { kind: "sRGB" }, 0)).toEqual([
      118, 188, 255,
    ]);
  });

  it("finds the nodes of a table, red fastest", async () => {
    // Three nodes a side over 2^-1..2^1: each its own colour.
    const display = await makeTable((r, g, b) => [r / 2, g / 4, b / 8], 3, -1, 1);
    const at = (r: number, g: number, b: number) => displayPixel([halfBits(r), halfBits(g), halfBits(b)], display, 0);
    const byte = (v: number) => Math.floor(v * 255 + 0.5);
    expect(at(2, 0.5, 0.5)).toEqual([255, 0, 0]);
    expect(at(0.5, 2, 1)).toEqual([0, byte(0.5), byte(0.125)]);
    expect(at(1, 1, 2)).toEqual([byte(0.5), byte(0.25), byte(0.25)]);
    expect(at(0, -1, 8)).toEqual([0, 0, byte(0.25)]); // outside of the range: its ends
    expect(displayPixel([halfBits(1), halfBits(0.5), halfBits(0.5)], display, 1)).toEqual([
      255,
      byte(0.25),
      byte(0.125),
    ]);
  });

  it("is trilinear between the nodes", async () => {
    const corner = (r: number, g: number, b: number) => (r + 2 * g + 4 * b + r * g * b) / 16;
    const display = await makeTable((r, g, b) => [corner(r, g, b), corner(g, b, r), corner(b, r, g)], 2, 0, 2);
    // log2 of 2, 2.828, 1.1895 in 0..2 are shares of 0.5, 0.75, 0.125.
    const shares = [0.5, 0.75, 0.125] as const;
    const bits = shares.map((share) => halfBits(halfToNumber(Math.round(halfBits(2 ** (2 * share)))))) as [
      number,
      number,
      number,
    ];
    const real = bits.map((each) => Math.log2(halfToNumber(each)) / 2) as [number, number, number];
    const blend = (r: number, g: number, b: number) => (r + 2 * g + 4 * b + r * g * b) / 16; // linear in each
    const [r, g, b] = real;
    const expected = [blend(r, g, b), blend(g, b, r), blend(b, r, g)].map((v) => Math.floor(v * 255 + 0.5));
    expect(displayPixel(bits, display, 0)).toEqual(expected);
  });

  it("shows what is not finite as black by a table too", async () => {
    const display = await makeTable(() => [1, 1, 1], 2, 0, 1);
    expect(displayPixel([halfBits(1), halfBits(1), halfBits(1)], display, 0)).toEqual([255, 255, 255]);
    expect(displayPixel([halfBits(1), halfBits(NaN), halfBits(1)], display, 0)).toEqual([0, 0, 0]);
    expect(displayPixel([halfBits(Infinity), halfBits(1), halfBits(1)], display, 0)).toEqual([0, 0, 0]);
  });

  it("refuses a table that is no cube or has no range", async () => {
    await expect(makeTable(() => [0, 0, 0], 2, 1, 1)).rejects.toThrow("range");
    const planes = [{ name: "table", kind: "rgb16f", data: packValues(new Uint16Array(3 * 6), 3, 2) }];
    const chunk = checkChunk({ file: "f", format: 2, width: 3, height: 2, planes, minLog2: 0, maxLog2: 1 }, "f");
    const plane = await decodePlane(chunk, "table");
    expect(() => readDisplayTable(chunk, plane)).toThrow("not a cube");
  });
});

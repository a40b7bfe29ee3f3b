import { describe, expect, it } from "vitest";

import { checkChunk, decodePlane } from "../../src/data/chunk";
import { packValues } from "./pack";

const kWidth = 7;
const kHeight = 5;

function random(count: number): number[] {
  let seed = 12345;
  return Array.from({ length: count }, () => (seed = (seed * 1103515245 + 12345) % 2 ** 31) >> 15);
}

function makeChunk(plane: Record<string, unknown>, patch: Record<string, unknown> = {}): unknown {
  return { file: "pixels/a.js", format: 2, width: kWidth, height: kHeight, planes: [plane], ...patch };
}

async function decode(plane: Record<string, unknown>): Promise<number[]> {
  const chunk = checkChunk(makeChunk(plane), "pixels/a.js");
  return [...(await decodePlane(chunk, "p")).values];
}

describe("pixel files", () => {
  it("gives back all 16-bit values, of one channel and of three", async () => {
    const one = random(kWidth * kHeight);
    one.splice(0, 4, 65535, 0, 65535, 1);
    expect(await decode({ name: "p", kind: "uint16", data: packValues(one, kWidth, kHeight) })).toEqual(one);
    const three = random(3 * kWidth * kHeight);
    expect(await decode({ name: "p", kind: "rgb16f", data: packValues(three, kWidth, kHeight) })).toEqual(three);
  });

  it("repeats the pixel before where no bit says that one differs", async () => {
    // By hand: 3 x 2 of 10, 10, 9 / 9, 9, 300. The pixels 0, 2 and 5 differ, by 10, 65535 and 291; low bytes, then high bytes.
    const bytes = Uint8Array.from([0b100101, 10, 255, 35, 0, 255, 1]);
    const { deflateRawSync } = await import("node:zlib");
    const data = deflateRawSync(bytes).toString("base64");
    const value = makeChunk({ name: "p", kind: "unorm16", data }, { width: 3, height: 2 });
    expect([...(await decodePlane(checkChunk(value, "pixels/a.js"), "p")).values]).toEqual([10, 10, 9, 9, 9, 300]);
  });

  it("stores a pixel of three channels where one of them differs", async () => {
    const values = Array.from({ length: 3 * kWidth * kHeight }, (_, i) => (i === kWidth * kHeight + 9 ? 8 : 7));
    expect(await decode({ name: "p", kind: "rgb16f", data: packValues(values, kWidth, kHeight) })).toEqual(values);
  });

  it("refuses too few and too many values, and what is no stream", async () => {
    const values = random(kWidth * kHeight);
    const short = packValues(values.slice(kWidth), kWidth, kHeight - 1);
    const long = packValues([...values, ...values.slice(0, kWidth)], kWidth, kHeight + 1);
    const whole = packValues(values, kWidth, kHeight);
    const cut = whole.slice(0, 4 * Math.floor(whole.length / 8));
    await expect(decode({ name: "p", kind: "uint16", data: short })).rejects.toThrow("fewer values");
    await expect(decode({ name: "p", kind: "uint16", data: long })).rejects.toThrow("more values");
    const { deflateRawSync } = await import("node:zlib");
    const none = deflateRawSync(Uint8Array.from([0, 0, 0, 0])).toString("base64"); // less than a bit for each
    await expect(decode({ name: "p", kind: "uint16", data: none })).rejects.toThrow("fewer values");
    // Bits that call for one value more, and for one less, than follow.
    for (const [bits, words] of [[3, "fewer values"], [0, "more values"]] as const) {
      const data = deflateRawSync(Uint8Array.from([bits, 0, 0, 0, 0, 9, 0])).toString("base64");
      await expect(decode({ name: "p", kind: "uint16", data })).rejects.toThrow(words);
    }
    for (const data of [cut, "!!!!", ""])
      await expect(decode({ name: "p", kind: "uint16", data })).rejects.toThrow("pixels/a.js is damaged: the plane p");
  });

  it("refuses in words what it cannot read", () => {
    const plane = { name: "p", kind: "uint16", data: "" };
    const check = (value: unknown) => () => checkChunk(value, "pixels/a.js");
    expect(check(undefined)).toThrow("holds no pixel values");
    expect(check(makeChunk(plane, { format: 1 }))).toThrow("has format 1, but this page reads format 2");
    expect(check(makeChunk(plane, { file: "pixels/b.js" }))).toThrow("another file");
    for (const size of [0, -1, 1.5, "7", null, NaN, 2 ** 30])
      expect(check(makeChunk(plane, { width: size }))).toThrow("its size is wrong");
    expect(check(makeChunk(plane, { planes: {} }))).toThrow("no planes");
    expect(check(makeChunk({ name: "p", kind: "uint16" }))).toThrow("no name or no data");
    expect(check(makeChunk({ name: "p", kind: "toString", data: "" }))).toThrow("does not know");
  });

  it("says which plane is not there", async () => {
    const chunk = checkChunk(makeChunk({ name: "p", kind: "uint16", data: "" }), "pixels/a.js");
    await expect(decodePlane(chunk, "truth")).rejects.toThrow("pixels/a.js has no plane truth");
  });
});

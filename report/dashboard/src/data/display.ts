// The display transform as the report made its pictures: linear Rec.709 times exposure to 8-bit screen values.
import type { Chunk, Plane } from "./chunk";
import { halfValues, kHalfCount } from "./half";

/** Transforms that are no formula come as a cube of nodes over the logarithm of each channel. */
export interface DisplayTable {
  size: number; // nodes a side
  minLog2: number;
  maxLog2: number;
  nodes: Float32Array; // display-encoded RGB as 255 v + 0.5, v in 0..1; red fastest, then green, then blue
}

export type Display = { kind: "sRGB" } | { kind: "raw" } | { kind: "table"; table: DisplayTable };

/** IEC 61966-2-1: l <= 0.0031308 ? 12.92 l : 1.055 l^(1/2.4) - 0.055, l in [0,1]. */
export function encodeSrgb(linear: number): number {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}

/** 0..1 to 0..255, clamped, rounded as the report's pictures are. */
export function toByte(value: number): number {
  return Math.floor(Math.min(Math.max(value, 0), 1) * 255 + 0.5);
}

/** The table that a display file holds. Throws Error in words where it is none. */
export function readDisplayTable(chunk: Chunk, plane: Plane): DisplayTable {
  const size = chunk.height;
  const { minLog2, maxLog2 } = chunk;
  if (size < 2 || chunk.width !== size * size || plane.kind !== "rgb16f")
    throw new Error(`${chunk.file} is not a cube of display colours`);
  if (minLog2 === null || maxLog2 === null || !(minLog2 < maxLog2))
    throw new Error(`${chunk.file} lacks the range of its colours`);
  const halves = halfValues();
  const count = size ** 3;
  const nodes = new Float32Array(3 * count);
  for (let channel = 0; channel < 3; ++channel)
    for (let i = 0; i < count; ++i) {
      const value = Math.min(Math.max(halves[plane.values[channel * count + i]!]!, 0), 1);
      nodes[3 * i + channel] = 255 * value + 0.5; // so that what lies between them only has to be cut
    }
  return { size, minLog2, maxLog2, nodes };
}

const kNotFinite = 256; // beyond every byte

interface ByteTable {
  key: string;
  bytes: Uint16Array; // by half bits; kNotFinite for NaN and infinities
}
const byteTables: ByteTable[] = []; // the last few, so that several panes share one

function bytesAt(kind: "sRGB" | "raw", exposureEv: number): Uint16Array {
  const key = `${kind} ${exposureEv}`;
  const known = byteTables.find((table) => table.key === key);
  if (known !== undefined) return known.bytes;
  const halves = halfValues();
  const scale = 2 ** exposureEv;
  const bytes = new Uint16Array(kHalfCount);
  for (let bits = 0; bits < kHalfCount; ++bits) {
    const linear = halves[bits]! * scale;
    if (!Number.isFinite(halves[bits]!)) bytes[bits] = kNotFinite;
    else if (linear >= 1) bytes[bits] = 255;
    else if (linear > 0) bytes[bits] = toByte(kind === "raw" ? linear : encodeSrgb(linear));
  }
  byteTables.unshift({ key, bytes });
  byteTables.length = Math.min(byteTables.length, 4);
  return bytes;
}

interface Coordinates {
  key: string;
  cells: Uint8Array; // by half bits: the node below; 255 for NaN and infinities
  shares: Float32Array; // of the node above
}
let coordinates: Coordinates | undefined;

function coordinatesAt(table: DisplayTable, exposureEv: number): Coordinates {
  const key = `${table.size} ${table.minLog2} ${table.maxLog2} ${exposureEv}`;
  if (coordinates?.key === key) return coordinates;
  const halves = halfValues();
  const last = table.size - 1;
  const cells = new Uint8Array(kHalfCount);
  const shares = new Float32Array(kHalfCount);
  for (let bits = 0; bits < kHalfCount; ++bits) {
    if (!Number.isFinite(halves[bits]!)) {
      cells[bits] = 255;
      continue;
    }
    const log = Math.log2(Math.max(halves[bits]! * 2 ** exposureEv, 2 ** table.minLog2));
    const place = Math.min(((log - table.minLog2) / (table.maxLog2 - table.minLog2)) * last, last);
    cells[bits] = Math.min(Math.floor(place), last - 1);
    shares[bits] = place - cells[bits]!;
  }
  coordinates = { key, cells, shares };
  return coordinates;
}

function paintByTable(plane: Plane, table: DisplayTable, exposureEv: number, out: Uint32Array): void {
  const count = plane.width * plane.height;
  const { values } = plane;
  const { nodes, size } = table;
  const { cells, shares } = coordinatesAt(table, exposureEv);
  const dg = 3 * size;
  const db = 3 * size * size;
  for (let i = 0; i < count; ++i) {
    const r = values[i]!;
    const g = values[count + i]!;
    const b = values[2 * count + i]!;
    const cellR = cells[r]!;
    const cellG = cells[g]!;
    const cellB = cells[b]!;
    if (cellR === 255 || cellG === 255 || cellB === 255) {
      out[i] = 0xff000000;
      continue;
    }
    const fr = shares[r]!;
    const fg = shares[g]!;
    const fb = shares[b]!;
    const w11 = fg * fb;
    const w10 = fg - w11;
    const w01 = fb - w11;
    const w00 = 1 - fg - w01;
    let pixel = 0xff000000;
    for (let channel = 0, at = 3 * cellR + dg * cellG + db * cellB; channel < 3; ++channel, ++at) {
      const below = w00 * nodes[at]! + w10 * nodes[at + dg]! + w01 * nodes[at + db]! + w11 * nodes[at + dg + db]!;
      const above =
        w00 * nodes[at + 3]! + w10 * nodes[at + dg + 3]! + w01 * nodes[at + db + 3]! + w11 * nodes[at + dg + db + 3]!;
      pixel |= (below + fr * (above - below)) << (8 * channel);
    }
    out[i] = pixel;
  }
}

/**
 * An rgb16f plane as the screen shows it; out: a value a pixel, 0xffBBGGRR (the bytes of ImageData). A pixel with a
 * channel that is NaN or infinite is black, as in the report's pictures.
 */
export function paintDisplay(plane: Plane, display: Display, exposureEv: number, out: Uint32Array): void {
  if (display.kind === "table") {
    paintByTable(plane, display.table, exposureEv, out);
    return;
  }
  const count = plane.width * plane.height;
  const { values } = plane;
  const bytes = bytesAt(display.kind, exposureEv);
  for (let i = 0; i < count; ++i) {
    const r = bytes[values[i]!]!;
    const g = bytes[values[count + i]!]!;
    const b = bytes[values[2 * count + i]!]!;
    out[i] = ((r | g | b) & kNotFinite) !== 0 ? 0xff000000 : 0xff000000 | (b << 16) | (g << 8) | r;
  }
}

/** The screen values of one pixel, 0..255 each. */
export function displayPixel(
  bits: readonly [number, number, number],
  display: Display,
  exposureEv: number,
): [number, number, number] {
  const out = new Uint32Array(1);
  const plane: Plane = { name: "", kind: "rgb16f", width: 1, height: 1, values: Uint16Array.from(bits) };
  paintDisplay(plane, display, exposureEv, out);
  const pixel = out[0]!;
  return [pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255];
}

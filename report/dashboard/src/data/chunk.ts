// One pixel file: planes of 16-bit values. Each is base64 of a DEFLATE stream, which says which pixels differ from the one
// before, and by how much (report/pixel_chunk.h).
import { reasonOf } from "./reason";

export type PlaneKind = "rgb16f" | "unorm16" | "uint16";
const kChannels: Readonly<Record<PlaneKind, number>> = { rgb16f: 3, unorm16: 1, uint16: 1 };
const kFormat = 2;
const kMaxPixels = 2 ** 27; // beyond any picture: damaged figures must not ask for all memory

/** Values of one plane: channel after channel, each top row first. */
export interface Plane {
  name: string;
  kind: PlaneKind;
  width: number;
  height: number;
  values: Uint16Array;
}

interface PackedPlane {
  name: string;
  kind: PlaneKind;
  data: string;
}

/** A file as it is stored; minLog2 and maxLog2 only in a display table. */
export interface Chunk {
  file: string;
  width: number;
  height: number;
  planes: PackedPlane[];
  minLog2: number | null;
  maxLog2: number | null;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}

function checkPlane(value: unknown, file: string): PackedPlane {
  if (!isObject(value) || typeof value.name !== "string" || typeof value.data !== "string")
    throw new Error(`${file} is damaged: a plane has no name or no data`);
  if (typeof value.kind !== "string" || !Object.hasOwn(kChannels, value.kind))
    throw new Error(`${file}: the plane ${value.name} has a kind that this page does not know`);
  return { name: value.name, kind: value.kind as PlaneKind, data: value.data };
}

/** What a file hands over, checked. Throws Error in words for another format version or what is not a chunk. */
export function checkChunk(value: unknown, file: string): Chunk {
  if (!isObject(value)) throw new Error(`${file} holds no pixel values`);
  if (value.format !== kFormat)
    throw new Error(`${file} has format ${String(value.format)}, but this page reads format ${kFormat}`);
  if (value.file !== file) throw new Error(`${file} holds the values of another file`);
  const { width, height, planes } = value;
  const isSize = (n: unknown): n is number => typeof n === "number" && Number.isInteger(n) && n > 0;
  if (!isSize(width) || !isSize(height) || width * height > kMaxPixels)
    throw new Error(`${file} is damaged: its size is wrong`);
  if (!Array.isArray(planes)) throw new Error(`${file} is damaged: it has no planes`);
  const numberOrNull = (n: unknown): number | null => (typeof n === "number" ? n : null);
  return {
    file,
    width,
    height,
    planes: planes.map((plane: unknown) => checkPlane(plane, file)),
    minLog2: numberOrNull(value.minLog2),
    maxLog2: numberOrNull(value.maxLog2),
  };
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The stream's bytes; throws where they are more than `most`. */
async function inflate(packed: Uint8Array<ArrayBuffer>, most: number): Promise<Uint8Array> {
  const bytes = new Uint8Array(most);
  let filled = 0;
  const reader = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    if (filled + value.length > most) {
      await reader.cancel();
      throw new Error("more values than its size");
    }
    bytes.set(value, filled);
    filled += value.length;
  }
  return bytes.subarray(0, filled);
}

/**
 * The values of `count` pixels: a bit for each, whether it differs from the one before, then the differences of those that do,
 * of each channel the low bytes and the high bytes. Throws where the bytes are not exactly these.
 */
function undoDifferences(bytes: Uint8Array, count: number, channels: number): Uint16Array {
  const bits = Math.ceil(count / 8);
  if (bytes.length < bits) throw new Error("fewer values than its size");
  const differs = (i: number): boolean => ((bytes[i >> 3]! >> (i & 7)) & 1) === 1;
  let changes = 0;
  for (let i = 0; i < count; ++i) if (differs(i)) ++changes;
  const size = bits + 2 * changes * channels;
  if (bytes.length !== size) throw new Error(`${bytes.length < size ? "fewer" : "more"} values than its size`);
  const values = new Uint16Array(count * channels);
  for (let channel = 0; channel < channels; ++channel) {
    let low = bits + 2 * changes * channel;
    const first = count * channel;
    let value = 0;
    for (let i = 0; i < count; ++i) {
      if (differs(i)) {
        value = (value + (bytes[low]! | (bytes[low + changes]! << 8))) & 0xffff;
        ++low;
      }
      values[first + i] = value;
    }
  }
  return values;
}

/** Unpacks one plane. Rejects in words where its data is damaged. */
export async function decodePlane(chunk: Chunk, name: string): Promise<Plane> {
  const packed = chunk.planes.find((plane) => plane.name === name);
  if (packed === undefined) throw new Error(`${chunk.file} has no plane ${name}`);
  const channels = kChannels[packed.kind];
  const { width, height } = chunk;
  const count = width * height;
  let values: Uint16Array;
  try {
    const bytes = await inflate(fromBase64(packed.data), Math.ceil(count / 8) + 2 * count * channels);
    values = undoDifferences(bytes, count, channels);
  } catch (error) {
    const why = reasonOf(error);
    throw new Error(`${chunk.file} is damaged: the plane ${name} cannot be unpacked (${why})`);
  }
  return { name, kind: packed.kind, width, height, values };
}

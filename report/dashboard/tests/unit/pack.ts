// Writes planes as the contract of pixel files says, apart from the page's own code: what tests read back.
import { deflateRawSync } from "node:zlib";

/** values: channel after channel, each top row first; 16 bits. */
export function packValues(values: ArrayLike<number>, width: number, height: number): string {
  const count = width * height;
  const bytes = new Uint8Array(2 * values.length);
  for (let i = 0; i < values.length; ++i) {
    const at = i % count;
    const x = at % width;
    const before = at === 0 ? 0 : x === 0 ? values[i - width]! : values[i - 1]!;
    const difference = (values[i]! - before + 65536) % 65536;
    const start = 2 * (i - at);
    bytes[start + at] = difference % 256;
    bytes[start + count + at] = Math.floor(difference / 256);
  }
  return deflateRawSync(bytes).toString("base64");
}

/** The bits of the half nearest to a value that a half can hold exactly. */
export function halfBits(value: number): number {
  if (Number.isNaN(value)) return 0x7e00;
  const sign = value < 0 ? 0x8000 : 0;
  const size = Math.abs(value);
  if (size === Infinity) return sign | 0x7c00;
  if (size < 2 ** -14) return sign | Math.round(size * 2 ** 24);
  const exponent = Math.floor(Math.log2(size));
  return sign | ((exponent + 15) << 10) | Math.round((size / 2 ** exponent - 1) * 1024);
}

/** Whether half bits are neither NaN nor infinite. */
export function isFiniteHalf(bits: number): boolean {
  return (bits & 0x7c00) !== 0x7c00;
}

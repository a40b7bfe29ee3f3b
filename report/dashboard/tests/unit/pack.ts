// Writes planes as the contract of pixel files says, apart from the page's own code: what tests read back.
import { deflateRawSync } from "node:zlib";

/** values: channel after channel, each top row first; 16 bits. */
export function packValues(values: ArrayLike<number>, width: number, height: number): string {
  const count = width * height;
  const channels = values.length / count;
  const differences = Array.from({ length: values.length }, (_, i) => {
    const before = i % count === 0 ? 0 : values[i - 1]!;
    return (values[i]! - before + 65536) % 65536;
  });
  const bits = new Uint8Array(Math.ceil(count / 8));
  const changed: number[] = [];
  for (let i = 0; i < count; ++i) {
    if (Array.from({ length: channels }, (_, c) => differences[c * count + i]!).every((d) => d === 0)) continue;
    bits[Math.floor(i / 8)]! += 2 ** (i % 8);
    changed.push(i);
  }
  const bytes = [...bits];
  for (let c = 0; c < channels; ++c) {
    const ofChannel = changed.map((i) => differences[c * count + i]!);
    bytes.push(...ofChannel.map((d) => d % 256), ...ofChannel.map((d) => Math.floor(d / 256)));
  }
  return deflateRawSync(Uint8Array.from(bytes)).toString("base64");
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

// IEEE half floats, as pixel files hold linear colour: 16 bits each.

/** The value of half bits 0..65535; NaN and infinities as themselves. */
export function halfToNumber(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction === 0 ? sign * Infinity : NaN;
  return sign * (1024 + fraction) * 2 ** (exponent - 25);
}

export const kHalfCount = 65536;
let values: Float32Array | undefined;

/** The values of all halves by their bits; made once. */
export function halfValues(): Float32Array {
  if (values === undefined) {
    values = new Float32Array(kHalfCount);
    for (let bits = 0; bits < kHalfCount; ++bits) values[bits] = halfToNumber(bits);
  }
  return values;
}

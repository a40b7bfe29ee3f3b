// Numbers of many rows, packed as report/column.h packs them; each column is unpacked when it is first read.

/** A value that all rows have (null: not a number), or base64 of little-endian values. */
export type PackedColumn = number | null | { u8: string } | { u16: string } | { u32: string } | { f32: string };
export type Numbers = Uint8Array | Uint16Array | Uint32Array | Float32Array;

export interface PackedTable {
  count: number; // of rows
  columns: Record<string, PackedColumn>; // none where there are no rows
}

export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Throws Error where a column has not as many values as rows. */
export function unpack(packed: PackedColumn | undefined, count: number): Numbers {
  const checked = (values: Numbers): Numbers => {
    if (values.length !== count) throw new Error(`a column has ${values.length} values for ${count} rows`);
    return values;
  };
  if (count === 0) return new Uint8Array(0);
  if (packed === undefined) throw new Error("a column is missing");
  if (packed === null) return new Float32Array(count).fill(NaN);
  if (typeof packed === "number") return (Number.isInteger(packed) && packed >= 0 ? new Uint32Array(count) : new Float32Array(count)).fill(packed);
  if ("u8" in packed) return checked(bytesOf(packed.u8));
  if ("u16" in packed) return checked(new Uint16Array(bytesOf(packed.u16).buffer));
  if ("u32" in packed) return checked(new Uint32Array(bytesOf(packed.u32).buffer));
  return checked(new Float32Array(bytesOf(packed.f32).buffer));
}

/** The columns by name, each unpacked once, when it is first read. */
export function columnsOf<Name extends string>(table: PackedTable, names: readonly Name[]): Readonly<Record<Name, Numbers>> {
  const columns = {};
  for (const name of names)
    Object.defineProperty(columns, name, {
      configurable: true,
      get: () => {
        const value = unpack(table.columns[name], table.count);
        Object.defineProperty(columns, name, { value });
        return value;
      },
    });
  return columns as Record<Name, Numbers>;
}

/** A value of a column of reals as it was before it was packed, for figures of up to 6 digits; null for NaN. */
export function realOf(value: number | undefined): number | null {
  return value === undefined || Number.isNaN(value) ? null : Number(value.toPrecision(7));
}

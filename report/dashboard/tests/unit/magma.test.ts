import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

import { magmaColor, magmaCss, magmaIndex } from "../../src/data/magma";

describe("magma", () => {
  it("has the colours of the report's own pictures", () => {
    const source = readFileSync(new URL("../../../../compare/flip/magma.cpp", import.meta.url), "utf8");
    const table = source.slice(source.indexOf("kMagma[256]"), source.indexOf("};"));
    const colors = [...table.matchAll(/0x([0-9a-f]{6})\b/g)].map((match) => parseInt(match[1]!, 16));
    expect(colors).toHaveLength(256);
    expect(colors.map((_, i) => magmaColor(i))).toEqual(colors);
  });

  it("rounds and clamps as they do", () => {
    expect([0, 0.5, 1, -1, 2, 1.49 / 255, 1.51 / 255].map(magmaIndex)).toEqual([0, 128, 255, 0, 255, 1, 2]);
    expect(magmaCss(0)).toBe("#000004");
    expect(magmaCss(1)).toBe("#fcfdbf");
  });
});

import { describe, expect, it } from "vitest";

import { bestColumns } from "../../src/viewer/layout";

const square = { width: 512, height: 512 };

describe("the columns of panes", () => {
  it("are those that make the pictures largest", () => {
    expect(bestColumns(3, { width: 1100, height: 560 }, square)).toBe(3);
    expect(bestColumns(3, { width: 366, height: 560 }, square)).toBe(2);
    expect(bestColumns(3, { width: 366, height: 900 }, square)).toBe(1);
    expect(bestColumns(4, { width: 1100, height: 560 }, square)).toBe(4);
    expect(bestColumns(2, { width: 1100, height: 560 }, { width: 1920, height: 1080 })).toBe(2);
    expect(bestColumns(2, { width: 800, height: 900 }, { width: 1920, height: 1080 })).toBe(1);
  });

  it("are one for one pane, and before a size is known", () => {
    expect(bestColumns(1, { width: 1100, height: 560 }, square)).toBe(1);
    expect(bestColumns(3, { width: 0, height: 0 }, square)).toBeGreaterThan(0);
  });
});

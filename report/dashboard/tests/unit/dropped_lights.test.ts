import { describe, expect, it } from "vitest";

import type { DroppedLights } from "../../src/data/types";
import { describeDropped, lightsOf } from "../../src/item/dropped_lights";

const kDropped: DroppedLights = {
  lights: 5,
  measured: [
    { name: "lamp 2", kind: "point", keptBy: 3, droppedBy: 1, materials: [{ name: "glass", flip: 0.25 }] },
    {
      name: "lamp 1", kind: "spot", keptBy: 0, droppedBy: 2,
      materials: [{ name: "metal", flip: 0.031 }, { name: "glass", flip: 0.3 }],
    },
  ],
  notMeasured: ["lamp 3"],
};

describe("the lights that mobile drops", () => {
  it("are for a material those that its objects lack, the most effect on it first", () => {
    const names = (material: string): string[] => lightsOf(kDropped, material).map(({ light, flip }) => `${light.name} ${flip}`);
    expect(names("glass")).toEqual(["lamp 1 0.3", "lamp 2 0.25"]);
    expect(names("metal")).toEqual(["lamp 1 0.031"]);
    expect(names("floor")).toEqual([]);
  });

  it("are counted, measured or not", () => {
    expect(describeDropped(kDropped, "mobile")).toBe("Mobile drops 3 of 5 lights");
    expect(describeDropped(kDropped, "lambert")).toBe("lambert drops 3 of 5 lights");
    expect(describeDropped({ lights: 1, measured: [], notMeasured: ["sun"] }, "mobile")).toBe("Mobile drops 1 of 1 light");
  });
});

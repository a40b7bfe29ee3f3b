import { describe, expect, it } from "vitest";

import { kDefaultState, type ViewerState } from "../../src/data/state";
import { changeOf, type KeyScene } from "../../src/viewer/keys";

function press(key: string, patch: Partial<KeyScene> = {}, shiftKey = false): Partial<ViewerState> | null {
  const scene: KeyScene = {
    state: kDefaultState,
    look: { zoom: 2, panX: 0.5, panY: 0.5 },
    pane: { width: 100, height: 100 },
    picture: { width: 100, height: 100 },
    isOnPicture: false,
    ...patch,
  };
  return changeOf({ key, shiftKey } as KeyboardEvent, scene);
}

describe("keys of the comparison", () => {
  it("zooms from what is seen, and resets", () => {
    expect(press("+")?.zoom).toBeGreaterThan(2);
    expect(press("-")?.zoom).toBeLessThan(2);
    expect(press("0")).toEqual({ zoom: 1, panX: 0.5, panY: 0.5, exposure: 0 });
  });

  it("moves with Shift and arrows", () => {
    expect(press("ArrowRight", {}, true)?.panX).toBeGreaterThan(0.5);
    expect(press("ArrowUp", { isOnPicture: true }, true)?.panY).toBeLessThan(0.5);
  });

  it("moves the inspected pixel only while a picture has the focus, and not beyond it", () => {
    const state = { ...kDefaultState, pixelX: 99, pixelY: 5 };
    expect(press("ArrowDown", { state })).toBeNull();
    expect(press("ArrowDown", { state, isOnPicture: true })).toEqual({ pixelX: 99, pixelY: 6 });
    expect(press("ArrowRight", { state, isOnPicture: true })).toEqual({ pixelX: 99, pixelY: 5 });
    expect(press("ArrowDown", { isOnPicture: true })).toEqual({ pixelX: 50, pixelY: 50 }); // none yet: the middle
  });

  it("changes modes and the exposure, within its range", () => {
    expect(press("s")).toEqual({ mode: "slider" });
    expect(press("S", { state: { ...kDefaultState, mode: "onion" } })).toEqual({ mode: "side" });
    expect([press("o"), press("d"), press("h")]).toEqual([{ mode: "onion" }, { mode: "difference" }, { mode: "flip" }]);
    expect(press("]")).toEqual({ exposure: 0.25 });
    expect(press("[", { state: { ...kDefaultState, exposure: -8 } })).toEqual({ exposure: -8 });
  });

  it("leaves other keys alone", () => {
    for (const key of ["x", "Enter", "Tab", "Escape", " ", "ArrowDown"]) expect(press(key)).toBeNull();
  });
});

import { describe, expect, it } from "vitest";

import {
  boundsOf,
  clampLook,
  fitScale,
  lookAt,
  lookAtWidth,
  lookOf,
  movedBy,
  pixelAt,
  place,
} from "../../src/viewer/transform";

const kPane = { width: 600, height: 400 };
const kPicture = { width: 200, height: 100 };

describe("zoom and pan", () => {
  it("fits the picture and centres it at the usual look", () => {
    expect(fitScale(kPane, kPicture)).toBe(3);
    expect(place({ zoom: 1, panX: 0.5, panY: 0.5 }, kPane, kPicture)).toEqual({ x: 0, y: 50, scale: 3 });
    expect(fitScale({ width: 0, height: 0 }, kPicture)).toBe(1);
  });

  it("comes back from a placement", () => {
    const look = { zoom: 5.5, panX: 0.2, panY: 0.9 };
    const back = lookOf(place(look, kPane, kPicture), kPane, kPicture);
    for (const key of ["zoom", "panX", "panY"] as const) expect(back[key]).toBeCloseTo(look[key], 12);
  });

  it("keeps some of the picture in the pane", () => {
    expect(clampLook({ zoom: 1000, panX: -3, panY: 4 })).toEqual({ zoom: 64, panX: 0, panY: 1 });
  });

  it("fits a box with a rim, and never shows less than the pane can hold", () => {
    const look = lookAt({ x: 40, y: 20, width: 32, height: 16 }, kPane, kPicture);
    expect(look.panX).toBeCloseTo(56 / 200);
    expect(look.panY).toBeCloseTo(28 / 100);
    expect(look.zoom * 3).toBeCloseTo(600 / 48); // a rim of 8 on both sides
    expect(lookAt({ x: 0, y: 0, width: 200, height: 100 }, kPane, kPicture).zoom).toBe(1);
  });

  it("fills the width, but is never the usual look", () => {
    expect(lookAtWidth({ width: 600, height: 150 }, kPicture).zoom).toBeCloseTo(2);
    expect(lookAtWidth(kPane, kPicture).zoom).not.toBe(1);
  });

  it("moves by shares of what the pane shows", () => {
    const moved = movedBy({ zoom: 4, panX: 0.5, panY: 0.5 }, 0.5, -0.5, kPane, kPicture);
    expect(moved.panX).toBeCloseTo(0.5 + 300 / (12 * 200));
    expect(moved.panY).toBeCloseTo(0.5 - 200 / (12 * 100));
  });

  it("finds the pixel under a point, and none beside the picture", () => {
    const placement = place({ zoom: 1, panX: 0.5, panY: 0.5 }, kPane, kPicture);
    expect(pixelAt(placement, 0, 50, kPicture)).toEqual({ x: 0, y: 0 });
    expect(pixelAt(placement, 599.9, 349.9, kPicture)).toEqual({ x: 199, y: 99 });
    expect(pixelAt(placement, 300, 49, kPicture)).toBeNull();
    expect(pixelAt(placement, 300, 350, kPicture)).toBeNull();
  });

  it("finds the bounds of a material", () => {
    const values = new Uint16Array(8 * 4);
    values[8 + 2] = 3;
    values[16 + 6] = 3;
    values[0] = 2;
    expect(boundsOf(values, 8, 3)).toEqual({ x: 2, y: 1, width: 5, height: 2 });
    expect(boundsOf(values, 8, 2)).toEqual({ x: 0, y: 0, width: 1, height: 1 });
    expect(boundsOf(values, 8, 9)).toBeNull();
  });
});
